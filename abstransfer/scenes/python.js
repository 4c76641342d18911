// What Python says: the palette, the maps that come along, the source of a worker.
//
// Python puts it before the bundle of a scene, as the object `python`; see `files.py`.

export const { palette, mapTexts, workerSource } = python;
