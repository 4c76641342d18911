// What Python says: the palette, the maps that come along, how a map is drawn, what a
// worker does, the paper's numbers, and of the scene the fields of its state and its
// constants.
//
// Python puts it before the bundle of a scene, as the object `python`; see `files.py`.

export const { palette, mapTexts, drawing, worker, paper, spec } = python;
