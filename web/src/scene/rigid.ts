// Rigid and flexible bodies: plates, bars and blocks around their nodes.

import * as THREE from 'three';
import { ConvexHull } from 'three/examples/jsm/math/ConvexHull.js';
import type { SceneBody } from '../core';
import type { Shape } from './shape';

/** One body, drawn as the hull of small shapes at its nodes. */
export class Block {
  readonly mesh: THREE.Mesh;
  readonly #nodes: number[];
  /** Node of each corner of the mesh, and the corner's way from it, in the body's home frame. */
  readonly #of: Uint32Array;
  readonly #ways: Float64Array;
  readonly #positions: Float32Array;
  /** Three nodes that are in no line, as places in `#nodes`, or null. */
  readonly #triple: [number, number, number] | null;
  readonly #home = new THREE.Matrix4();
  readonly #turn = new THREE.Matrix4();

  constructor(body: SceneBody, shape: Shape, radius: number, material: THREE.Material) {
    this.#nodes = body.nodes;
    const places = body.nodes.map((v) => point(shape.places, v));
    this.#triple = triple(places, radius);
    if (this.#triple) {
      basis(places, this.#triple, this.#home);
    }
    const { ways, groups } = planned(places, this.#triple, radius);
    const cloud = places.flatMap((place, n) => ways.map((way) => ({ n, way, at: place.clone().add(way) })));
    const corners = groups.flatMap((group) => {
      const own = group.flatMap((n) => ways.map((_, w) => n * ways.length + w));
      return hull(own.map((c) => (cloud[c] as (typeof cloud)[number]).at)).map((k) => own[k] as number);
    });
    this.#of = Uint32Array.from(corners, (c) => cloud[c]?.n ?? 0);
    this.#ways = Float64Array.from(corners.flatMap((c) => cloud[c]?.way.toArray() ?? [0, 0, 0]));
    this.#positions = new Float32Array(3 * corners.length);
    const geometry = new THREE.BufferGeometry();
    const attribute = new THREE.BufferAttribute(this.#positions, 3).setUsage(THREE.DynamicDrawUsage);
    geometry.setAttribute('position', attribute);
    geometry.setAttribute('normal', new THREE.BufferAttribute(new Float32Array(3 * corners.length), 3));
    this.mesh = new THREE.Mesh(geometry, material);
    this.mesh.frustumCulled = false;
    this.update(shape);
  }

  /** Puts the body where the shape shows its nodes. */
  update(shape: Shape): void {
    const turn = this.#rotation(shape).elements;
    const [positions, ways] = [this.#positions, this.#ways];
    for (let c = 0; c < this.#of.length; c++) {
      const v = 3 * (this.#nodes[this.#of[c] as number] as number);
      const [x, y, z] = [ways[3 * c] as number, ways[3 * c + 1] as number, ways[3 * c + 2] as number];
      for (let k = 0; k < 3; k++) {
        const way = (turn[k] as number) * x + (turn[4 + k] as number) * y + (turn[8 + k] as number) * z;
        positions[3 * c + k] = (shape.shown[v + k] as number) + way;
      }
    }
    const { geometry } = this.mesh;
    (geometry.attributes.position as THREE.BufferAttribute).needsUpdate = true;
    geometry.computeVertexNormals();
    geometry.boundingSphere = null;
  }

  /** From the frame in which the hull was made to the one of now. */
  #rotation(shape: Shape): THREE.Matrix4 {
    if (!this.#triple) {
      return this.#turn.identity();
    }
    const places = this.#nodes.map((v) => point(shape.shown, v));
    const now = basis(places, this.#triple, new THREE.Matrix4());
    return this.#turn.copy(now).multiply(this.#home.clone().transpose());
  }
}

function point(of: Float64Array, v: number): THREE.Vector3 {
  return new THREE.Vector3(of[3 * v], of[3 * v + 1], of[3 * v + 2]);
}

function triple(places: readonly THREE.Vector3[], radius: number): [number, number, number] | null {
  const first = places[0];
  if (!first) {
    return null;
  }
  const far = (from: (p: THREE.Vector3) => number): number =>
    places.reduce((best, place, k) => (from(place) > from(places[best] as THREE.Vector3) ? k : best), 0);
  const second = far((place) => place.distanceTo(first));
  const line = (places[second] as THREE.Vector3).clone().sub(first);
  const away = (place: THREE.Vector3): number => place.clone().sub(first).cross(line).length() / (line.length() || 1);
  const third = far(away);
  return away(places[third] as THREE.Vector3) > 0.2 * radius ? [0, second, third] : null;
}

function basis(places: readonly THREE.Vector3[], [a, b, c]: [number, number, number], into: THREE.Matrix4): THREE.Matrix4 {
  const from = places[a] as THREE.Vector3;
  const x = (places[b] as THREE.Vector3).clone().sub(from).normalize();
  const z = x.clone().cross((places[c] as THREE.Vector3).clone().sub(from)).normalize();
  return into.makeBasis(x, z.clone().cross(x), z);
}

/**
 * What stands around each node, and which nodes have a hull together: discs and one plate where all lie in a plane, a cube
 * for a single node, elsewhere balls with bars to the node nearest to the middle.
 */
function planned(places: readonly THREE.Vector3[], found: [number, number, number] | null, radius: number): { ways: THREE.Vector3[]; groups: number[][] } {
  const all = places.map((_, n) => n);
  if (places.length === 1) {
    return { ways: corners(0.9 * radius), groups: [all] };
  }
  if (found) {
    const frame = basis(places, found, new THREE.Matrix4());
    const [x, y, z] = [0, 1, 2].map((k) => new THREE.Vector3().setFromMatrixColumn(frame, k)) as [THREE.Vector3, THREE.Vector3, THREE.Vector3];
    const origin = places[found[0]] as THREE.Vector3;
    if (places.every((place) => Math.abs(place.clone().sub(origin).dot(z)) < 0.1 * radius)) {
      return { ways: disc(x, y, z, radius), groups: [all] };
    }
  }
  const middle = places.reduce((sum, place) => sum.add(place), new THREE.Vector3()).divideScalar(places.length);
  const hub = all.reduce((best, n) => (at(places, n).distanceTo(middle) < at(places, best).distanceTo(middle) ? n : best), 0);
  const ball = new THREE.IcosahedronGeometry(0.8 * radius, 1).attributes.position as THREE.BufferAttribute;
  const ways = unique(Array.from({ length: ball.count }, (_, k) => new THREE.Vector3().fromBufferAttribute(ball, k)), radius);
  return { ways, groups: all.filter((n) => n !== hub).map((n) => [hub, n]) };
}

function at(places: readonly THREE.Vector3[], n: number): THREE.Vector3 {
  return places[n] as THREE.Vector3;
}

function disc(x: THREE.Vector3, y: THREE.Vector3, z: THREE.Vector3, radius: number): THREE.Vector3[] {
  return [-0.55, 0.55].flatMap((height) =>
    Array.from({ length: 16 }, (_, k) => {
      const angle = (k * Math.PI) / 8;
      const way = x.clone().multiplyScalar(1.5 * radius * Math.cos(angle));
      return way.addScaledVector(y, 1.5 * radius * Math.sin(angle)).addScaledVector(z, height * radius);
    }),
  );
}

function corners(half: number): THREE.Vector3[] {
  return [-half, half].flatMap((x) => [-half, half].flatMap((y) => [-half, half].map((z) => new THREE.Vector3(x, y, z))));
}

function unique(all: THREE.Vector3[], radius: number): THREE.Vector3[] {
  return all.filter((each, k) => all.findIndex((other) => other.distanceTo(each) < 1e-3 * radius) === k);
}

/** Corners of the triangles of the hull, as places in `cloud`. */
function hull(cloud: readonly THREE.Vector3[]): number[] {
  const places = new Map(cloud.map((each, k) => [each, k] as const));
  const made = new ConvexHull().setFromPoints([...cloud]);
  const found: number[] = [];
  for (const face of made.faces) {
    let edge = face.edge;
    do {
      found.push(places.get(edge.head().point) ?? 0);
      edge = edge.next;
    } while (edge !== face.edge);
  }
  return found;
}
