// What the page knows: the file, the pose, the answers to it. Views listen; nothing here draws.

import { Background, Dropped } from './background';
import type { Along, Coordinate, Core, Frame, Loaded, Pose, Problem, Request, Scene, Six, Value } from './core';
import type { Data } from './data';
import type { Part } from './scene/mechanism';
import { open, Refused } from './wasm';
import type { Setup } from './worker';

/** Events, with what they carry. */
interface Events {
  /** Another file or job is shown. */
  loaded: Loaded;
  /** Another scene is to be drawn: a file, a job, a case or a value changed. */
  scene: { scene: Scene; numbers: Float64Array };
  frame: { frame: Frame; numbers: Float64Array; dragging: boolean };
  /** What is wrong with the text, or `null` where nothing is. */
  problem: Problem | null;
  /** The whole answer with its why, some time after the pose came to rest; `null` when it is out of date. */
  answer: Solved | null;
  part: Part | null;
  values: void;
  text: string;
}

/** As much of `solve --format json --why` as the page shows. */
export interface Solved {
  mobility?: number;
  overconstraint?: number;
  warnings?: (string | { message?: string })[];
  output?: { node: string; rigid_directions?: unknown[]; free_motions?: unknown[] };
  displacements?: Record<string, Six>;
  joints?: Record<string, { wrench: Six | null }>;
  segments?: { body: string; points: [string, string]; stress?: { von_mises: number | null } | null }[];
  bodies?: Record<string, { worst?: { von_mises: number | null; at: number; segment: [string, string]; utilisation: number | null } | null }>;
  budget?: Frame['budget'];
  sensitivities?: Sensitivity[];
  modes?: { frequency: number }[];
  measures?: Record<string, unknown> & { condition?: number };
}

export interface Sensitivity {
  parameter: string;
  path?: string;
  value: number;
  relative: number | null;
}

/** [ms] */
const SLOW = 9;

type Listener<E extends keyof Events> = (what: Events[E]) => void;

export type Coordinates = Partial<Record<Coordinate, number>>;

export class App {
  readonly core: Core;
  readonly data: Data | null;
  readonly background: Background;
  /** A worker for maps alone: sensitivities may take longer than one waits for a map. */
  readonly mapping: Background;
  readonly #module: WebAssembly.Module | null;
  /** The core itself: another one after a bug. */
  #opened: Core;
  #traps = 0;
  #aside: Promise<Core> | null = null;
  readonly #listeners = new Map<string, Listener<never>[]>();

  text = '';
  main = 'mechanism.ron';
  files: Record<string, string> = {};
  loaded: Loaded | null = null;
  scene: Scene | null = null;
  frame: Frame | null = null;
  numbers: Float64Array = new Float64Array();
  /** The pose that is shown; without one that of the file or job. */
  pose: Pose | undefined;
  caseName: string | undefined;
  along: Along | undefined;
  part: Part | null = null;
  solved: Solved | null = null;
  /** Values that were changed, by path. */
  readonly changed = new Map<string, number>();
  #setup: Setup | null = null;
  #rest = 0;

  constructor(core: Core, module: WebAssembly.Module | null, data: Data | null) {
    this.#opened = core;
    this.core = { live: core.live, ask: (request) => this.#ask(request) };
    this.data = data;
    this.#module = module;
    this.background = new Background(module, core.live ? null : core);
    this.mapping = new Background(module, core.live ? null : core);
  }

  #ask<R extends Request>(request: R): ReturnType<typeof this.core.ask<R>> {
    try {
      return this.#opened.ask(request);
    } catch (error) {
      if (!(error instanceof WebAssembly.RuntimeError) || !this.#module) {
        throw error;
      }
      // A trap is a bug of the core, whose memory is good for nothing any more.
      this.#traps += 1;
      void open(this.#module).then((core) => {
        this.#opened = core;
        // A file that stops it each time is not read again.
        if (this.#traps < 3) {
          this.load(this.text);
        }
      });
      const message = 'the core met a bug, and begins anew';
      throw new Refused({ code: 'bug', message, help: 'please report the file that it came from', path: null, line: null, column: null, length: null });
    }
  }

  on<E extends keyof Events>(event: E, listener: Listener<E>): void {
    this.#listeners.set(event, [...(this.#listeners.get(event) ?? []), listener as Listener<never>]);
  }

  #tell<E extends keyof Events>(event: E, what: Events[E]): void {
    for (const listener of this.#listeners.get(event) ?? []) {
      (listener as Listener<E>)(what);
    }
  }

  /** What requests in the background are asked of. */
  get setup(): Setup {
    return this.#setup ?? { load: this.#load({}), values: [] };
  }

  /** Reads a text; what was shown stays where it is refused. */
  load(text: string, wanted: { main?: string; files?: Record<string, string>; job?: string; design?: number; pose?: number; keep?: boolean } = {}): boolean {
    const keep = wanted.keep === true && this.loaded !== null;
    this.text = text;
    this.main = wanted.main ?? this.main;
    this.files = { ...(wanted.files ?? this.files), [this.main]: text };
    const job = wanted.job ?? (keep ? (this.loaded?.job ?? undefined) : undefined);
    const design = wanted.design ?? (keep ? (this.loaded?.design ?? undefined) : undefined);
    const load = this.#load({
      ...(job === undefined ? {} : { job }),
      ...(design === undefined ? {} : { design }),
      ...(wanted.pose === undefined ? {} : { pose: wanted.pose }),
    });
    try {
      this.#open(load, keep);
    } catch (error) {
      const problem = refusal(error);
      // The job that was shown may have gone from the batch: its first is taken.
      if (keep && ((job !== undefined && !text.includes(`"${job}"`)) || (design ?? 0) > 0)) {
        return this.load(text, { ...wanted, keep: false });
      }
      this.#tell('problem', problem);
      return false;
    }
    this.#traps = 0;
    this.#tell('problem', this.loaded?.problem ?? null);
    return true;
  }

  #load(more: { job?: string; design?: number; pose?: number }): Setup['load'] {
    const recorded = this.data && !this.core.live ? this.data.load : null;
    return recorded ?? { ask: 'load', files: this.files, main: this.main, ...more };
  }

  #open(load: Setup['load'], keep: boolean): void {
    const { value: loaded } = this.core.ask(load);
    const before = this.loaded;
    const [pose, changed, chosen] = [this.pose, [...this.changed], this.part];
    this.loaded = loaded;
    this.here = null;
    this.#setup = { load, values: [] };
    this.values = this.#values();
    this.changed.clear();
    const same = keep && before?.coordinates.map(({ name }) => name).join() === loaded.coordinates.map(({ name }) => name).join();
    this.pose = same ? pose : undefined;
    this.caseName = keep && this.caseName !== undefined && loaded.cases.includes(this.caseName) ? this.caseName : undefined;
    this.part = null;
    if (same && changed.length > 0) {
      this.#set(changed, true);
    }
    this.#tell('loaded', loaded);
    this.rescene();
    if (this.frame && this.frame.status !== 'ok' && this.pose) {
      this.go(undefined);
    }
    if (chosen && keep) {
      this.#choose(chosen.kind, chosen.name);
    }
  }

  /** Another job, pose or design of the same text. */
  job(job: string, design?: number): boolean {
    return this.load(this.text, { job, ...(design === undefined ? {} : { design }) });
  }

  /** Asks for the scene anew: a case or a value changed. */
  rescene(): void {
    const pose = this.pose;
    const about = this.caseName === undefined ? {} : { case: this.caseName };
    let answer: { value: Scene; numbers: Float64Array };
    try {
      answer = this.core.ask({ ask: 'scene', ...(pose ? { pose } : {}), ...about });
    } catch (error) {
      if (!pose) {
        throw error;
      }
      this.pose = undefined;
      answer = this.core.ask({ ask: 'scene', ...about });
    }
    this.scene = answer.value;
    this.numbers = answer.numbers;
    this.#tell('scene', { scene: answer.value, numbers: answer.numbers });
    this.go(this.pose);
  }

  /** Where the output stands: the whole pose of the last frame that was reached. */
  here: Six | null = null;

  /** A whole frame of this mechanism takes too long for every step of a drag [ms]. */
  #took = 0;
  #whole = true;

  /** Shows another pose. What is not reached is told by the frame's status, and the scene stays. */
  go(wanted: Pose | undefined, dragging = false): Frame | null {
    const pose = !this.core.live && wanted && 'at' in wanted ? this.#nearest(wanted.at) : wanted;
    let answer: { value: Frame; numbers: Float64Array };
    const light = dragging && this.#took > SLOW;
    const begun = performance.now();
    try {
      answer = this.core.ask({
        ask: 'frame',
        ...(light ? { light } : {}),
        ...(pose ? { pose } : {}),
        ...(this.caseName === undefined ? {} : { case: this.caseName }),
        ...(this.along === undefined ? {} : { along: this.along }),
      });
    } catch (error) {
      this.#tell('problem', refusal(error));
      return null;
    }
    const frame = answer.value;
    if (frame.layout && !light) {
      this.#took = performance.now() - begun;
    }
    if (light) {
      // What a light frame leaves out stays as it was; the whole one comes when the pose is at rest.
      frame.budget ??= this.frame?.budget ?? null;
      frame.frequencies = frame.frequencies.length > 0 ? frame.frequencies : (this.frame?.frequencies ?? []);
      this.#whole = false;
    } else {
      this.#whole = true;
    }
    this.here = frame.pose ?? this.here;
    if (frame.layout) {
      this.pose = pose;
      this.numbers = answer.numbers;
    }
    this.frame = frame;
    this.#tell('frame', { frame, numbers: answer.numbers, dragging });
    this.#later(dragging ? 220 : 30);
    return frame;
  }

  /** Asks for the whole answer when the pose has come to rest. */
  #later(wait: number): void {
    clearTimeout(this.#rest);
    if (this.solved) {
      this.solved = null;
      this.#tell('answer', null);
    }
    this.#rest = window.setTimeout(() => void this.#why(), wait);
  }

  async #why(): Promise<void> {
    if (!this.#whole) {
      // Which comes back here, some time after.
      this.go(this.pose);
      return;
    }
    const request = {
      ask: 'solve' as const,
      ...(this.pose ? { pose: this.pose } : {}),
      ...(this.caseName === undefined ? {} : { case: this.caseName }),
      ...(this.along === undefined ? {} : { along: this.along }),
      why: true,
    };
    const stored = this.core.live ? null : this.stored(this.caseName, true);
    if (stored && this.pose) {
      // It is that of the pose loaded, not of this one.
      return;
    }
    try {
      const value = stored ?? (await this.background.ask(this.setup, request, 'why', 5)).value;
      this.solved = value as Solved;
      this.#tell('answer', this.solved);
    } catch (error) {
      if (!(error instanceof Dropped) && !(error instanceof Refused)) {
        throw error;
      }
    }
  }

  /** The answer of `solve` that stands in the page: of the pose loaded, of a case. */
  stored(name?: string, why = false): object | null {
    const own = this.data?.answers.filter(({ request }) => request.ask === 'solve' && request.pose === undefined && request.case === name) ?? [];
    const found = own.find(({ request }) => request.ask === 'solve' && (request.why === true) === why) ?? own[0];
    return (found?.value as object | undefined) ?? null;
  }

  /** Whether the output can be moved: anywhere by the live core, else among the poses that the page has. */
  get moves(): boolean {
    return this.loaded !== null && this.loaded.coordinates.length > 0 && (this.core.live || this.#recordedPoses.length > 1);
  }

  get #recordedPoses(): Coordinates[] {
    return (this.data?.poses ?? []).flatMap(({ pose }) => ('at' in pose ? [pose.at] : []));
  }

  /** Of the poses that the page has, the nearest one; a radian counts as the size. */
  #nearest(wanted: Coordinates): Pose {
    const size = this.loaded?.size ?? 1;
    const away = (at: Coordinates): number =>
      Object.entries(at).reduce((sum, [name, value]) => sum + ((value - (wanted[name as Coordinate] ?? value)) * (name.startsWith('r') ? size : 1)) ** 2, 0);
    const all = this.#recordedPoses;
    return { at: all.reduce((best, at) => (away(at) < away(best) ? at : best), all[0] ?? wanted) };
  }

  /** The object of `solve --format json` for the job and pose shown, of another text where one is given. */
  async solve(text?: string): Promise<object> {
    if (!this.core.live || !this.#module) {
      if (text !== undefined) {
        throw new Error(`this page has no live core: ${this.data?.live ?? ''}`);
      }
      const stored = this.stored();
      if (!stored) {
        throw new Error('this page has no answer of its own');
      }
      return stored;
    }
    if (text === undefined) {
      return this.core.ask({ ask: 'solve', ...(this.pose ? { pose: this.pose } : {}) }).value;
    }
    this.#aside ??= open(this.#module);
    const aside = await this.#aside;
    const { load } = this.setup;
    aside.ask({ ...load, files: { ...load.files, [load.main]: text } });
    return aside.ask({ ask: 'solve', ...(this.pose ? { pose: this.pose } : {}) }).value;
  }

  choose(part: Part | null): void {
    this.part = part;
    this.#tell('part', part);
  }

  #choose(kind: Part['kind'], name: string): void {
    const scene = this.scene;
    const list = kind === 'body' ? scene?.bodies : kind === 'joint' ? scene?.joints : undefined;
    const index = list?.findIndex((each) => each.name === name) ?? -1;
    if (index >= 0) {
      this.choose({ kind, index, name, words: '' });
    }
  }

  /** Changes a value by its path; `null` takes it back to that of the text. */
  set(path: string, value: number | null): void {
    const next = new Map(this.changed);
    if (value === null) {
      next.delete(path);
    } else {
      next.set(path, value);
    }
    this.#set([...next], false);
    this.#tell('values', undefined);
  }

  #set(values: [string, number][], quiet: boolean): void {
    try {
      this.core.ask({ ask: 'set', values });
    } catch (error) {
      if (!quiet) {
        this.#tell('problem', refusal(error));
      }
      return;
    }
    this.changed.clear();
    for (const [path, value] of values) {
      this.changed.set(path, value);
    }
    if (this.#setup) {
      this.#setup = { ...this.#setup, values };
    }
    if (!quiet) {
      this.#tell('problem', null);
      this.rescene();
    }
  }

  /** Values that can be changed, with those of the text. */
  values: readonly Value[] = [];

  #values(): Value[] {
    try {
      return this.core.ask({ ask: 'values' }).value;
    } catch (error) {
      refusal(error);
      return [];
    }
  }

  inCase(name: string | undefined): void {
    this.caseName = name;
    this.rescene();
  }

  inDirection(along: Along | undefined): void {
    this.along = along;
    this.go(this.pose);
  }
}

/** The problem of a request that was refused; other errors are thrown on. */
export function refusal(error: unknown): Problem {
  if (error instanceof Refused) {
    return error.problem;
  }
  throw error;
}
