// Parts of the front end as one object, for tests that look at them from a page.

import * as maps from "../../../abstransfer/scenes/engine/maps.js";
import * as learning from "../../../abstransfer/scenes/engine/learning.js";
import * as navigation from "../../../abstransfer/scenes/engine/navigation.js";
import * as paper from "../../../abstransfer/scenes/engine/paper.js";
import * as solvers from "../../../abstransfer/scenes/engine/solvers.js";
import * as verdicts from "../../../abstransfer/scenes/filling/verdicts.js";
import * as land from "../../../abstransfer/scenes/hill/land.js";
import * as runs from "../../../abstransfer/scenes/microscope/runs.js";
import * as student from "../../../abstransfer/scenes/parts/student.js";
import * as waves from "../../../abstransfer/scenes/ripple/waves.js";
import * as lines from "../../../abstransfer/scenes/ui/lines.js";
import * as scene from "../../../abstransfer/scenes/ui/scene.js";
import { mapTexts } from "../../../abstransfer/scenes/python.js";

globalThis.probe = {
  ...maps,
  ...learning,
  ...navigation,
  ...paper,
  ...solvers,
  ...verdicts,
  ...student,
  ...lines,
  ...scene,
  mapTexts,
  land,
  waves,
  take: runs.take,
};
