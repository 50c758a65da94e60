// The platform, moved by pointer and keys within its mobility.

import * as THREE from 'three';
import type { App, Coordinates } from '../app';
import type { Coordinate, Six } from '../core';
import type { Mechanism } from './mechanism';
import type { Viewer } from './viewer';

const NAMES: Coordinate[] = ['x', 'y', 'z', 'rx', 'ry', 'rz'];

/** Which of the six coordinates the output is moved by. */
export function movable(app: App): Set<Coordinate> {
  return new Set(app.loaded?.coordinates.map(({ name }) => name as Coordinate) ?? []);
}

/** All coordinates that the mechanism takes, some of them with other values. */
export function coordinates(app: App, here: Six, other: Coordinates): Coordinates {
  return Object.fromEntries([...movable(app)].map((name) => [name, other[name] ?? here[NAMES.indexOf(name)] ?? 0]));
}

/** Six numbers of a pose turned by a rotation in global axes. */
export function turned(pose: Six, by: THREE.Quaternion): Coordinates {
  const vector = new THREE.Vector3(pose[3], pose[4], pose[5]);
  const angle = vector.length();
  const now = new THREE.Quaternion().setFromAxisAngle(angle > 0 ? vector.divideScalar(angle) : vector.set(0, 0, 1), angle);
  const next = by.clone().multiply(now);
  if (next.w < 0) {
    next.set(-next.x, -next.y, -next.z, -next.w);
  }
  const half = Math.hypot(next.x, next.y, next.z);
  const scale = half > 1e-12 ? (2 * Math.atan2(half, next.w)) / half : 2;
  return { rx: scale * next.x, ry: scale * next.y, rz: scale * next.z };
}

interface Held {
  pointer: number;
  /** From the place of the pointer to that of the output, on the canvas. */
  offset: [number, number];
  start: [number, number];
  pose: Six;
  turning: boolean;
  /** In which the output moves, and what it was shown away from its pose when it was taken hold of. */
  plane: THREE.Plane;
  away: THREE.Vector3;
}

export class Drag {
  readonly #app: App;
  readonly #viewer: Viewer;
  readonly #mechanism: () => Mechanism | null;
  #held: Held | null = null;
  #wanted: Coordinates | null = null;
  #due = false;
  /** Where the output is asked to be while that is out of reach, or null. */
  target: THREE.Vector3 | null = null;
  /** Called after each step with what was asked. */
  onstep: () => void = () => {};

  constructor(app: App, viewer: Viewer, mechanism: () => Mechanism | null) {
    this.#app = app;
    this.#viewer = viewer;
    this.#mechanism = mechanism;
    const canvas = viewer.canvas;
    canvas.addEventListener('pointerdown', (event) => this.#down(event), { capture: true });
    canvas.addEventListener('pointermove', (event) => this.#move(event));
    for (const end of ['pointerup', 'pointercancel', 'lostpointercapture'] as const) {
      canvas.addEventListener(end, (event) => this.#up(event));
    }
  }

  get active(): boolean {
    return this.#held !== null;
  }

  /** Whether the output can be moved at all. */
  get possible(): boolean {
    return this.#app.moves && this.#app.here !== null;
  }

  /** Whether a place on the canvas takes hold of the output. */
  over(x: number, y: number, reach = 15): boolean {
    const at = this.possible ? this.#mechanism()?.output() : null;
    if (!at) {
      return false;
    }
    const [ox, oy] = this.#viewer.project(at);
    return Math.hypot(ox - x, oy - y) < reach;
  }

  #down(event: PointerEvent): void {
    const [x, y] = [event.offsetX, event.offsetY];
    const reach = event.pointerType === 'touch' ? 30 : 15;
    if (event.button !== 0 || !this.over(x, y, reach)) {
      return;
    }
    const at = this.#mechanism()?.output();
    const pose = this.#app.here;
    if (!at || !pose) {
      return;
    }
    const [ox, oy] = this.#viewer.project(at);
    const names = movable(this.#app);
    const moves = names.has('x') || names.has('y') || names.has('z');
    this.#held = { pointer: event.pointerId, offset: [ox - x, oy - y], start: [x, y], pose, turning: event.shiftKey || !moves, plane: this.#plane(at), away: this.#deflection() };
    this.#viewer.canvas.setPointerCapture(event.pointerId);
    this.#viewer.canvas.focus({ preventScroll: true, focusVisible: false } as FocusOptions);
    event.stopImmediatePropagation();
    event.preventDefault();
  }

  #move(event: PointerEvent): void {
    const held = this.#held;
    if (!held || event.pointerId !== held.pointer) {
      return;
    }
    const [x, y] = [event.offsetX, event.offsetY];
    if (held.turning) {
      this.#turn(x - held.start[0], y - held.start[1], held.pose);
    } else {
      const ray = this.#viewer.ray(x + held.offset[0], y + held.offset[1]).ray;
      // The deflection changes with the pose: what is held on to is that of the beginning.
      const target = ray.intersectPlane(held.plane, new THREE.Vector3())?.sub(held.away);
      if (target) {
        this.ask({ x: target.x, y: target.y, z: target.z }, held.pose);
      }
    }
  }

  #up(event: PointerEvent): void {
    if (this.#held && event.pointerId === this.#held.pointer) {
      this.#held = null;
      this.target = null;
      if (this.#app.frame?.pose === null) {
        // Out of reach: what is shown is the last pose that was reached.
        this.#app.go(this.#app.pose);
      }
      this.onstep();
      this.#viewer.draw();
    }
  }

  /** The plane in which the output moves, or that of the picture. */
  #plane(at: THREE.Vector3): THREE.Plane {
    const names = movable(this.#app);
    const fixed = (['x', 'y', 'z'] as const).filter((name) => !names.has(name));
    const normal = this.#viewer.camera.getWorldDirection(new THREE.Vector3());
    if (fixed.length === 1) {
      const axis = new THREE.Vector3().setComponent(NAMES.indexOf(fixed[0] as Coordinate), 1);
      if (Math.abs(axis.dot(normal)) > 0.12) {
        normal.copy(axis);
      }
    }
    return new THREE.Plane().setFromNormalAndCoplanarPoint(normal, at);
  }

  /** What the output is shown away from its pose. */
  #deflection(): THREE.Vector3 {
    const mechanism = this.#mechanism();
    const v = mechanism?.scene.output;
    if (!mechanism || v === null || v === undefined) {
      return new THREE.Vector3();
    }
    const { places } = mechanism.shape;
    return mechanism.nodeAt(v).sub(new THREE.Vector3(places[3 * v], places[3 * v + 1], places[3 * v + 2]));
  }

  #turn(right: number, down: number, pose: Six): void {
    const camera = this.#viewer.camera;
    const names = movable(this.#app);
    const only = (['rx', 'ry', 'rz'] as const).filter((name) => names.has(name));
    if (only.length === 1) {
      const name = only[0] as Coordinate;
      this.ask({ [name]: (pose[NAMES.indexOf(name)] as number) + 0.006 * right }, pose);
      return;
    }
    const vertical = new THREE.Vector3(0, 1, 0).transformDirection(camera.matrixWorld);
    const across = new THREE.Vector3(1, 0, 0).transformDirection(camera.matrixWorld);
    const by = new THREE.Quaternion().setFromAxisAngle(vertical, 0.006 * right);
    by.premultiply(new THREE.Quaternion().setFromAxisAngle(across, 0.006 * down));
    this.ask(turned(pose, by), pose);
  }

  /** Asks for other coordinates at the next frame; the latest ask wins. */
  ask(other: Coordinates, here = this.#app.here): void {
    if (!here) {
      return;
    }
    this.#wanted = coordinates(this.#app, here, other);
    if (!this.#due) {
      this.#due = true;
      requestAnimationFrame(() => this.#step());
    }
  }

  #step(): void {
    this.#due = false;
    const wanted = this.#wanted;
    const mechanism = this.#mechanism();
    if (!wanted || !mechanism) {
      return;
    }
    const begun = performance.now();
    const frame = this.#app.go({ at: wanted }, this.active);
    const reached = frame?.layout !== null && frame !== null;
    const here = mechanism.scene.output === null ? null : mechanism.shape.places.subarray(3 * mechanism.scene.output);
    this.target =
      reached || !this.active
        ? null
        : new THREE.Vector3(wanted.x ?? here?.[0], wanted.y ?? here?.[1], wanted.z ?? here?.[2]).add(this.#held?.away ?? new THREE.Vector3());
    this.onstep();
    this.#viewer.now();
    if (this.active) {
      performance.measure('hyperstat drag', { start: begun, end: performance.now() });
    }
  }

  /** A step of keys: along the picture's right, up and away, or about them. */
  key(right: number, up: number, away: number, turning: boolean): void {
    const pose = this.#app.here;
    const size = this.#app.loaded?.size ?? 1;
    if (!pose || !this.possible) {
      return;
    }
    const { matrixWorld } = this.#viewer.camera;
    const way = new THREE.Vector3(right, up, -away).transformDirection(matrixWorld);
    if (turning) {
      this.ask(turned(pose, new THREE.Quaternion().setFromAxisAngle(way, 0.03)));
      return;
    }
    // Keys move along the global axis that is nearest to the direction on the picture.
    const names = movable(this.#app);
    const parts = way.toArray();
    const best = [0, 1, 2]
      .filter((k) => names.has(NAMES[k] as Coordinate))
      .sort((a, b) => Math.abs(parts[b] as number) - Math.abs(parts[a] as number))[0];
    if (best !== undefined) {
      this.ask({ [NAMES[best] as string]: (pose[best] as number) + Math.sign(parts[best] as number) * 0.01 * size });
    }
  }
}
