// What acts: forces, moments, loads along beams, gravity, masses; and frames.

import * as THREE from 'three';
import type { Scene } from '../core';
import { number } from '../format';
import type { Shape } from './shape';

export const LOAD = '#d55e00';
const MOMENT = '#a3479b';
const UP = new THREE.Vector3(0, 1, 0);

/** An arrow along y, from the origin, of unit length: shaft and head. */
class Arrow {
  readonly group = new THREE.Group();
  readonly #shaft: THREE.Mesh;
  readonly #head: THREE.Mesh;

  constructor(material: THREE.Material, readonly width: number) {
    this.#shaft = new THREE.Mesh(new THREE.CylinderGeometry(width, width, 1, 12).translate(0, 0.5, 0), material);
    this.#head = new THREE.Mesh(new THREE.ConeGeometry(2.6 * width, 7 * width, 16).translate(0, -3.5 * width, 0), material);
    this.group.add(this.#shaft, this.#head);
  }

  tip(): THREE.Vector3 {
    return UP.clone().multiplyScalar(this.#head.position.y).applyQuaternion(this.group.quaternion).add(this.group.position);
  }

  /** From `from` along `way`; nothing is shown of a way without length. */
  set(from: THREE.Vector3, way: THREE.Vector3): void {
    const length = way.length();
    this.group.visible = length > 1e-12;
    if (this.group.visible) {
      this.group.position.copy(from);
      this.group.quaternion.setFromUnitVectors(UP, way.clone().divideScalar(length));
      this.#shaft.scale.set(1, Math.max(length - 6 * this.width, 1e-6), 1);
      this.#head.position.set(0, length, 0);
    }
  }
}

/** A turning arrow about y: three quarters of a circle, and a head. */
function turning(material: THREE.Material, radius: number, width: number): THREE.Group {
  const group = new THREE.Group();
  const arc = new THREE.TorusGeometry(radius, width, 8, 32, 1.5 * Math.PI).rotateX(Math.PI / 2);
  const head = new THREE.ConeGeometry(2.6 * width, 6 * width, 14).rotateX(-Math.PI / 2);
  const tip = new THREE.Mesh(head, material);
  // Right-handed about y the arc runs from −z through −x and +z to +x, where it heads for −z.
  tip.position.set(radius, 0, -2 * width);
  group.add(new THREE.Mesh(arc, material), tip);
  return group;
}

export class Acts {
  readonly group = new THREE.Group();
  readonly #scene: Scene;
  readonly #case: string | null;
  readonly #forces: { arrow: Arrow; turn: THREE.Group; node: number; load: number }[] = [];
  readonly #along: { arrow: Arrow; segment: number; line: number; t: number }[] = [];
  readonly #reach: number;

  constructor(scene: Scene, materialOf: (colour: string) => THREE.Material) {
    this.#scene = scene;
    this.#case = scene.case;
    this.#reach = 0.34 * scene.size;
    const width = 0.0085 * scene.size;
    const [force, moment] = [materialOf(LOAD), materialOf(MOMENT)];
    scene.loads.forEach((load, k) => {
      if (load.case === this.#case) {
        const entry = { arrow: new Arrow(force, width), turn: turning(moment, 0.13 * scene.size, 0.8 * width), node: load.node, load: k };
        this.group.add(entry.arrow.group, entry.turn);
        this.#forces.push(entry);
      }
    });
    scene.lines.forEach((line, k) => {
      if (line.case === this.#case) {
        for (const t of [0, 0.25, 0.5, 0.75, 1]) {
          const arrow = new Arrow(force, 0.6 * width);
          this.group.add(arrow.group);
          this.#along.push({ arrow, segment: line.segment, line: k, t });
        }
      }
    });
  }

  /** Ends of the arrows of forces. */
  tips(shape: Shape): THREE.Vector3[] {
    this.update(shape);
    return this.#forces.filter(({ arrow }) => arrow.group.visible).map(({ arrow }) => arrow.tip());
  }

  /** How large the loads at nodes are, and where their arrows are. */
  told(shape: Shape): { text: string; at: () => THREE.Vector3 }[] {
    return this.#forces.map(({ arrow, node, load }) => {
      const [force, moment] = [0, 3].map((k) => vector(shape.loads, 6 * load + k).length()) as [number, number];
      const text = [force > 0 ? `${number(force, 3)} N` : '', moment > 0 ? `${number(moment, 3)} N·m` : ''].filter((part) => part !== '').join(', ');
      return { text, at: () => (force > 0 ? arrow.tip() : vector(shape.shown, 3 * node)) };
    });
  }

  update(shape: Shape): void {
    const forces = this.#forces.map(({ load }) => vector(shape.loads, 6 * load));
    const moments = this.#forces.map(({ load }) => vector(shape.loads, 6 * load + 3));
    const largest = Math.max(...forces.map((each) => each.length()), 0);
    const twist = Math.max(...moments.map((each) => each.length()), 0);
    this.#forces.forEach(({ arrow, turn, node }, k) => {
      const at = vector(shape.shown, 3 * node);
      const force = forces[k] as THREE.Vector3;
      const moment = moments[k] as THREE.Vector3;
      const length = largest > 0 ? this.#reach * (0.35 + 0.65 * (force.length() / largest)) : 0;
      arrow.set(at, force.clone().normalize().multiplyScalar(force.length() > 0 ? length : 0));
      turn.visible = moment.length() > 0;
      turn.position.copy(at);
      turn.scale.setScalar(twist > 0 ? 0.6 + 0.4 * (moment.length() / twist) : 1);
      turn.quaternion.setFromUnitVectors(UP, moment.clone().normalize());
    });
    const dense = Math.max(...this.#along.map(({ line, t }) => lineForce(shape, line, t).length()), 0);
    for (const { arrow, segment, line, t } of this.#along) {
      const [first, count] = (this.#scene.segments[segment] as Scene['segments'][number]).vertices;
      const at = vector(shape.shown, 3 * (first + Math.round(t * (count - 1))));
      const way = lineForce(shape, line, t).multiplyScalar(dense > 0 ? (0.35 * this.#reach) / dense : 0);
      // Loads along a beam end on it.
      arrow.set(at.sub(way), way);
    }
  }
}

function lineForce(shape: Shape, line: number, t: number): THREE.Vector3 {
  return vector(shape.lines, 12 * line).lerp(vector(shape.lines, 12 * line + 6), t);
}

function vector(of: Float64Array, at: number): THREE.Vector3 {
  return new THREE.Vector3(of[at] ?? 0, of[at + 1] ?? 0, of[at + 2] ?? 0);
}

/** Masses as balls with the quarters of a centre of mass, and an arrow of gravity. */
export class Weights {
  readonly group = new THREE.Group();
  readonly #balls: { mesh: THREE.Mesh; node: number }[] = [];
  readonly #gravity: Arrow | null = null;
  readonly #way = new THREE.Vector3();

  constructor(scene: Scene, materialOf: (colour: string) => THREE.Material) {
    const largest = Math.max(...scene.masses.map(({ mass }) => mass), 0);
    const dark = materialOf('#30363f');
    const light = materialOf('#f4f5f7');
    for (const { node, mass } of scene.masses) {
      const radius = 0.035 * scene.size * (0.5 + 0.5 * Math.cbrt(mass / (largest || 1)));
      const mesh = new THREE.Mesh(new THREE.SphereGeometry(radius, 24, 16), light);
      for (let octant = 0; octant < 8; octant++) {
        if ([0, 2, 5, 7].includes(octant)) {
          const start = (octant % 4) * (Math.PI / 2);
          const from = octant < 4 ? 0 : Math.PI / 2;
          mesh.add(new THREE.Mesh(new THREE.SphereGeometry(1.01 * radius, 8, 6, start, Math.PI / 2, from, Math.PI / 2), dark));
        }
      }
      mesh.userData = { mass, node };
      this.#balls.push({ mesh, node });
      this.group.add(mesh);
    }
    if (scene.gravity) {
      this.#way.set(...scene.gravity).normalize().multiplyScalar(0.22 * scene.size);
      this.#gravity = new Arrow(materialOf('#5a7d2c'), 0.007 * scene.size);
      this.group.add(this.#gravity.group);
    }
  }

  /** The mass that an object shows: `M 2.5 kg`. */
  massOf(object: THREE.Object3D): { mass: number; node: number } | null {
    const ball = this.#balls.find(({ mesh }) => mesh === object || mesh === object.parent);
    return ball ? (ball.mesh.userData as { mass: number; node: number }) : null;
  }

  update(shape: Shape, corner: THREE.Vector3): void {
    for (const { mesh, node } of this.#balls) {
      mesh.position.copy(vector(shape.shown, 3 * node));
    }
    this.#gravity?.set(corner, this.#way);
  }
}

/** Three axes: x red, y green, z blue, with their letters told by labels. */
export function triad(length: number): THREE.LineSegments {
  const ends = [0, 1, 2].flatMap((k) => [0, 0, 0, ...[0, 1, 2].map((c) => (c === k ? length : 0))]);
  const colours = ['#c8372d', '#2f9e44', '#2b6fdb'].flatMap((hex) => {
    const rgb = new THREE.Color(hex);
    return [rgb.r, rgb.g, rgb.b, rgb.r, rgb.g, rgb.b];
  });
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(ends, 3));
  geometry.setAttribute('color', new THREE.Float32BufferAttribute(colours, 3));
  return new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ vertexColors: true, depthTest: false, transparent: true }));
}
