// The interface between the page and the core: what is asked, and what is answered. `web/INTERFACE.md`
// describes it, with samples. SI units, global axes, linear part first.

/** A pose of the mechanism; left out: that of the job and pose loaded, or a file's own configuration. */
export type Pose =
  /** A pose of the job, by its number from 0. */
  | { number: number }
  /** Coordinates of the output, any of x y z [m] rx ry rz [rad]; a prebuilt mechanism wants all that it takes. */
  | { at: Partial<Record<Coordinate, number>> }
  /** Values of drives [m, rad], `joint.direction`, relative to the configuration that was loaded. */
  | { drives: Record<string, number> };

export type Coordinate = "x" | "y" | "z" | "rx" | "ry" | "rz";
export type Six = [number, number, number, number, number, number];
export type Three = [number, number, number];
export type Matrix6 = [Six, Six, Six, Six, Six, Six];

/** What is asked. Every request may fail with `{error}`. */
export type Request =
  | { ask: "load"; files: Record<string, string>; main: string; job?: string; design?: number; pose?: number }
  | { ask: "set"; values: [path: string, value: number | string][] }
  | { ask: "values" }
  | { ask: "solve"; pose?: Pose; modes?: number; why?: boolean; case?: string; along?: Along; verify?: boolean }
  | { ask: "scene"; pose?: Pose; case?: string }
  | { ask: "frame"; pose?: Pose; case?: string; along?: Along; modes?: number; light?: boolean }
  | { ask: "place"; pose: Pose }
  | { ask: "modes"; pose?: Pose; count: number }
  | { ask: "sweep"; axes: Axis[]; fixed?: Partial<Record<Coordinate, number>>; measure: string; case?: string; rows?: [first: number, end: number] }
  | { ask: "measures" }
  | { ask: "schema" }
  | { ask: "beginnings" }
  | { ask: "format"; text: string; name?: string }
  | { ask: "write"; pose?: Pose; json?: boolean };

/** Direction of the budget: that of the displacement (default), or a unit wrench. */
export type Along = "displacement" | Six;

/** An axis of a map: `count` values from `first` to `last`; of two axes the first runs fastest. */
export interface Axis { name: Coordinate; first: number; last: number; count: number }

/** An answer: the object, and the numbers that its `layout` points into. */
export interface Answer<T> { value: T; numbers: Float64Array }

/** Where a part of `numbers` begins, and how many there are. */
export type Span = [offset: number, length: number];

/** What is wrong. `line` and `column` from 1; 0 or null where no place in a text is meant. */
export interface Problem {
  code: string;
  message: string;
  help: string | null;
  path: string | null;
  line: number | null;
  column: number | null;
  /** Number of characters of the line that are meant. */
  length: number | null;
}
export interface Failed { error: Problem }

export interface Loaded {
  name: string;
  /** `mechanism`: a mechanism file; `batch`: a batch file. */
  kind: "mechanism" | "batch";
  jobs: JobInfo[];
  job: string | null;
  design: number | null;
  pose: number | null;
  cases: string[];
  /** Coordinates that the output is moved by; those that follow from the others are not among them. */
  coordinates: Movable[];
  /** Drives that it is moved by; none of a prebuilt mechanism. */
  drives: Movable[];
  /** Characteristic length [m]: what a view fits, and what steps follow from. */
  size: number;
  /** Files that were read, by their names. */
  files: string[];
  /** What is hardly meant, and what the reader should know. */
  warnings: string[];
  /** What is no fault, but may be a slip. */
  notes: string[];
  /** Why it cannot be solved, where it cannot; it is drawn all the same. */
  problem: Problem | null;
}
export interface JobInfo { name: string; poses: number; designs: number }
/** A coordinate or drive, its value in the pose loaded and the range that the poses of the job have, or a guess. */
export interface Movable { name: string; unit: "m" | "rad"; value: number; from: number; to: number }

/** A value that `set` takes by its path, SI. */
export interface Value {
  path: string;
  value: number;
  unit: string;
  /** `parameter`, `section`, `material`, `stiffness`, `mass`, `placing`. */
  group: string;
  /** What has it, named as in a budget: a body, or `joint NAME`. */
  parts: string[];
}

/** The mechanism as it is drawn. Vertices 0 … nodes.length−1 are the nodes; those of segments follow. */
export interface Scene {
  name: string;
  title: string;
  size: number;
  vertices: number;
  nodes: { name: string; body: number; point: string }[];
  bodies: SceneBody[];
  segments: SceneSegment[];
  joints: SceneJoint[];
  loads: SceneLoad[];
  lines: SceneLineLoad[];
  masses: { node: number; mass: number }[];
  /** Acceleration of gravity [m/s²]; null where there is none. */
  gravity: Three | null;
  /** The node of the output. */
  output: number | null;
  cases: string[];
  case: string | null;
  /** Status of the pose, as of `Frame`. */
  status: Status;
  problem: Problem | null;
  layout: Layout;
}
export interface SceneBody {
  name: string;
  kind: "beam" | "rigid" | "flexible";
  nodes: number[];
  segments: number[];
}
export interface SceneSegment {
  body: number;
  /** Names of its end points, and their nodes. */
  points: [string, string];
  ends: [number, number];
  /** First vertex of its curve, and how many. */
  vertices: [first: number, count: number];
  /** Section at its first and last vertex: the same where it does not taper. */
  from: SceneSection;
  to: SceneSection;
  length: number;
}
export interface SceneSection {
  shape: "circle" | "tube" | "rectangle" | "general";
  /** In local y and z [m]: counter-clockwise, closed, as many points at both ends of a segment. */
  outline: [number, number][];
  /** The same of a hole; null where there is none. */
  hole: [number, number][] | null;
  /** In words: `circle 14 mm`. */
  words: string;
}
export interface SceneJoint {
  name: string;
  /** `Revolute`, `Prismatic`, … or a kind of one's own. */
  kind: string;
  /** Bodies and nodes; null is the ground. The joint stands at, and moves with, `at`. */
  bodies: [number | null, number | null];
  nodes: [number | null, number | null];
  at: number;
  /** Directions x y z u v w of its frame: free by kind, held as drives, elastic. */
  free: string[];
  locked: string[];
  elastic: string[];
}
export interface SceneLoad { case: string | null; node: number }
export interface SceneLineLoad { case: string | null; segment: number }

/** Spans of `numbers`. V vertices, S segments, J joints. */
export interface Layout {
  /** 3·V: places without load [m]. */
  positions: Span;
  /** 6·V: displacement [m] and rotation [rad] under the loads of the case. */
  displacements: Span;
  /** V: largest equivalent stress of the section [Pa]; NaN where it is not known, and on nodes that are no beam's. */
  stress: Span;
  /** 9·S: local x, y, z of segments, one after the other. */
  axes: Span;
  /** 9·J: x, y, z of joints. */
  frames: Span;
  /** 6 a load of `loads`: force [N], moment [N·m], global. */
  loads: Span;
  /** 12 a line load: force, moment per length at its first and second node. */
  lines: Span;
}

export type Status = "ok" | "design" | "unreachable" | "singular" | "branch" | "unrestrained" | "rigid" | "failed";

/** What changes while one drags; `numbers` as of the scene, with the same layout where `status` is not about the pose. */
export interface Frame {
  status: Status;
  /** Why it is not `ok`. */
  problem: Problem | null;
  /** Whole pose of the output; null where it is not reached. */
  pose: Six | null;
  /** Values of drives, where they are known. */
  drives: Record<string, number> | null;
  stiffness: Matrix6 | null;
  displacement: Six | null;
  /** Length of its translation [m], and of its rotation [rad]. */
  deflection: number | null;
  rotation: number | null;
  principal: Principals | null;
  /** The largest equivalent stress, and where. */
  stress: { body: string; value: number; utilisation: number | null } | null;
  /** [Hz]; empty without mass. */
  frequencies: number[];
  budget: Budget | null;
  /** Null where the pose is not reached: the scene stays as it was. */
  layout: Layout | null;
}
export interface Principals {
  translational_stiffnesses: Principal;
  rotational_stiffnesses: Principal;
  translational_compliances: Principal;
  rotational_compliances: Principal;
}
/** Ascending, with unit vectors. */
export interface Principal { values: Three; directions: [Three, Three, Three] }
export interface Budget {
  of: "displacement" | "compliance";
  case?: string;
  along: Six;
  total: number;
  /** Name of the body, or `joint NAME`. */
  by_part: Share[];
  by_deformation: Share[];
  parts: { body?: string; joint?: string; deformation: string; displacement: number; share: number | null }[];
  rest: number;
}
export interface Share { name: string; displacement: number; share: number | null }

export interface Placed {
  status: Status;
  problem: Problem | null;
  pose: Six | null;
  drives: Record<string, number> | null;
}

/** Numbers: 3·V a mode, translation of unit modal mass scaled so that the largest is 1. */
export interface Modes {
  modes: { frequency: number; effective_mass: Three; kinetic_energy: Record<string, number>; shape: Span }[];
  mass: number;
  remarks: string[];
}

/** Numbers: a value a row, NaN where there is none. `codes` a row: the place in `statuses`. */
export interface Sweep {
  rows: [first: number, end: number];
  total: number;
  measure: string;
  unit: string;
  values: Span;
  codes: Span;
  statuses: Status[];
}

export interface Measure { name: string; words: string; unit: string }
export interface Beginning { name: string; text: string }

export interface Answers {
  load: Loaded;
  set: Loaded;
  values: Value[];
  /** The object of `solve --format json`. */
  solve: Record<string, unknown>;
  scene: Scene;
  frame: Frame;
  place: Placed;
  modes: Modes;
  sweep: Sweep;
  measures: Measure[];
  schema: object;
  beginnings: Beginning[];
  format: { text: string };
  write: { text: string };
}

/** The core, live or of answers that were worked out beforehand. */
export interface Core {
  /** Whether it works out anything, or has only what stands in the page. */
  readonly live: boolean;
  /** Throws `Refused` with the problem, where there is one. */
  ask<R extends Request>(request: R): Answer<Answers[R["ask"]]>;
}
