// Joints, drawn by their kind and their state.

import * as THREE from 'three';
import type { Scene, SceneJoint } from '../core';
import { type Glyph, Glyphs } from './glyphs';
import type { Shape } from './shape';

/** Colours of states, told apart by colour-blind people, too (Okabe and Ito). */
export const STATE = { free: '#c9ced6', driven: '#e69f00', elastic: '#3d9bd9', fixed: '#8b93a1' } as const;

export type State = keyof typeof STATE;

/** What a joint is: held as a drive, elastic, or left free. */
export function stateOf(joint: SceneJoint): State {
  if (joint.locked.length > 0) {
    return 'driven';
  }
  if (joint.elastic.length > 0) {
    return 'elastic';
  }
  return joint.free.length > 0 ? 'free' : 'fixed';
}

type Put = (shape: string, colour?: string, at?: [number, number, number], turn?: [number, number, number]) => void;
const DARK = '#3a4250';
const QUARTER = Math.PI / 2;

/** Shapes of unit size about y, the axis of a joint; what they are made of is decided below. */
function shapes(): Map<string, THREE.BufferGeometry> {
  const ring = new THREE.TorusGeometry(1, 0.17, 8, 28).rotateX(QUARTER);
  return new Map<string, THREE.BufferGeometry>([
    ['barrel', new THREE.CylinderGeometry(0.8, 0.8, 1.7, 24)],
    ['pin', new THREE.CylinderGeometry(0.36, 0.36, 2.5, 16)],
    ['rod', new THREE.CylinderGeometry(0.3, 0.3, 4, 16)],
    ['sleeve', new THREE.BoxGeometry(1.7, 2, 1.7)],
    ['tube', new THREE.CylinderGeometry(0.72, 0.72, 2, 20)],
    ['ball', new THREE.SphereGeometry(0.95, 22, 14)],
    ['bead', new THREE.SphereGeometry(0.55, 16, 10)],
    ['ring', ring],
    ['cube', new THREE.BoxGeometry(1.25, 1.25, 1.25)],
    ['nut', new THREE.CylinderGeometry(0.95, 0.95, 1.1, 6)],
    ['thread', new THREE.TubeGeometry(new Helix(0.36, 3.6, 7), 110, 0.1, 5)],
    ['disc', new THREE.CylinderGeometry(1.5, 1.5, 0.28, 28)],
    ['coil', new THREE.TubeGeometry(new Helix(1.12, 1.3, 2.5), 72, 0.09, 6)],
    ['lock', new THREE.TorusGeometry(1.08, 0.2, 8, 28).rotateX(QUARTER)],
    ['foot', new THREE.CylinderGeometry(1.0, 1.9, 1.5, 4, 1).rotateY(QUARTER / 2)],
    ['plate', new THREE.BoxGeometry(4.4, 0.35, 4.4)],
  ]);
}

class Helix extends THREE.Curve<THREE.Vector3> {
  constructor(
    readonly radius: number,
    readonly height: number,
    readonly turns: number,
  ) {
    super();
  }

  override getPoint(t: number, into = new THREE.Vector3()): THREE.Vector3 {
    const angle = 2 * Math.PI * this.turns * t;
    return into.set(this.radius * Math.cos(angle), this.height * (t - 0.5), this.radius * Math.sin(angle));
  }
}

function assemble(joint: SceneJoint, put: Put): void {
  const state = STATE[stateOf(joint)];
  switch (joint.kind) {
    case 'Revolute':
      put('barrel', state);
      put('pin', DARK);
      break;
    case 'Prismatic':
      put('sleeve', state);
      put('rod', DARK);
      break;
    case 'Cylindrical':
      put('tube', state);
      put('rod', DARK);
      break;
    case 'Screw':
      put('nut', state);
      put('rod', DARK);
      put('thread', STATE.free);
      break;
    case 'Universal':
      put('pin', state, [0, 0, 0], [0, 0, QUARTER]);
      put('pin', DARK);
      put('bead', state);
      break;
    case 'Spherical':
      put('ball', state);
      put('ring', DARK);
      break;
    case 'Planar':
      put('disc', state, [0, 0.24, 0]);
      put('disc', DARK, [0, -0.24, 0]);
      break;
    case 'Fixed':
      put('cube', state);
      break;
    default:
      put('ball', state);
      put('pin', DARK);
      put('pin', DARK, [0, 0, 0], [0, 0, QUARTER]);
  }
  if (joint.elastic.length > 0) {
    put('coil', STATE.elastic);
  }
  if (joint.locked.length > 0) {
    put('lock', STATE.driven);
  }
}

/** All joints of a mechanism, and the ground below those that stand on it. */
export class Joints {
  readonly glyphs: Glyphs;
  readonly ground: Glyphs;
  readonly #scene: Scene;
  readonly #frames: THREE.Matrix4[];
  readonly #feet: THREE.Matrix4[];
  /** For each joint the way to its ground. */
  readonly #downs: readonly THREE.Quaternion[];
  readonly #radii: readonly number[];
  /** How far the ground lies below the joints that stand on it [m]. */
  readonly depth: number;

  constructor(scene: Scene, shape: Shape, radii: readonly number[], material: THREE.Material) {
    this.#scene = scene;
    this.#radii = radii;
    this.depth = 2.6 * Math.max(...scene.joints.map((joint, j) => (joint.bodies.includes(null) ? (radii[j] as number) : 0)), 0);
    const made = shapes();
    const glyphs: Glyph[] = [];
    const feet: Glyph[] = [];
    scene.joints.forEach((joint, owner) => {
      assemble(joint, (name, colour = DARK, at = [0, 0, 0], turn = [0, 0, 0]) => {
        glyphs.push({ shape: name, colour: new THREE.Color(colour), owner, local: local(at, turn) });
      });
      if (joint.bodies.includes(null)) {
        const [foot, plate] = [new THREE.Color('#7d8694'), new THREE.Color('#5b6472')];
        feet.push({ shape: 'foot', colour: foot, owner, local: local([0, 1.5, 0], [Math.PI, 0, 0]) });
        feet.push({ shape: 'plate', colour: plate, owner, local: local([0, 2.4, 0], [0, 0, 0]) });
      }
    });
    this.glyphs = new Glyphs(glyphs, made, material);
    this.ground = new Glyphs(feet, made, material);
    this.#frames = scene.joints.map(() => new THREE.Matrix4());
    this.#feet = scene.joints.map(() => new THREE.Matrix4());
    const usual = down(scene, shape);
    this.#downs = scene.joints.map((joint) => new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 1, 0), behind(scene, shape, joint) ?? usual));
    this.update(shape);
  }

  /** Puts joints where the shape shows them; the ground stays where the mechanism stands without load. */
  update(shape: Shape): void {
    const scale = new THREE.Vector3();
    const [x, y, z] = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3()];
    this.#scene.joints.forEach((joint, j) => {
      const frame = this.#frames[j] as THREE.Matrix4;
      scale.setScalar(this.#radii[j] as number);
      const axes = shape.frames;
      x.set(axes[9 * j] as number, axes[9 * j + 1] as number, axes[9 * j + 2] as number);
      y.set(axes[9 * j + 3] as number, axes[9 * j + 4] as number, axes[9 * j + 5] as number);
      z.set(axes[9 * j + 6] as number, axes[9 * j + 7] as number, axes[9 * j + 8] as number);
      frame.makeBasis(x, y, z).scale(scale);
      const v = 3 * joint.at;
      const { shown, places } = shape;
      frame.setPosition(shown[v] as number, shown[v + 1] as number, shown[v + 2] as number);
      const foot = this.#feet[j] as THREE.Matrix4;
      foot.makeRotationFromQuaternion(this.#downs[j] as THREE.Quaternion).scale(scale);
      foot.setPosition(places[v] as number, places[v + 1] as number, places[v + 2] as number);
    });
    this.glyphs.place((owner) => this.#frames[owner] as THREE.Matrix4);
    this.ground.place((owner) => this.#feet[owner] as THREE.Matrix4);
  }
}

function local(at: [number, number, number], turn: [number, number, number]): THREE.Matrix4 {
  return new THREE.Matrix4().makeRotationFromEuler(new THREE.Euler(...turn)).setPosition(...at);
}

/** What is fixed to the ground stands on it with its end: the ground lies behind. */
function behind(scene: Scene, shape: Shape, joint: SceneJoint): THREE.Vector3 | null {
  const body = scene.bodies[joint.bodies.find((each) => each !== null) ?? -1];
  if (joint.kind !== 'Fixed' || !body || body.nodes.length < 2) {
    return null;
  }
  const place = (v: number): THREE.Vector3 => new THREE.Vector3(shape.places[3 * v], shape.places[3 * v + 1], shape.places[3 * v + 2]);
  const middle = body.nodes.reduce((sum, v) => sum.add(place(v)), new THREE.Vector3()).divideScalar(body.nodes.length);
  const way = place(joint.at).sub(middle);
  return way.length() > 1e-6 * scene.size ? way.normalize() : null;
}

/** The global direction in which the ground lies, seen from the mechanism. */
export function down(scene: Scene, shape: Shape): THREE.Vector3 {
  const feet = scene.joints.filter((joint) => joint.bodies.includes(null));
  const middle = (all: readonly number[]): THREE.Vector3 => {
    const sum = new THREE.Vector3();
    for (const v of all) {
      sum.add(new THREE.Vector3(shape.places[3 * v], shape.places[3 * v + 1], shape.places[3 * v + 2]));
    }
    return sum.divideScalar(Math.max(all.length, 1));
  };
  const way = middle(feet.map((joint) => joint.at)).sub(middle(scene.nodes.map((_, v) => v)));
  const parts = way.toArray();
  // Upright where the ground lies more or less below or above.
  const size = (k: number): number => Math.abs(parts[k] as number);
    const steepest = [0, 1, 2].reduce((best, k) => (size(k) > size(best) ? k : best));
  const largest = size(2) > 0.35 * size(steepest) ? 2 : steepest;
  const axis = new THREE.Vector3().setComponent(largest, Math.sign(parts[largest] as number) || -1);
  return way.length() < 0.1 * scene.size ? new THREE.Vector3(0, 0, -1) : axis;
}
