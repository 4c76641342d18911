// The records that scripts hand to each other.  Shapes: C cells of a building, S states
// (task x cell), A actions, Z abstract states; arrays are flat, row by row.

/** A building; see engine/maps.js. */
export interface Building {
  readonly text: string;
  readonly height: number;
  readonly width: number;
  readonly nCells: number;
  readonly cells: readonly string[]; // (C,) "." corridor, " " room, "*" goal
  readonly inRoom: Uint8Array; // (C,)
  readonly goals: readonly number[]; // cells
  readonly neighbors: Int32Array; // (C, 4) to N, E, S, W; -1 behind a wall
  readonly doors: Uint8Array; // (C, 4)
  readonly regions: Int32Array; // (C,) rooms and corridors, numbered
  readonly nRooms: number;
  readonly nDoors: number;
}

/** The picture in a text: characters, and where in the text they stand. */
export interface Picture {
  readonly lines: string[][];
  readonly rows: number[]; // line of the text of each line of the picture
  readonly columns: number[]; // column of the text of each of its columns
}

/** What of a building elimination needs. */
export type Plan = Pick<Building, "neighbors">;

/** The tasks of a building as one union MDP; see engine/navigation.js. */
export interface Tasks<Of extends Plan = Building> {
  readonly map: Of;
  readonly success: number;
  readonly gamma: number;
  readonly features: readonly string[];
  readonly goal: Int32Array; // the goal cell of each task
  readonly neighbors: Int32Array; // (C, 4)
  readonly nCells: number;
  readonly nStates: number;
  readonly nTasks: number;
  readonly nActions: number;
  readonly nAbstract: number;
  readonly labels: Int8Array; // (S, 4) the action that may go there, or -1
  readonly nWays: Uint8Array; // (S, A) directions an action draws from
  readonly rho: Int32Array; // (S,) abstract states
  readonly terminal: Uint8Array; // (S,)
  readonly reward: Float64Array; // (S,) for reaching a state
  readonly possible: Uint8Array; // (Z, A) what an abstract state does not rule out
}

/** What solving a problem needs: the union MDP, without what robots see. */
export type Problem = Omit<Tasks<Plan>, "features">;

export interface TaskOptions {
  success?: number;
  reward?: "cost" | "goal";
  gamma?: number;
  near?: number;
  almostNear?: number;
  features?: readonly string[];
  keep?: readonly number[]; // numbers of tasks
  actions?: "relational" | "compass";
}

/** One iteration of AbsProb-PI; see engine/absprob_pi.js. */
export interface Climbed {
  iteration: number;
  policy: Float64Array; // (Z, A)
  value: number;
  gradient: Float64Array; // (Z, A)
  visits: Float64Array; // (Z,)
}

/** The tables that a run reads; see engine/learning.js. */
export interface World {
  nStates: number;
  ways: Uint8Array; // (S, A) sets of directions, a bit each
  last: Uint32Array; // (16, 5) last word of an outcome
  move: Int32Array; // (16, 5) differences of state numbers
  terminal: Uint8Array; // (S,)
  start: Int32Array; // states an episode may begin in
  step: number; // reward of a step
  goal: number; // reward of reaching the goal
}

/** An abstract policy as a run reads it. */
export interface Guide {
  row: Int32Array; // (S,) the row of a state
  bound: Int32Array; // (Z, A) cumulative chances in units of 1/65536
}

export interface Rule {
  alpha: number;
  gamma: number;
  epsilon: number;
  q0: number;
  maxEpisode: number;
  tau: number; // steps with advice
  strategy: string; // "hard" or "soft"
}

/** What a run is made of, and how it is told of: for learnAll. */
export interface Job {
  world: World;
  guide: Guide | null;
  rule: Partial<Rule>;
  seed: number;
  key?: number[]; // a spawn key
  notes?: Float64Array; // the table that it begins with
  steps: number;
  window: number; // steps
}

/** One step, and all there is to say of it. */
export interface Step {
  t: number;
  s: number;
  a: number;
  how: string; // "guided", "explored" or "greedy"
  luck: number; // the two words that were drawn
  fate: number;
  next: number;
  reward: number;
  bestNext: number;
  target: number;
  before: number;
  after: number;
  ended: "goal" | "cut" | null;
  here: number; // `next`, or the start of the next episode
}

export interface LearnOptions {
  onWindow?: (job: number, i: number, goals: number) => void;
  onDone?: (job: number, q: Float64Array) => void;
  nWorkers?: number;
  look?: number; // milliseconds
}

export interface Learning {
  stop: () => void;
  finished: Promise<boolean>; // false after a stop
}

// ---- scenes

/** Values of a scene's state, by name: JSON. */
export type State = any;
/** Least and largest number, or all values. */
export type Limits = readonly [number, number] | readonly string[];

/** A scene: what its file says, and its state, as Python's traits say. */
export interface Spec {
  title: string;
  fields: Record<string, Field>;
  state: State; // the start of each field
  limits: Record<string, any>;
  local: string[];
  build: (scene: Scene) => (state: State, changed: Set<string>) => void;
}

/** What the file of a scene says of it. */
export type Own = Pick<Spec, "title" | "build">;

/** What Python's trait says of a value of the state; see base.py. */
export interface Field {
  start: any;
  kind: "map" | "choice" | "flag" | "whole" | "number" | "text" | "list" | "json";
  isLocal: boolean; // no part of an address
  bounds?: readonly any[]; // least and largest number, or all values
}

/** What `build` gets. */
export interface Scene {
  id: string;
  spec: Spec;
  el: HTMLElement;
  state: State;
  limits: Record<string, any>;
  parts: Record<string, HTMLElement[]>; // what steers a value, by its name
  readonly calm: boolean;
  readonly isLearning: boolean;
  set: (changes: State) => void;
  limit: (name: string, bounds: Limits) => void;
  redraw: () => void;
  learn: (jobs: Job[], options: LearnOptions) => Learning;
  stop: () => void;
  add: (...nodes: any[]) => void;
  row: (...nodes: any[]) => HTMLElement;
  onLeave: (f: () => void) => void;
  onReset: (f: () => void) => void;
  control: (name: string, show: (value: any, bounds: any) => void) => void;
  slider: (name: string, options: object) => HTMLElement;
  choice: (name: string, options: object) => HTMLElement;
  toggle: (name: string, options: object) => HTMLElement;
  button: (text: string, act: () => void, options?: ButtonOptions) => HTMLElement;
  bet: (name: string, options: { question: string; options: Record<string, any> }) => HTMLElement;
  betResult: (name: string, truth: string, other?: string) => string;
  bets: Record<string, Record<string, string>>;
  open: () => void;
  say: (sentence: string) => void;
  warn: (problems: Record<string, string>, sorry: string) => void;
  close: (sentence: string | false) => void;
  twin: (f: () => Table) => void;
}

/** The numbers behind a picture. */
export interface Table {
  caption: string;
  head: readonly any[];
  rows: readonly (readonly any[])[];
}

export interface ButtonOptions {
  primary?: boolean;
  label?: string;
  title?: string;
}

export interface TimelineOptions {
  label?: string;
  format?: (x: number) => string;
  speeds?: number[]; // steps a second
  moments?: { label: string; find: (t: number) => number | null };
}

export interface Axis {
  label?: string;
  format?: (x: number) => string;
  min?: number;
  max?: number;
}

export interface Curve {
  name?: string;
  arm: string;
  points: number[][]; // x, y
}

/** What Python puts before the bundle of a scene; see files.py. */
export interface Said {
  palette: {
    arms: Record<string, { name: string; marker: string }>;
    strategies: Record<string, { dash: number[]; filled: boolean }>;
  };
  mapTexts: { source: string; target: string };
  drawing: { // see the Python modules `maps` and `foreign`
    known: string[][]; // characters that may stand, by row % 2 and column % 2
    said: string[][]; // what an error says of them
    same: Record<string, string>; // what stands for a character
    formats: [name: string, lacks: string, pattern: string][];
    posts: string; // a pattern
    tabSizes: number[];
  };
  worker: (scope: any) => void; // the script of a worker; see engine/worker.js
  paper: {
    arms: { name: string; guide: string | null; strategy: string; tau: number }[];
    taus: number[];
    steps: number;
    rows: string[];
    numbers: Record<string, Record<string, number>>;
    seed: number;
    windows: number;
  };
  isWidget?: boolean;
  spec?: any; // { fields, ...constants } of the scene
  mount?: (element: HTMLElement, options?: State, more?: object) => any;
  render?: (context: { model: any; el: HTMLElement }) => () => void;
}

declare global {
  const python: Said;
}
