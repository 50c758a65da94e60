// Elastic links: their true sections swept along their elastic curves, all in one mesh.

import * as THREE from 'three';
import type { Scene, SceneSection, SceneSegment } from '../core';
import type { Shape } from './shape';
import { linear } from './colours';

/** One closed line of a section along a segment: its outline or its hole. */
interface Skin {
  /** Points and outward normals at both ends, in local y and z: 4 numbers a corner of the mesh. */
  from: Float64Array;
  to: Float64Array;
  corners: number;
}

interface Sweep {
  segment: SceneSegment;
  skins: Skin[];
  /** First vertex of the mesh, and how many. */
  first: number;
  count: number;
}

/** Corners of all links together, beyond which sections are drawn with fewer. */
const MOST = 1_000_000;

/** Gives the colour (sRGB, 0 to 1) of vertex `v` of the scene, of segment `s`. */
export type Paint = (segment: number, v: number, into: Float32Array) => void;

export class Beams {
  readonly mesh: THREE.Mesh;
  readonly #sweeps: Sweep[] = [];
  readonly #positions: Float32Array;
  readonly #normals: Float32Array;
  readonly #colours: Float32Array;
  /** Segment of each triangle. */
  readonly #faces: Uint32Array;
  readonly #centre = new Float32Array(3);

  constructor(scene: Scene, material: THREE.Material) {
    const index: number[] = [];
    const faces: number[] = [];
    let first = 0;
    const corners = scene.segments.reduce((sum, { from, vertices }) => sum + from.outline.length * vertices[1], 0);
    const every = Math.ceil(corners / MOST);
    scene.segments.forEach((given, s) => {
      const segment = every > 1 ? { ...given, from: coarse(given.from, every), to: coarse(given.to, every) } : given;
      const sweep = planned(segment, first, index);
      while (faces.length < index.length / 3) {
        faces.push(s);
      }
      first += sweep.count;
      this.#sweeps.push(sweep);
    });
    this.#positions = new Float32Array(3 * first);
    this.#normals = new Float32Array(3 * first);
    this.#colours = new Float32Array(3 * first);
    this.#faces = Uint32Array.from(faces);
    const geometry = new THREE.BufferGeometry();
    geometry.setIndex(first > 65535 ? new THREE.Uint32BufferAttribute(index, 1) : new THREE.Uint16BufferAttribute(index, 1));
    geometry.setAttribute('position', moving(this.#positions));
    geometry.setAttribute('normal', moving(this.#normals));
    geometry.setAttribute('color', moving(this.#colours));
    this.mesh = new THREE.Mesh(geometry, material);
    this.mesh.frustumCulled = false;
  }

  /** The segment of a triangle that was hit. */
  segmentOf(face: number): number | null {
    return this.#faces[face] ?? null;
  }

  /** Puts all vertices where the shape shows them. */
  update(shape: Shape): void {
    const axes = new Float64Array(9);
    const turned = new Float64Array(9);
    this.#sweeps.forEach((sweep, s) => {
      axes.set(shape.axes.subarray(9 * s, 9 * s + 9));
      const [curve, stations] = sweep.segment.vertices;
      let write = sweep.first;
      for (let k = 0; k < stations; k++) {
        section(shape, curve, stations, k, axes, turned);
        write = this.#ring(sweep, shape.shown, curve + k, k / (stations - 1), turned, write);
      }
      write = this.#cap(sweep, 0, write);
      this.#cap(sweep, stations - 1, write);
    });
    const attributes = this.mesh.geometry.attributes;
    (attributes.position as THREE.BufferAttribute).needsUpdate = true;
    (attributes.normal as THREE.BufferAttribute).needsUpdate = true;
    this.mesh.geometry.boundingSphere = null;
  }

  /** Paints all vertices. */
  colour(paint: Paint): void {
    const rgb = this.#centre;
    this.#sweeps.forEach((sweep, s) => {
      const [curve, stations] = sweep.segment.vertices;
      const around = sweep.skins.reduce((sum, skin) => sum + skin.corners, 0);
      let write = 3 * sweep.first;
      const put = (count: number): void => {
        const [r, g, b] = [linear(rgb[0] as number), linear(rgb[1] as number), linear(rgb[2] as number)];
        for (let n = 0; n < count; n++) {
          this.#colours[write++] = r;
          this.#colours[write++] = g;
          this.#colours[write++] = b;
        }
      };
      for (let k = 0; k < stations; k++) {
        paint(s, curve + k, rgb);
        put(around);
      }
      paint(s, curve, rgb);
      put(around);
      paint(s, curve + stations - 1, rgb);
      put(around);
    });
    (this.mesh.geometry.attributes.color as THREE.BufferAttribute).needsUpdate = true;
  }

  /** The first vertex of the mesh at a station of a segment. */
  firstOf(s: number, station: number): number {
    const sweep = this.#sweeps[s] as Sweep;
    return sweep.first + station * sweep.skins.reduce((sum, skin) => sum + skin.corners, 0);
  }

  /** Corners of the outline of a segment at a station, as shown: 3 numbers each. */
  ring(s: number, station: number): Float32Array {
    const sweep = this.#sweeps[s] as Sweep;
    const from = 3 * this.firstOf(s, station);
    return this.#positions.subarray(from, from + 3 * (sweep.skins[0] as Skin).corners);
  }

  #ring(sweep: Sweep, shown: Float64Array, v: number, t: number, axes: Float64Array, write: number): number {
    const [px, py, pz] = [shown[3 * v] as number, shown[3 * v + 1] as number, shown[3 * v + 2] as number];
    const [yx, yy, yz] = [axes[3] as number, axes[4] as number, axes[5] as number];
    const [zx, zy, zz] = [axes[6] as number, axes[7] as number, axes[8] as number];
    const [positions, normals] = [this.#positions, this.#normals];
    for (const skin of sweep.skins) {
      for (let c = 0; c < skin.corners; c++) {
        const at = 4 * c;
        const y = mixed(skin, at, t);
        const z = mixed(skin, at + 1, t);
        const ny = mixed(skin, at + 2, t);
        const nz = mixed(skin, at + 3, t);
        const to = 3 * write++;
        positions[to] = px + y * yx + z * zx;
        positions[to + 1] = py + y * yy + z * zy;
        positions[to + 2] = pz + y * yz + z * zz;
        normals[to] = ny * yx + nz * zx;
        normals[to + 1] = ny * yy + nz * zy;
        normals[to + 2] = ny * yz + nz * zz;
      }
    }
    return write;
  }

  #cap(sweep: Sweep, station: number, write: number): number {
    const around = sweep.skins.reduce((sum, skin) => sum + skin.corners, 0);
    const stations = sweep.segment.vertices[1];
    const from = 3 * (sweep.first + station * around);
    // From the neighbouring station outwards: the normal of the cap.
    const other = 3 * (sweep.first + (station === 0 ? 1 : stations - 2) * around);
    const [positions, normals, normal] = [this.#positions, this.#normals, this.#centre];
    for (let k = 0; k < 3; k++) {
      normal[k] = (positions[from + k] as number) - (positions[other + k] as number);
    }
    const length = Math.hypot(...normal) || 1;
    for (let c = 0; c < around; c++) {
      const to = 3 * write++;
      for (let k = 0; k < 3; k++) {
        positions[to + k] = positions[from + 3 * c + k] as number;
        normals[to + k] = (normal[k] as number) / length;
      }
    }
    return write;
  }
}

/** A section with fewer corners, for networks of very many links. */
function coarse(section: SceneSection, every: number): SceneSection {
  const fewer = (line: SceneSection['outline']): SceneSection['outline'] => {
    const step = Math.max(1, Math.min(every, Math.floor(line.length / 4)));
    return line.filter((_, k) => k % step === 0);
  };
  return sharp(section) ? section : { ...section, outline: fewer(section.outline), hole: null };
}

function mixed(skin: Skin, at: number, t: number): number {
  const from = skin.from[at] as number;
  return from + t * ((skin.to[at] as number) - from);
}

function moving(array: Float32Array): THREE.BufferAttribute {
  return new THREE.BufferAttribute(array, 3).setUsage(THREE.DynamicDrawUsage);
}

/** Triangles of a segment, added to `index`. */
function planned(segment: SceneSegment, first: number, index: number[]): Sweep {
  const skins = [skin(segment.from, segment.to, 'outline'), skin(segment.from, segment.to, 'hole')].filter((each) => each !== null);
  const stations = segment.vertices[1];
  const around = skins.reduce((sum, each) => sum + each.corners, 0);
  let offset = 0;
  skins.forEach((each, inner) => {
    for (let k = 0; k + 1 < stations; k++) {
      for (let c = 0; c < each.corners; c += each.corners === edgeCorners(segment.from) ? 2 : 1) {
        const next = (c + 1) % each.corners;
        const [a, b] = [first + k * around + offset + c, first + k * around + offset + next];
        const [d, e] = [a + around, b + around];
        index.push(...(inner === 0 ? [a, b, d, b, e, d] : [a, d, b, b, d, e]));
      }
    }
    offset += each.corners;
  });
  const caps = first + stations * around;
  cap(skins, caps, false, index);
  cap(skins, caps + around, true, index);
  return { segment, skins, first, count: (stations + 2) * around };
}

function cap(skins: readonly Skin[], first: number, forward: boolean, index: number[]): void {
  const [outer, hole] = skins;
  if (!outer) {
    return;
  }
  const push = (a: number, b: number, c: number): number => index.push(a, forward ? b : c, forward ? c : b);
  if (hole && hole.corners === outer.corners) {
    for (let c = 0; c < outer.corners; c++) {
      const next = (c + 1) % outer.corners;
      const [a, b, d, e] = [first + c, first + next, first + outer.corners + c, first + outer.corners + next];
      push(a, b, d);
      push(b, e, d);
    }
    return;
  }
  for (let c = 1; c + 1 < outer.corners; c++) {
    push(first, first + c, first + c + 1);
  }
}

/** Corners of the mesh that a section with sharp edges has: two a corner of its outline. */
function edgeCorners(section: SceneSection): number {
  return sharp(section) ? 2 * (opened(section.outline)?.length ?? 0) : -1;
}

function sharp(section: SceneSection): boolean {
  return section.outline.length <= 8;
}

function skin(from: SceneSection, to: SceneSection, part: 'outline' | 'hole'): Skin | null {
  const [a, b] = [opened(from[part]), opened(to[part] ?? from[part])];
  if (!a || !b || a.length < 3 || a.length !== b.length) {
    return null;
  }
  const sign = part === 'outline' ? 1 : -1;
  const made = [a, b].map((line) => (sharp(from) ? edged(line, sign) : smooth(line, sign))) as [Float64Array, Float64Array];
  return { from: made[0], to: made[1], corners: made[0].length / 4 };
}

/** A closed line without its first point at its end. */
function opened(line: Line | null): Line | null {
  const [first, last] = [line?.[0], line?.at(-1)];
  const repeated = line && first && last && line.length > 1 && first[0] === last[0] && first[1] === last[1];
  return repeated ? line.slice(0, -1) : line;
}

type Line = readonly (readonly [number, number])[];

/** Corners doubled, each with the normal of its edge. */
function edged(line: Line, sign: number): Float64Array {
  return Float64Array.from(
    line.flatMap((point, k) => {
      const next = line[(k + 1) % line.length] as readonly [number, number];
      const normal = outward(point, next, sign);
      return [...point, ...normal, ...next, ...normal];
    }),
  );
}

function smooth(line: Line, sign: number): Float64Array {
  return Float64Array.from(
    line.flatMap((point, k) => {
      const before = line[(k + line.length - 1) % line.length] as readonly [number, number];
      const next = line[(k + 1) % line.length] as readonly [number, number];
      return [...point, ...outward(before, next, sign)];
    }),
  );
}

function outward(from: readonly [number, number], to: readonly [number, number], sign: number): [number, number] {
  const [y, z] = [to[0] - from[0], to[1] - from[1]];
  const length = Math.hypot(y, z) || 1;
  return [(sign * z) / length, (-sign * y) / length];
}

/** Axes of the section at station `k` of a curve: the segment's, tilted to the shown tangent and twisted. */
function section(shape: Shape, curve: number, stations: number, k: number, axes: Float64Array, out: Float64Array): void {
  const [before, after] = [curve + Math.max(k - 1, 0), curve + Math.min(k + 1, stations - 1)];
  const { shown } = shape;
  let [tx, ty, tz] = [0, 1, 2].map((c) => (shown[3 * after + c] as number) - (shown[3 * before + c] as number)) as [number, number, number];
  const length = Math.hypot(tx, ty, tz) || 1;
  tx /= length;
  ty /= length;
  tz /= length;
  const [x0, x1, x2] = [axes[0] as number, axes[1] as number, axes[2] as number];
  // The least rotation that brings local x to the tangent: v = x × t, c = x · t.
  const [vx, vy, vz] = [x1 * tz - x2 * ty, x2 * tx - x0 * tz, x0 * ty - x1 * tx];
  const c = x0 * tx + x1 * ty + x2 * tz;
  const scale = 1 / Math.max(1 + c, 1e-9);
  out[0] = tx;
  out[1] = ty;
  out[2] = tz;
  for (const at of [3, 6]) {
    const [ax, ay, az] = [axes[at] as number, axes[at + 1] as number, axes[at + 2] as number];
    const dot = (vx * ax + vy * ay + vz * az) * scale;
    out[at] = c * ax + vy * az - vz * ay + dot * vx;
    out[at + 1] = c * ay + vz * ax - vx * az + dot * vy;
    out[at + 2] = c * az + vx * ay - vy * ax + dot * vz;
  }
  if (shape.mode || shape.factor === 0) {
    return;
  }
  const v = 6 * (curve + k) + 3;
  const d = shape.displacements;
  const twist = shape.factor * ((d[v] ?? 0) * x0 + (d[v + 1] ?? 0) * x1 + (d[v + 2] ?? 0) * x2);
  if (Number.isFinite(twist) && twist !== 0) {
    const [cos, sin] = [Math.cos(twist), Math.sin(twist)];
    for (let n = 0; n < 3; n++) {
      const [y, z] = [out[3 + n] as number, out[6 + n] as number];
      out[3 + n] = cos * y + sin * z;
      out[6 + n] = cos * z - sin * y;
    }
  }
}
