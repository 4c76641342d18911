// What Python says: the palette, the maps that come along, how a map is drawn, the source
// of a worker, the paper's numbers, and of the scene the fields of its state and its
// constants.
//
// Python puts it before the bundle of a scene, as the object `python`; see `files.py`.

export const { palette, mapTexts, drawing, workerSource, paper, spec } = python;
