// The mechanism in the scene: all that is drawn of one answer, kept and moved as poses change.

import * as THREE from 'three';
import type { Frame, Scene } from '../core';
import { Acts, triad, Weights } from './acts';
import { Beams } from './beams';
import { colour, type Ramp } from './colours';
import { Joints, down } from './joints';
import { Ellipsoid, Ghost } from './overlays';
import { Block } from './rigid';
import { Shape } from './shape';

/** A part that can be pointed at. */
export interface Part {
  kind: 'body' | 'joint' | 'mass';
  /** Its number among bodies or joints; of a mass the node it is on. */
  index: number;
  name: string;
  /** What stands in the tooltip below the name. */
  words: string;
}

export interface Shown {
  joints: boolean;
  ground: boolean;
  loads: boolean;
  weights: boolean;
  frames: boolean;
  ghost: boolean;
  translational: boolean;
  rotational: boolean;
}

export type Colouring = 'plain' | 'displacement' | 'stress' | 'share';

/** What colours mean at present. */
export interface Legend {
  ramp: Ramp;
  from: number;
  to: number;
  title: string;
  unit: string;
}

const PLAIN: [number, number, number] = [0.66, 0.7, 0.77];
const UNKNOWN: [number, number, number] = [0.72, 0.72, 0.72];
const CHOSEN = new THREE.Color('#cc3d8f');

export class Mechanism {
  readonly group = new THREE.Group();
  readonly scene: Scene;
  readonly shape: Shape;
  readonly joints: Joints;
  readonly beams: Beams;
  readonly blocks: { block: Block; body: number; material: THREE.MeshLambertMaterial }[];
  readonly #acts: Acts;
  readonly #weights: Weights;
  readonly #ghost: Ghost;
  readonly #stiff: Ellipsoid;
  readonly #turning: Ellipsoid;
  readonly #frames = new THREE.Group();
  readonly #output: THREE.LineSegments;
  /** Beside the mechanism, where gravity is told. */
  readonly #corner: THREE.Vector3;
  readonly #materials = new Map<string, THREE.MeshLambertMaterial>();
  /** Size of small shapes [m]. */
  readonly radius: number;
  readonly down: THREE.Vector3;
  frame: Frame | null = null;
  shown: Shown;
  colouring: Colouring = 'plain';
  chosen: Part | null = null;

  constructor(asked: Scene, numbers: Float64Array, shown: Shown) {
    this.shape = new Shape(asked, numbers);
    // What is drawn around it goes by half the diagonal of the box around it.
    const scene = { ...asked, size: this.shape.reach() || asked.size };
    this.scene = scene;
    this.shown = shown;
    this.radius = glyphRadius(scene);
    this.down = down(scene, this.shape);
    const painted = new THREE.MeshLambertMaterial({ vertexColors: true, side: THREE.DoubleSide });
    this.beams = new Beams(scene, painted);
    const glyphs = new THREE.MeshLambertMaterial();
    this.joints = new Joints(scene, this.shape, jointRadii(scene, this.radius), glyphs);
    this.blocks = scene.bodies.flatMap((body, index) => {
      if (body.kind === 'beam' || body.nodes.length === 0) {
        return [];
      }
      const material = new THREE.MeshLambertMaterial({ color: body.kind === 'rigid' ? '#5f7fa6' : '#7aa08a', flatShading: true });
      return [{ block: new Block(body, this.shape, this.radius, material), body: index, material }];
    });
    const materialOf = (hex: string): THREE.Material => {
      const made = this.#materials.get(hex) ?? new THREE.MeshLambertMaterial({ color: hex });
      this.#materials.set(hex, made);
      return made;
    };
    this.#acts = new Acts(scene, materialOf);
    this.#weights = new Weights(scene, materialOf);
    this.#ghost = new Ghost(scene);
    this.#stiff = new Ellipsoid('#0b7a75', 0.22 * scene.size);
    this.#turning = new Ellipsoid('#9c4f96', 0.17 * scene.size);
    this.#output = triad(0.16 * scene.size);
    const origin = triad(0.22 * scene.size);
    this.#frames.add(this.#output, origin);
    this.group.add(
      this.beams.mesh,
      ...this.blocks.map(({ block }) => block.mesh),
      this.joints.glyphs.group,
      this.joints.ground.group,
      this.#acts.group,
      this.#weights.group,
      this.#ghost.lines,
      this.#frames,
      this.#stiff.group,
      this.#turning.group,
    );
    this.#corner = this.shape.corner();
    this.refresh();
  }

  /** Takes another pose. */
  take(frame: Frame, numbers: Float64Array): void {
    this.frame = frame;
    if (frame.layout) {
      this.shape.take(numbers, frame.layout);
    }
  }

  /** Brings everything to what the shape, the factor and the choices say. */
  refresh(): void {
    const { shape, shown } = this;
    shape.refresh();
    this.beams.update(shape);
    for (const { block } of this.blocks) {
      block.update(shape);
    }
    this.joints.glyphs.group.visible = shown.joints;
    this.joints.ground.group.visible = shown.ground;
    this.joints.update(shape);
    this.#acts.group.visible = shown.loads && shape.mode === null;
    this.#acts.update(shape);
    this.#weights.group.visible = shown.weights;
    this.#weights.update(shape, this.#corner);
    this.#ghost.lines.visible = shown.ghost && shape.factor !== 0;
    this.#ghost.update(shape);
    this.#frames.visible = shown.frames;
    const at = this.output();
    if (at) {
      this.#output.position.copy(at);
      this.#stiff.set(this.frame?.principal?.translational_stiffnesses, at, shown.translational && shape.mode === null);
      this.#turning.set(this.frame?.principal?.rotational_stiffnesses, at, shown.rotational && shape.mode === null);
    }
    this.paint();
  }

  /** Loads in words, with their places. */
  loads(): { text: string; at: () => THREE.Vector3 }[] {
    return this.#acts.told(this.shape);
  }

  /** Where gravity is told; null without it. */
  get gravityAt(): THREE.Vector3 | null {
    return this.scene.gravity ? this.#corner : null;
  }

  /** What acts, where it is shown: loads, masses, gravity. */
  acting(): THREE.Object3D[] {
    return [this.#acts.group, this.#weights.group].filter((group) => group.visible);
  }

  /** Where the output is shown. */
  output(): THREE.Vector3 | null {
    return this.scene.output === null ? null : this.nodeAt(this.scene.output);
  }

  nodeAt(v: number): THREE.Vector3 {
    const { shown } = this.shape;
    return new THREE.Vector3(shown[3 * v], shown[3 * v + 1], shown[3 * v + 2]);
  }

  /** The share of each body in the budget, by name. */
  #shares(): Map<string, number> {
    const parts = this.frame?.budget?.by_part ?? [];
    return new Map(parts.flatMap(({ name, share }) => (share === null ? [] : [[name, share] as const])));
  }

  /** What the colours mean, where they mean something. */
  legend(): Legend | null {
    const { shape } = this;
    if (this.colouring === 'displacement') {
      let most = 0;
      for (let v = 0; v < shape.vertices; v++) {
        most = Math.max(most, shape.moved(v));
      }
      const unit = shape.mode ? '' : 'm';
      return { ramp: 'amount', from: 0, to: most || 1, title: shape.mode ? 'mode, largest 1' : 'displacement', unit };
    }
    if (this.colouring === 'stress') {
      const known = shape.stress.filter((value) => Number.isFinite(value));
      const most = known.reduce((a, b) => Math.max(a, b), 0);
      return known.length > 0 ? { ramp: 'amount', from: 0, to: most || 1, title: 'equivalent stress', unit: 'Pa' } : null;
    }
    if (this.colouring === 'share') {
      const most = [...this.#shares().values()].reduce((a, b) => Math.max(a, Math.abs(b)), 0) || 1;
      return { ramp: 'signed', from: -most, to: most, title: 'share of the deflection', unit: '%' };
    }
    return null;
  }

  /** Paints all parts. */
  paint(): void {
    const legend = this.legend();
    const { scene, shape } = this;
    const shares = this.colouring === 'share' ? this.#shares() : null;
    const span = legend ? legend.to - legend.from || 1 : 1;
    const put = (value: number, into: { [at: number]: number }): void => {
      if (legend && Number.isFinite(value)) {
        colour(legend.ramp, (value - legend.from) / span, into, 0);
      } else {
        [into[0], into[1], into[2]] = legend ? UNKNOWN : PLAIN;
      }
    };
    const chosenBody = this.chosen?.kind === 'body' ? this.chosen.index : -1;
    this.beams.colour((s, v, into) => {
      const body = (scene.segments[s] as Scene['segments'][number]).body;
      if (body === chosenBody && !legend) {
        [into[0], into[1], into[2]] = [0.8, 0.24, 0.56];
      } else if (!legend) {
        [into[0], into[1], into[2]] = PLAIN;
      } else if (this.colouring === 'displacement') {
        put(shape.moved(v), into);
      } else if (this.colouring === 'stress') {
        put(shape.stress[v] as number, into);
      } else {
        put(shares?.get((scene.bodies[body] as Scene['bodies'][number]).name) ?? 0, into);
      }
    });
    const rgb: [number, number, number] = [0, 0, 0];
    for (const { body, material } of this.blocks) {
      const own = scene.bodies[body] as Scene['bodies'][number];
      if (body === chosenBody) {
        material.color.copy(CHOSEN);
      } else if (legend && this.colouring !== 'stress') {
        put(this.colouring === 'displacement' ? mean(own.nodes, (v) => shape.moved(v)) : (shares?.get(own.name) ?? 0), rgb);
        material.color.setRGB(...rgb, THREE.SRGBColorSpace);
      } else {
        material.color.set(legend ? '#b8b8b8' : own.kind === 'rigid' ? '#5f7fa6' : '#7aa08a');
      }
    }
    const chosenJoint = this.chosen?.kind === 'joint' ? this.chosen.index : -1;
    this.joints.glyphs.tint((owner) => {
      if (owner === chosenJoint) {
        return CHOSEN;
      }
      const share = shares?.get(`joint ${(scene.joints[owner] as Scene['joints'][number]).name}`);
      if (!legend || share === undefined) {
        return null;
      }
      put(share, rgb);
      return new THREE.Color().setRGB(...rgb, THREE.SRGBColorSpace);
    });
  }

  /** Whether a pointer that only moves is to be told what is below it. */
  get quick(): boolean {
    return (this.beams.mesh.geometry.index?.count ?? 0) < 1_500_000;
  }

  /** The part under a ray, nearest first. */
  pick(caster: THREE.Raycaster): Part | null {
    const visible = [this.beams.mesh, ...this.blocks.map(({ block }) => block.mesh)] as THREE.Object3D[];
    const groups = [this.joints.glyphs.group, this.#weights.group].filter((group) => group.visible);
    const hit = caster.intersectObjects([...visible, ...groups], true)[0];
    if (!hit) {
      return null;
    }
    const joint = this.joints.glyphs.ownerOf(hit.object, hit.instanceId);
    if (joint !== null) {
      return this.joint(joint);
    }
    const mass = this.#weights.massOf(hit.object);
    if (mass) {
      const node = this.scene.nodes[mass.node]?.name ?? '';
      return { kind: 'mass', index: mass.node, name: `mass on ${node}`, words: `${mass.mass} kg` };
    }
    const segment = hit.object === this.beams.mesh ? this.beams.segmentOf(hit.faceIndex ?? 0) : null;
    const body = segment === null ? this.blocks.find(({ block }) => block.mesh === hit.object)?.body : this.scene.segments[segment]?.body;
    return body === undefined ? null : this.body(body, segment ?? undefined);
  }

  joint(index: number): Part {
    const joint = this.scene.joints[index] as Scene['joints'][number];
    const [a, b] = joint.bodies.map((body) => (body === null ? 'ground' : (this.scene.bodies[body]?.name ?? '')));
    const states = [
      joint.free.length > 0 ? `free ${joint.free.join(' ')}` : '',
      joint.locked.length > 0 ? `held ${joint.locked.join(' ')}` : '',
      joint.elastic.length > 0 ? `elastic ${joint.elastic.join(' ')}` : '',
    ].filter((state) => state !== '');
    const words = `${joint.kind}, ${a} – ${b}${states.length > 0 ? `\n${states.join(', ')}` : ''}`;
    return { kind: 'joint', index, name: joint.name, words };
  }

  body(index: number, segment?: number): Part {
    const body = this.scene.bodies[index] as Scene['bodies'][number];
    const own = segment ?? body.segments[0];
    const link = own === undefined ? undefined : this.scene.segments[own];
    const section = link && (link.from.words === link.to.words ? link.from.words : `${link.from.words} to ${link.to.words}`);
    const words = link ? `${section}, ${link.points.join(' – ')}` : body.kind === 'rigid' ? 'rigid body' : 'flexible body';
    return { kind: 'body', index, name: body.name, words };
  }

  /** Points that a picture of all has to show: all vertices, and the ground below joints. */
  extent(): THREE.Vector3[] {
    const { places, vertices } = this.shape;
    const points = Array.from({ length: vertices }, (_, v) => new THREE.Vector3(places[3 * v], places[3 * v + 1], places[3 * v + 2]));
    const feet = this.scene.joints.filter(({ bodies }) => bodies.includes(null));
    // The sections at both ends of links, unless these are very many.
    const { segments } = this.scene;
    const rings = segments.length > 2000 ? [] : segments.flatMap(({ vertices: [, count] }, s) => [this.beams.ring(s, 0), this.beams.ring(s, count - 1)]);
    const sections = rings.flatMap((ring) => Array.from({ length: ring.length / 3 }, (_, k) => new THREE.Vector3(...ring.subarray(3 * k, 3 * k + 3))));
    return [...points, ...sections, ...(this.gravityAt ? [this.gravityAt] : []), ...this.#acts.tips(this.shape), ...feet.map(({ at }) => (points[at] as THREE.Vector3).clone().addScaledVector(this.down, this.joints.depth))];
  }

  dispose(): void {
    this.joints.glyphs.dispose();
    this.joints.ground.dispose();
    this.group.traverse((object) => {
      const mesh = object as Partial<THREE.Mesh>;
      mesh.geometry?.dispose();
      for (const material of [mesh.material ?? []].flat()) {
        material.dispose();
      }
    });
  }
}

/** Small shapes are somewhat wider than the links that they join. */
function glyphRadius(scene: Scene): number {
  const widths = scene.segments.map(({ from }) => Math.max(...from.outline.map(([y, z]) => Math.hypot(y, z)))).sort((a, b) => a - b);
  const middle = widths[Math.floor(0.6 * widths.length)] ?? 0;
  return Math.min(Math.max(1.45 * middle, 0.016 * scene.size), 0.045 * scene.size);
}

/** Each joint is somewhat wider than the links that it joins. */
function jointRadii(scene: Scene, usual: number): number[] {
  const widths = new Map<number, number>();
  for (const { ends, from, to } of scene.segments) {
    [from, to].forEach((section, k) => {
      const v = ends[k] as number;
      widths.set(v, Math.max(widths.get(v) ?? 0, Math.max(...section.outline.map(([y, z]) => Math.hypot(y, z)))));
    });
  }
  return scene.joints.map(({ nodes }) => {
    const width = Math.max(...nodes.map((v) => (v === null ? 0 : (widths.get(v) ?? 0))));
    return width > 0 ? Math.min(Math.max(1.35 * width, 0.013 * scene.size), 0.11 * scene.size) : usual;
  });
}

function mean(all: readonly number[], of: (v: number) => number): number {
  return all.reduce((sum, v) => sum + of(v), 0) / Math.max(all.length, 1);
}
