// A plane of the workspace as a heat map, in the scene and beside it, filled progressively by the worker.

import * as THREE from 'three';
import type { App, Coordinates } from '../app';
import { Dropped, type Timed } from '../background';
import type { Axis, Coordinate, Measure, Request, Status, Sweep as SweepAnswer } from '../core';
import { fill, h, say } from '../dom';
import { number, withPrefix } from '../format';
import { colour, gradient } from '../scene/colours';
import { HeatPlane } from '../scene/overlays';
import type { Stage } from '../scene/stage';
import { coordinates, movable } from '../scene/drag';
import { Refused } from '../wasm';

type Sweep = Extract<Request, { ask: 'sweep' }>;

/** Rows that are asked for at first, and how long the later pieces are to take [ms]: other requests come between them. */
const FIRST = 256;
const PIECE = 60;
/** Between pictures of a map that is not done [ms]. */
const PICTURE = 160;
const NAMES: Coordinate[] = ['x', 'y', 'z', 'rx', 'ry', 'rz'];

export class MapPanel {
  readonly element = h('div', { class: 'map' });
  readonly #app: App;
  readonly #stage: Stage;
  readonly #measure = h('select', { 'aria-label': 'What the map shows' });
  readonly #plane = h('select', { 'aria-label': 'Plane of the map' });
  readonly #count = h('select', { 'aria-label': 'Resolution' });
  readonly #ranges = h('div', { class: 'ranges' });
  #given: Record<string, [number, number]> = {};
  #fresh = true;
  /** Whether a person chose the scale: else it follows from the numbers. */
  #chosen = false;
  readonly #log = h('input', { type: 'checkbox' });
  readonly #inScene = h('input', { type: 'checkbox', checked: true });
  readonly #canvas = h('canvas', { width: 320, height: 320, role: 'img', tabindex: 0 });
  readonly #told = h('p', { class: 'told', role: 'status' });
  readonly #ends = h('div', { class: 'legend-ends' });
  readonly #progress = h('progress', { max: 1, value: 0, hidden: true, 'aria-label': 'Part of the map that is done' });
  readonly #axes = h('p', { class: 'note' });
  #measures: Measure[] = [];
  #request: Sweep | null = null;
  #values = new Float64Array();
  #codes = new Float64Array();
  #statuses: Status[] = [];
  #range: [number, number] = [0, 1];
  #heat: HeatPlane | null = null;
  #run = 0;
  #visible = false;
  #stale = true;
  #wait = 0;
  #marking = 0;

  constructor(app: App, stage: Stage) {
    this.#app = app;
    this.#stage = stage;
    for (const count of [21, 41, 61, 101]) {
      this.#count.append(h('option', { value: count, selected: count === 61 }, `${count} × ${count}`));
    }
    this.#plane.addEventListener('change', () => this.#ask());
    for (const input of [this.#measure, this.#plane, this.#count]) {
      input.addEventListener('change', () => this.again(0));
    }
    this.#log.addEventListener('change', () => {
      this.#chosen = true;
      this.#paint();
    });
    this.#measure.addEventListener('change', () => (this.#chosen = false));
    this.#inScene.addEventListener('change', () => this.#paint());
    this.#canvas.addEventListener('pointermove', (event) => this.#hover(event));
    this.#canvas.addEventListener('pointerleave', () => this.#state());
    this.#canvas.addEventListener('click', (event) => this.#take(event));
    fill(
      this.element,
      h('div', { class: 'line' }, this.#measure),
      h('div', { class: 'line' }, this.#plane, this.#count),
      this.#ranges,
      h('div', { class: 'line' }, h('label', {}, this.#inScene, ' in the scene'), h('label', {}, this.#log, ' logarithmic')),
      this.#progress,
      this.#canvas,
      this.#axes,
      h('div', { class: 'legend-bar', style: `background: ${gradient('map')}` }),
      this.#ends,
      this.#told,
      app.core.live ? h('p', { class: 'note' }, 'A click brings the output there. White is out of reach.') : null,
    );
    app.on('loaded', () => (this.#fresh = true));
    app.on('frame', () => this.#moved());
    app.on('scene', ({ scene }) => {
      if (this.#fresh) {
        this.#fresh = false;
        this.#offer(scene.loads.length + scene.lines.length > 0 || scene.gravity !== null);
      }
      this.#stale = true;
      this.again(120);
    });
  }

  show(visible: boolean): void {
    this.#visible = visible;
    if (visible && this.#stale) {
      this.again(0);
    }
    this.#paint();
  }

  /** What can be mapped: measures, and planes of the coordinates by which the output is moved. */
  #offer(loaded: boolean): void {
    const [measure, plane] = [this.#measure.value, this.#plane.value];
    const maps = this.#app.core.live ? null : (this.#app.data?.maps ?? []);
    try {
      this.#measures = this.#app.core.ask({ ask: 'measures' }).value;
    } catch {
      this.#measures = [];
    }
    const offered = maps ? this.#measures.filter(({ name }) => maps.some((map) => map.measure === name)) : this.#measures;
    fill(this.#measure, ...offered.map(({ name, words, unit }) => h('option', { value: name, title: words }, `${words} [${unit || '–'}]`)));
    const names = [...movable(this.#app)];
    const pairs = maps
      ? [...new Set(maps.map(({ axes }) => axes.map(({ name }) => name).join(' ')))]
      : names.flatMap((a, k) => names.slice(k + 1).map((b) => `${a} ${b}`));
    if (!maps && names.length === 1) {
      pairs.push(names[0] as string);
    }
    fill(this.#plane, ...pairs.map((pair) => h('option', { value: pair }, pair.replace(' ', ' – '))));
    this.#count.hidden = maps !== null;
    // Without loads there is no deflection to map.
    const wanted = measure || (loaded ? 'deflection' : 'pure_force_stiffness_min');
    this.#measure.value = offered.some(({ name }) => name === wanted) ? wanted : (offered[0]?.name ?? '');
    this.#plane.value = pairs.includes(plane) ? plane : (pairs[0] ?? '');
    this.#given = {};
    this.#ask();
    this.#stale = true;
  }

  /** From where to where a coordinate goes: what was given, or more than the poses of the job. */
  #reach(name: Coordinate): [number, number] {
    const own = this.#app.loaded?.coordinates.find((each) => each.name === name);
    const [from, to] = [own?.from ?? -1, own?.to ?? 1];
    const spare = 0.15 * (to - from);
    return this.#given[name] ?? [from - spare, to + spare];
  }

  /** Fields for the ranges of both coordinates. */
  #ask(): void {
    const names = this.#app.core.live ? (this.#plane.value.split(' ').filter(Boolean) as Coordinate[]) : [];
    const field = (name: Coordinate, end: 0 | 1): HTMLInputElement => {
      const input = h('input', { class: 'field', inputmode: 'decimal', value: number(this.#reach(name)[end], 4), 'aria-label': `${name} ${end === 0 ? 'from' : 'to'}` });
      input.addEventListener('change', () => {
        const value = Number(input.value.replace('−', '-'));
        const next: [number, number] = [...this.#reach(name)];
        next[end] = value;
        const good = Number.isFinite(value) && next[0] < next[1];
        input.setAttribute('aria-invalid', String(!good));
        if (good) {
          this.#given[name] = next;
          this.again(0);
        }
      });
      return input;
    };
    fill(this.#ranges, ...names.flatMap((name) => [h('span', {}, name), field(name, 0), h('span', {}, '…'), field(name, 1), h('span', { class: 'unit' }, name.startsWith('r') ? 'rad' : 'm')]));
  }

  #wanted(): Sweep | null {
    const [measure, names] = [this.#measure.value, this.#plane.value.split(' ').filter(Boolean) as Coordinate[]];
    if (!measure || names.length === 0) {
      return null;
    }
    if (!this.#app.core.live) {
      const found = this.#app.data?.maps.find((map) => map.measure === measure && map.axes.map(({ name }) => name).join(' ') === names.join(' '));
      return found ?? null;
    }
    const axes = names.map((name): Axis => {
      const [first, last] = this.#reach(name);
      return { name, first, last, count: Number(this.#count.value) };
    });
    const here = this.#app.here;
    const fixed: Coordinates = here ? coordinates(this.#app, here, {}) : {};
    for (const name of names) {
      delete fixed[name];
    }
    const about = this.#app.caseName === undefined ? {} : { case: this.#app.caseName };
    return { ask: 'sweep', axes, fixed, measure, ...about };
  }

  /** The output moved: its mark with it, and where it left the plane of the map, another map. */
  #moved(): void {
    if (!this.#visible || !this.#request || this.#marking !== 0) {
      return;
    }
    this.#marking = window.setTimeout(() => {
      this.#marking = 0;
      const fixed = this.#request?.fixed ?? {};
      const next = this.#wanted()?.fixed ?? {};
      const size = this.#app.loaded?.size ?? 1;
      const left = Object.entries(next).some(([name, value]) => Math.abs(value - (fixed[name as Coordinate] ?? value)) > 1e-6 * size);
      if (left && this.#app.core.live) {
        this.again(0);
      } else if (this.#request) {
        this.#picture(this.#request);
      }
    }, 120);
  }

  /** Works the map out anew, after a while. */
  again(wait: number): void {
    clearTimeout(this.#wait);
    this.#wait = window.setTimeout(() => {
      if (this.#visible) {
        void this.#work();
      }
    }, wait);
  }

  async #work(): Promise<void> {
    const request = this.#wanted();
    const run = ++this.#run;
    this.#stale = false;
    this.#request = request;
    this.#drop();
    if (!request) {
      say(this.#told, this.#app.core.live ? 'Nothing of it moves: there is no map.' : 'This page holds no map of it.');
      return;
    }
    const total = request.axes.reduce((product, axis) => product * axis.count, 1);
    this.#values = new Float64Array(total).fill(Number.NaN);
    this.#codes = new Float64Array(total).fill(-1);
    this.#range = [0, 1];
    const begun = performance.now();
    this.#progress.hidden = false;
    try {
      let painted = begun;
      let piece = FIRST;
      let asked = 0;
      const next = (): Promise<Timed<SweepAnswer>> | null => {
        const rows: [number, number] = [asked, Math.min(asked + piece, total)];
        asked = this.#app.core.live ? rows[1] : total;
        return rows[0] >= total ? null : this.#app.mapping.ask(this.#app.setup, { ...request, ...(this.#app.core.live ? { rows } : {}) }, '', 1);
      };
      for (let waiting = next(); waiting; ) {
        const { value, numbers, took } = await waiting;
        if (run !== this.#run) {
          return;
        }
        const [first, last] = value.rows;
        piece = Math.round(Math.min(Math.max(((last - first) * PIECE) / Math.max(took, 1), 64), 8 * piece));
        // The worker has the next piece before this one is painted.
        waiting = next();
        this.#values.set(numbers.subarray(value.values[0], value.values[0] + last - first), first);
        this.#codes.set(numbers.subarray(value.codes[0], value.codes[0] + last - first), first);
        this.#statuses = value.statuses;
        this.#progress.value = last / total;
        const now = performance.now();
        if (now - painted > PICTURE && waiting) {
          painted = now;
          this.#paint();
        }
      }
      this.#paint();
      performance.measure('hyperstat map', { start: begun, end: performance.now(), detail: { poses: total } });
    } catch (error) {
      if (error instanceof Refused) {
        say(this.#told, error.problem.message);
      } else if (!(error instanceof Dropped)) {
        throw error;
      }
    } finally {
      if (run === this.#run) {
        this.#progress.hidden = true;
        this.#state();
      }
    }
  }

  #drop(): void {
    if (this.#heat) {
      this.#stage.viewer.scene.remove(this.#heat.mesh);
      this.#heat.dispose();
      this.#heat = null;
    }
  }

  #scale(value: number): number {
    const [low, high] = this.#range;
    if (this.#log.checked && low > 0) {
      return Math.log(value / low) / (Math.log(high / low) || 1);
    }
    return (value - low) / (high - low || 1);
  }

  #paint(): void {
    const request = this.#request;
    if (!request || this.#values.length === 0) {
      return;
    }
    const known = this.#values.filter((value) => Number.isFinite(value)).sort();
    // Beside a singular pose a few values are out of all proportion: the colours end at the 98th percentile.
    const [low, high] = [known[0] ?? 0, known[Math.floor(0.98 * (known.length - 1))] ?? 1];
    this.#range = [low, high];
    if (!this.#chosen) {
      this.#log.checked = low > 0 && high > 12 * low;
    }
    const unit = this.#unit();
    fill(this.#ends, ...[low, this.#middle(), high].map((value, k) => h('span', {}, `${k === 2 && (known.at(-1) ?? 0) > high ? '≥ ' : ''}${withPrefix(value, unit, 3)}`)));
    this.#picture(request);
    this.#plane3(request);
    this.#state();
    this.#stage.viewer.draw();
  }

  #middle(): number {
    const [low, high] = this.#range;
    return this.#log.checked && low > 0 ? Math.sqrt(low * high) : (low + high) / 2;
  }

  #unit(): string {
    return this.#measures.find(({ name }) => name === this.#request?.measure)?.unit ?? '';
  }

  #picture(request: Sweep): void {
    const [columns, rows] = [request.axes[0]?.count ?? 1, request.axes[1]?.count ?? 1];
    const image = new ImageData(columns, rows);
    const rgb: [number, number, number] = [0, 0, 0];
    for (let k = 0; k < this.#values.length; k++) {
      const value = this.#values[k] as number;
      const to = 4 * ((rows - 1 - Math.floor(k / columns)) * columns + (k % columns));
      if (Number.isFinite(value)) {
        colour('map', this.#scale(value), rgb, 0);
        rgb.forEach((part, c) => (image.data[to + c] = Math.round(255 * part)));
        image.data[to + 3] = 255;
      }
    }
    const small = h('canvas', { width: columns, height: rows });
    small.getContext('2d')?.putImageData(image, 0, 0);
    const [x, y] = request.axes;
    const ratio = x && y ? Math.abs((y.last - y.first) / (x.last - x.first || 1)) : 0.2;
    const alike = x && y && x.name.length === y.name.length ? ratio : 1;
    this.#canvas.width = 340;
    this.#canvas.height = Math.round(340 * Math.min(Math.max(alike, 0.12), 1.1));
    const context = this.#canvas.getContext('2d');
    if (context) {
      context.imageSmoothingEnabled = false;
      context.drawImage(small, 0, 0, this.#canvas.width, this.#canvas.height);
      this.#cross(context, request);
    }
    const told = (axis: Axis): string => `${axis.name} ${number(axis.first, 3)} … ${number(axis.last, 3)} ${axis.name.startsWith('r') ? 'rad' : 'm'}`;
    say(this.#axes, request.axes.map((axis, k) => `${k === 0 ? '→' : '↑'} ${told(axis)}`).join('   '));
    this.#canvas.setAttribute('aria-label', `Map of ${this.#measure.selectedOptions[0]?.textContent ?? ''} over ${request.axes.map(told).join(' and ')}`);
  }

  /** Where the output is. */
  #cross(context: CanvasRenderingContext2D, request: Sweep): void {
    const here = this.#app.here;
    if (here) {
      const [x, y] = [0, 1].map((k) => {
        const axis = request.axes[k];
        return axis ? ((here[NAMES.indexOf(axis.name)] as number) - axis.first) / (axis.last - axis.first || 1) : 0.5;
      }) as [number, number];
      const at: [number, number] = [x * this.#canvas.width, (1 - y) * this.#canvas.height];
      for (const [width, style] of [[5, '#ffffff'], [2, '#cc3d8f']] as const) {
        context.lineWidth = width;
        context.strokeStyle = style;
        context.beginPath();
        context.arc(...at, 6, 0, 2 * Math.PI);
        context.stroke();
      }
    }
  }

  #plane3(request: Sweep): void {
    const [a, b] = request.axes;
    const shown = this.#visible && this.#inScene.checked && a !== undefined && b !== undefined && a.name.length === 1 && b.name.length === 1;
    if (!shown || !a || !b) {
      this.#drop();
      this.#stage.viewer.draw();
      return;
    }
    if (!this.#heat) {
      const fixed = request.fixed ?? {};
      const here = this.#app.here;
      const corner = new THREE.Vector3(fixed.x ?? here?.[0], fixed.y ?? here?.[1], fixed.z ?? here?.[2]);
      const [ka, kb] = [NAMES.indexOf(a.name), NAMES.indexOf(b.name)];
      corner.setComponent(ka, a.first).setComponent(kb, b.first);
      const side = (k: number, axis: Axis): THREE.Vector3 => new THREE.Vector3().setComponent(k, axis.last - axis.first);
      this.#heat = new HeatPlane(corner, side(ka, a), side(kb, b), a.count, b.count);
      this.#stage.viewer.scene.add(this.#heat.mesh);
    }
    this.#heat.paint(this.#values, (value) => this.#scale(value));
  }

  /** Row and coordinates below the pointer. */
  #at(event: MouseEvent): { row: number; pose: Coordinates } | null {
    const request = this.#request;
    const [a, b] = request?.axes ?? [];
    if (!a || this.#values.length === 0) {
      return null;
    }
    const { width, height } = this.#canvas.getBoundingClientRect();
    const place = (axis: Axis | undefined, t: number): number => (axis ? Math.min(Math.max(Math.floor(t * axis.count), 0), axis.count - 1) : 0);
    const [i, j] = [place(a, event.offsetX / width), place(b, 1 - event.offsetY / height)];
    const value = (axis: Axis, k: number): number => axis.first + ((axis.last - axis.first) * k) / Math.max(axis.count - 1, 1);
    const pose: Coordinates = { [a.name]: value(a, i), ...(b ? { [b.name]: value(b, j) } : {}) };
    return { row: i + j * a.count, pose };
  }

  #hover(event: PointerEvent): void {
    const found = this.#at(event);
    if (found) {
      const value = this.#values[found.row] as number;
      const where = Object.entries(found.pose).map(([name, at]) => `${name} ${number(at, 3)}`).join(', ');
      const status = this.#statuses[this.#codes[found.row] as number] ?? '';
      say(this.#told, `${where}: ${Number.isFinite(value) ? withPrefix(value, this.#unit()) : status || '…'}`);
    }
  }

  #take(event: MouseEvent): void {
    const found = this.#at(event);
    if (found && this.#app.core.live) {
      this.#stage.drag.ask({ ...this.#request?.fixed, ...found.pose });
      requestAnimationFrame(() => requestAnimationFrame(() => this.#paint()));
    }
  }

  #state(): void {
    const done = this.#codes.filter((code) => code >= 0).length;
    const good = this.#values.filter((value) => Number.isFinite(value)).length;
    const least = this.#values.reduce((a, b) => (Number.isFinite(b) && b < a ? b : a), Number.POSITIVE_INFINITY);
    const most = this.#values.reduce((a, b) => (Number.isFinite(b) && b > a ? b : a), Number.NEGATIVE_INFINITY);
    const span = good > 0 ? `; ${withPrefix(least, this.#unit())} to ${withPrefix(most, this.#unit())}` : '';
    say(this.#told, done > 0 ? `${good} of ${done} poses reached${span}` : '');
  }
}
