// What the paper compares, and found: the nine arms, the grid of tau, the length of a
// run, the rows of Table 1 and its numbers.  They are Python's.

import { paper } from "../python.js";

export const { arms: ARMS, taus: TAUS, steps: PAPER_STEPS, rows: ROWS, numbers: PAPER } = paper;
