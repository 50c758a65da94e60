// Where the vertices of a mechanism are shown: its places, and a displacement times a factor.

import * as THREE from 'three';
import type { Layout, Scene } from '../core';

/** Places and displacements of one answer, and what is shown of them. */
export class Shape {
  readonly vertices: number;
  /** 3 a vertex: where it stands without load. */
  places: Float64Array;
  /** 3 a vertex: where it is shown. */
  readonly shown: Float64Array;
  /** 6 a vertex: displacement and rotation under load. */
  displacements: Float64Array;
  /** Largest equivalent stress a vertex; NaN where none is known. */
  stress: Float64Array;
  /** 9 a segment. */
  axes: Float64Array;
  /** 9 a joint. */
  frames: Float64Array;
  loads: Float64Array;
  lines: Float64Array;
  /** 3 a vertex: a shape of vibration in place of the displacement, or null. */
  mode: Float64Array | null = null;
  /** Times displacements are shown, or of a mode: its amplitude [m] at this instant. */
  factor = 0;

  constructor(scene: Scene, numbers: Float64Array) {
    this.vertices = scene.vertices;
    this.shown = new Float64Array(3 * scene.vertices);
    const part = cut(numbers, scene.layout);
    this.places = part('positions');
    this.displacements = part('displacements');
    this.stress = part('stress');
    this.axes = part('axes');
    this.frames = part('frames');
    this.loads = part('loads');
    this.lines = part('lines');
    this.refresh();
  }

  /** Takes the numbers of another pose. */
  take(numbers: Float64Array, layout: Layout): void {
    const part = cut(numbers, layout);
    this.places = part('positions');
    this.displacements = part('displacements');
    this.stress = part('stress');
    this.axes = part('axes');
    this.frames = part('frames');
    this.loads = part('loads');
    this.lines = part('lines');
  }

  /** Works out what is shown. */
  refresh(): void {
    const { places, shown, displacements, mode, factor } = this;
    for (let v = 0; v < this.vertices; v++) {
      for (let k = 0; k < 3; k++) {
        const move = mode ? mode[3 * v + k] : displacements[6 * v + k];
        shown[3 * v + k] = (places[3 * v + k] as number) + factor * finite(move);
      }
    }
  }

  /** The box around all places. */
  #box(): THREE.Box3 {
    const box = new THREE.Box3();
    const at = new THREE.Vector3();
    for (let v = 0; v < this.vertices; v++) {
      box.expandByPoint(at.set(this.places[3 * v] as number, this.places[3 * v + 1] as number, this.places[3 * v + 2] as number));
    }
    return box;
  }

  /** Half the diagonal of the box around all places [m]. */
  reach(): number {
    return 0.5 * this.#box().getSize(new THREE.Vector3()).length();
  }

  /** Beside all places, at the height of the highest. */
  corner(): THREE.Vector3 {
    const { max, min } = this.#box();
    return new THREE.Vector3(max.x + 0.1 * (max.x - min.x), max.y, max.z);
  }

  /** Length of the displacement of a vertex [m], or of the mode's. */
  moved(v: number): number {
    const at = this.mode ? 3 * v : 6 * v;
    const from = this.mode ?? this.displacements;
    return Math.hypot(finite(from[at]), finite(from[at + 1]), finite(from[at + 2]));
  }
}

function cut(numbers: Float64Array, layout: Layout): (name: keyof Layout) => Float64Array {
  return (name) => {
    const [offset, length] = layout[name];
    return numbers.subarray(offset, offset + length);
  };
}

function finite(value: number | undefined): number {
  return value !== undefined && Number.isFinite(value) ? value : 0;
}
