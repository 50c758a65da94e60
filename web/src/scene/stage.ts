// The scene of the page: draws what the application tells, and answers pointer and keys.

import * as THREE from 'three';
import type { App } from '../app';
import { fill, h } from '../dom';
import { withPrefix } from '../format';
import { gradient } from './colours';
import { Drag } from './drag';
import { type Label, Labels } from './labels';
import { type Colouring, Mechanism, type Part, type Shown } from './mechanism';
import { Path } from './overlays';
import { Viewer } from './viewer';

/** A shape of vibration to be shown moving: 3 numbers a vertex, the largest of which is 1. */
export interface Moving {
  shape: Float64Array;
  /** Largest movement as a share of the size. */
  amplitude: number;
}

const HANDLE = 11;

export class Stage {
  readonly viewer: Viewer;
  readonly drag: Drag;
  readonly element = h('div', { class: 'stage' });
  readonly legend = h('div', { class: 'legend', role: 'img' });
  readonly labels = new Labels();
  readonly shown: Shown = {
    joints: true,
    ground: true,
    loads: true,
    weights: true,
    frames: true,
    ghost: true,
    translational: true,
    rotational: false,
  };
  mechanism: Mechanism | null = null;
  /** Times displacements are shown. */
  factor = 1;
  /** The factor that suits the deflection. */
  auto = 1;
  colouring: Colouring = 'plain';
  namesShown = false;
  readonly #app: App;
  readonly #tip = h('div', { class: 'tip', role: 'status', hidden: true });
  readonly #reach = h('div', { class: 'reach', role: 'alert', hidden: true });
  readonly #handle: THREE.Sprite;
  readonly #ghostHandle: THREE.Sprite;
  readonly #leash = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineDashedMaterial({ color: '#d55e00', dashSize: 0.02, gapSize: 0.015 }));
  readonly #path = new Path('#7b8494');
  readonly #deflected = new Path('#d55e00');
  #moving: Moving | null = null;
  #clock = 0;
  #still = false;
  #fresh = true;
  #name = '';
  /** Called when the factor or the legend changed. */
  onchange: () => void = () => {};

  constructor(app: App) {
    this.#app = app;
    this.viewer = new Viewer(this.element);
    this.drag = new Drag(app, this.viewer, () => this.mechanism);
    this.#handle = new THREE.Sprite(new THREE.SpriteMaterial({ map: ring('#cc3d8f'), depthTest: false, transparent: true }));
    this.#ghostHandle = new THREE.Sprite(new THREE.SpriteMaterial({ map: ring('#d55e00'), depthTest: false, transparent: true }));
    this.#handle.renderOrder = this.#ghostHandle.renderOrder = 10;
    this.#leash.frustumCulled = false;
    this.#leash.visible = this.#ghostHandle.visible = false;
    this.viewer.scene.add(this.#handle, this.#ghostHandle, this.#leash, this.#path.line, this.#deflected.line);
    this.element.append(this.labels.layer, this.#tip, this.#reach, this.legend);
    this.viewer.onframe = () => this.#before();
    this.drag.onstep = () => this.#reached();
    app.on('scene', ({ scene, numbers }) => this.#draw(scene, numbers));
    app.on('frame', ({ frame, numbers, dragging }) => {
      if (dragging) {
        this.#tip.hidden = true;
      }
      this.mechanism?.take(frame, numbers);
      if (this.#fresh) {
        this.#fresh = false;
        this.suit();
      }
      this.refresh();
    });
    app.on('part', (part) => {
      if (this.mechanism) {
        this.mechanism.chosen = part;
        this.mechanism.paint();
        this.names(this.namesShown);
      }
    });
    this.#listen();
  }

  #draw(scene: Mechanism['scene'], numbers: Float64Array): void {
    const before = this.mechanism;
    if (before) {
      this.viewer.scene.remove(before.group);
      before.dispose();
    }
    const mechanism = new Mechanism(scene, numbers, this.shown);
    mechanism.colouring = this.colouring;
    mechanism.chosen = this.#app.part;
    this.mechanism = mechanism;
    this.viewer.scene.add(mechanism.group);
    this.#moving = null;
    const points = mechanism.extent();
    const middle = new THREE.Box3().setFromPoints(points).getCenter(new THREE.Vector3());
    const below = weight(scene.gravity);
    const lowest = Math.max(...points.map((point) => point.dot(below)));
    const centre = middle.addScaledVector(below, -middle.dot(below));
    this.viewer.bounds(points, { level: lowest, size: mechanism.scene.size, down: below, centre });
    this.#leash.material.dashSize = 0.03 * mechanism.scene.size;
    this.#leash.material.gapSize = 0.02 * mechanism.scene.size;
    // Another mechanism is looked at anew; after a change of a value one goes on looking from where one was.
    const name = `${this.#app.main} ${scene.name} ${this.#app.loaded?.job ?? ''}`;
    if (name !== this.#name || Math.abs(Math.log(mechanism.scene.size / (before?.scene.size ?? mechanism.scene.size))) > 0.5) {
      this.#name = name;
      this.#fresh = true;
      this.viewer.look('iso');
    }
    this.names(this.namesShown);
  }

  /** Chooses the factor that shows the deflection well: a nice number. */
  suit(): void {
    const mechanism = this.mechanism;
    if (mechanism) {
      let most = 0;
      for (let v = 0; v < mechanism.shape.vertices; v++) {
        most = Math.max(most, Math.hypot(...mechanism.shape.displacements.subarray(6 * v, 6 * v + 3).map((d) => (Number.isFinite(d) ? d : 0))));
      }
      const wanted = most > 0 ? (0.09 * mechanism.scene.size) / most : 1;
      const power = 10 ** Math.floor(Math.log10(wanted));
      this.auto = power * ([5, 2, 1].find((step) => step * power <= wanted) ?? 1);
      this.factor = this.auto;
      this.onchange();
    }
  }

  /** Brings the scene to the choices. */
  refresh(): void {
    const mechanism = this.mechanism;
    if (!mechanism) {
      return;
    }
    mechanism.colouring = this.colouring;
    mechanism.shape.mode = this.#moving?.shape ?? null;
    mechanism.shape.factor = this.#moving
      ? this.#moving.amplitude * mechanism.scene.size * (this.#still ? 1 : Math.sin(this.#clock))
      : this.factor;
    mechanism.refresh();
    this.#legend();
    this.viewer.draw();
  }

  /** Shows a mode moving, or `null` to show the loads again. */
  move(moving: Moving | null): void {
    const was = this.#moving !== null;
    this.#moving = moving;
    this.#still = matchMedia('(prefers-reduced-motion: reduce)').matches;
    if (moving && !was && !this.#still) {
      let last = performance.now();
      const step = (now: number): void => {
        if (this.#moving) {
          this.#clock += ((now - last) / 1000) * 2 * Math.PI * 0.7;
          last = now;
          this.refresh();
          requestAnimationFrame(step);
        }
      };
      requestAnimationFrame(step);
    }
    this.refresh();
  }

  get isMoving(): boolean {
    return this.#moving !== null;
  }

  /** Draws where the output is led along, and where it goes under load, `factor` times. */
  path(commanded: readonly (readonly number[])[], deflected: readonly (readonly number[])[]): void {
    this.#path.set(commanded);
    this.#deflected.set(deflected);
    this.viewer.draw();
  }

  /** Shows names of all parts, or those of the axes alone. */
  names(on: boolean): void {
    this.namesShown = on;
    const mechanism = this.mechanism;
    if (!mechanism) {
      return;
    }
    const { scene, shape } = mechanism;
    const labels: Label[] = [];
    ['x', 'y', 'z'].forEach((text, k) => {
      const at = new THREE.Vector3().setComponent(k, 0.24 * scene.size);
      labels.push({ text, kind: 'axis', at: () => at });
    });
    const falls = mechanism.gravityAt;
    if (falls && this.shown.weights) {
      labels.push({ text: 'g', kind: 'axis', at: () => falls });
    }
    if (on && this.shown.loads) {
      labels.push(...mechanism.loads().map(({ text, at }): Label => ({ text, kind: 'load', at })));
    }
    // With names off, the part that is chosen has its name all the same.
    const chosen = (kind: string, index: number): boolean => on || (mechanism.chosen?.kind === kind && mechanism.chosen.index === index);
    scene.joints.forEach(({ name, at }, k) => {
      if (chosen('joint', k)) {
        labels.push({ text: name, kind: 'joint', at: () => mechanism.nodeAt(at) });
      }
    });
    scene.bodies.forEach(({ name, segments, nodes }, k) => {
      if (chosen('body', k)) {
        const segment = segments.length > 0 ? scene.segments[segments[0] as number] : undefined;
        const v = segment ? segment.vertices[0] + Math.floor(segment.vertices[1] / 2) : nodes[0];
        if (v !== undefined) {
          labels.push({ text: name, kind: 'body', at: () => new THREE.Vector3(...shape.shown.subarray(3 * v, 3 * v + 3)) });
        }
      }
    });
    this.labels.set(this.shown.frames ? labels : labels.filter(({ kind }) => kind !== 'axis'));
    this.viewer.draw();
  }

  #before(): void {
    const mechanism = this.mechanism;
    const at = mechanism?.output();
    this.#handle.visible = at !== null && at !== undefined && this.drag.possible && !this.#moving;
    if (at) {
      this.#handle.position.copy(at);
      this.#handle.scale.setScalar(2 * HANDLE * this.viewer.pixel(at));
    }
    const target = this.drag.target;
    this.#ghostHandle.visible = this.#leash.visible = target !== null;
    if (target && at) {
      this.#ghostHandle.position.copy(target);
      this.#ghostHandle.scale.setScalar(2 * HANDLE * this.viewer.pixel(target));
      this.#leash.geometry.setFromPoints([at, target]);
      this.#leash.computeLineDistances();
    }
    this.labels.update(this.viewer);
  }

  /** Says whether the pose that was asked for is reached. */
  #reached(): void {
    const frame = this.#app.frame;
    const bad = frame !== null && frame.status !== 'ok';
    this.#reach.hidden = !bad || (frame.layout === null && !this.drag.active && this.drag.target === null);
    this.element.classList.toggle('out', bad && this.drag.active);
    if (!this.#reach.hidden) {
      fill(this.#reach, words(frame?.status ?? ''), frame?.problem ? h('span', {}, frame.problem.message) : null);
    }
  }

  #legend(): void {
    const legend = this.mechanism?.legend() ?? null;
    this.legend.hidden = legend === null;
    if (legend) {
      const told = (value: number): string =>
        legend.unit === '%' ? `${(100 * value).toFixed(0)} %` : legend.unit === '' ? value.toFixed(1) : withPrefix(value, legend.unit, 3);
      const middle = (legend.from + legend.to) / 2;
      this.legend.setAttribute('aria-label', `Colours: ${legend.title} from ${told(legend.from)} to ${told(legend.to)}`);
      fill(
        this.legend,
        h('div', { class: 'legend-title' }, legend.title),
        h('div', { class: 'legend-bar', style: `background: ${gradient(legend.ramp)}` }),
        h('div', { class: 'legend-ends' }, h('span', {}, told(legend.from)), h('span', {}, told(middle)), h('span', {}, told(legend.to))),
      );
    }
  }

  #listen(): void {
    const canvas = this.viewer.canvas;
    canvas.tabIndex = 0;
    canvas.setAttribute('role', 'application');
    canvas.setAttribute('aria-label', 'The mechanism in space. Arrow keys turn the view; with Alt they move the platform. Press ? for all keys.');
    let due = false;
    canvas.addEventListener('pointermove', (event) => {
      if (due || event.buttons !== 0) {
        return;
      }
      due = true;
      const [x, y] = [event.offsetX, event.offsetY];
      requestAnimationFrame(() => {
        due = false;
        this.#hover(x, y);
      });
    });
    canvas.addEventListener('pointerleave', () => this.#say(null, 0, 0));
    let down: [number, number] = [0, 0];
    canvas.addEventListener('pointerdown', (event) => {
      down = [event.offsetX, event.offsetY];
      this.#say(null, 0, 0);
    });
    canvas.addEventListener('click', (event) => {
      if (Math.hypot(event.offsetX - down[0], event.offsetY - down[1]) < 5 && !this.drag.over(event.offsetX, event.offsetY)) {
        this.#app.choose(this.mechanism?.pick(this.viewer.ray(event.offsetX, event.offsetY)) ?? null);
      }
    });
    canvas.addEventListener('keydown', (event) => this.#key(event));
  }

  #hover(x: number, y: number): void {
    if (this.drag.over(x, y)) {
      this.viewer.canvas.style.cursor = 'grab';
      const output = this.mechanism?.scene.output ?? null;
      const name = output === null ? '' : (this.mechanism?.scene.nodes[output]?.name ?? '');
      this.#say({ kind: 'body', index: 0, name: `output ${name}`, words: 'drag it; with Shift it turns' }, x, y);
      return;
    }
    const part = this.mechanism?.quick ? this.mechanism.pick(this.viewer.ray(x, y)) : null;
    this.viewer.canvas.style.cursor = part ? 'pointer' : '';
    this.#say(part, x, y);
  }

  #say(part: Part | null, x: number, y: number): void {
    this.#tip.hidden = part === null;
    if (part) {
      fill(this.#tip, h('b', {}, part.name), ...part.words.split('\n').map((line) => h('span', {}, line)));
      const width = this.viewer.extent[0];
      const left = x > width - 240;
      this.#tip.style.transform = `translate(${left ? x - 14 : x + 14}px, ${y + 12}px)${left ? ' translateX(-100%)' : ''}`;
    }
  }

  #key(event: KeyboardEvent): void {
    const ways: Record<string, [number, number, number]> = {
      ArrowLeft: [-1, 0, 0],
      ArrowRight: [1, 0, 0],
      ArrowUp: [0, 1, 0],
      ArrowDown: [0, -1, 0],
      PageUp: [0, 0, 1],
      PageDown: [0, 0, -1],
    };
    const way = ways[event.key];
    if (way && event.altKey) {
      const [right, up, away] = way;
      if (event.shiftKey) {
        this.drag.key(-up, right, away, true);
      } else {
        this.drag.key(right, up, away, false);
      }
    } else if (way) {
      this.viewer.orbit(-0.08 * way[0], -0.08 * way[1]);
    } else if (event.key === '+' || event.key === '=') {
      this.viewer.zoom(0.9);
    } else if (event.key === '-') {
      this.viewer.zoom(1 / 0.9);
    } else if (event.key === 'f' || event.key === 'Home') {
      this.viewer.fit();
    } else if (event.key === 'Escape') {
      this.#app.choose(null);
    } else if (event.key === '[' || event.key === ']') {
      this.#cycle(event.key === ']' ? 1 : -1);
    } else {
      return;
    }
    event.preventDefault();
  }

  /** Chooses the next body or joint: parts for those who do not point. */
  #cycle(step: number): void {
    const mechanism = this.mechanism;
    if (mechanism) {
      const { bodies, joints } = mechanism.scene;
      const all = [...bodies.map((_, k) => () => mechanism.body(k)), ...joints.map((_, k) => () => mechanism.joint(k))];
      const part = this.#app.part;
      const now = part === null ? -1 : part.kind === 'joint' ? bodies.length + part.index : part.index;
      this.#app.choose(all[(now + step + all.length) % all.length]?.() ?? null);
    }
  }
}

function words(status: string): string {
  const told: Record<string, string> = {
    unreachable: 'Out of reach',
    singular: 'Singular pose',
    branch: 'On another branch',
    unrestrained: 'Not held: it moves without force',
    rigid: 'Rigid: nothing gives',
    design: 'Not a mechanism with these values',
    failed: 'Not solved',
  };
  return told[status] ?? status;
}

/** Where things fall: along the global axis nearest to gravity; without gravity, z is up. */
function weight(gravity: readonly number[] | null): THREE.Vector3 {
  const parts = gravity ?? [0, 0, -1];
  const most = parts.reduce((best, part, k) => (Math.abs(part) > Math.abs(parts[best] as number) ? k : best), 2);
  return new THREE.Vector3().setComponent(most, Math.sign(parts[most] as number) || -1);
}

/** A ring with a dot, as a picture. */
function ring(colour: string): THREE.CanvasTexture {
  const canvas = h('canvas', { width: 64, height: 64 });
  const context = canvas.getContext('2d');
  if (context) {
    for (const [width, style] of [
      [12, '#ffffffd0'],
      [7, colour],
    ] as const) {
      context.lineWidth = width;
      context.strokeStyle = style;
      context.beginPath();
      context.arc(32, 32, 24, 0, 2 * Math.PI);
      context.stroke();
    }
    context.fillStyle = colour;
    context.beginPath();
    context.arc(32, 32, 7, 0, 2 * Math.PI);
    context.fill();
  }
  return new THREE.CanvasTexture(canvas);
}
