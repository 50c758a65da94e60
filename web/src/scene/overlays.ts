// What is laid over the mechanism: ellipsoids of stiffness, the undeformed lines, the path, a map of a plane.

import * as THREE from 'three';
import type { Principal, Scene } from '../core';
import { colour } from './colours';
import type { Shape } from './shape';

/** An ellipsoid whose half axes are principal values, the largest of which is `reach`. */
export class Ellipsoid {
  readonly group = new THREE.Group();
  readonly #ball: THREE.Mesh;
  readonly #axes: THREE.LineSegments;

  constructor(hex: string, readonly reach: number) {
    const ball = new THREE.SphereGeometry(1, 32, 20);
    this.#ball = new THREE.Mesh(
      ball,
      new THREE.MeshLambertMaterial({ color: hex, transparent: true, opacity: 0.26, depthWrite: false, side: THREE.DoubleSide }),
    );
    const cross = new THREE.BufferGeometry();
    cross.setAttribute('position', new THREE.Float32BufferAttribute([-1, 0, 0, 1, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, -1, 0, 0, 1], 3));
    this.#axes = new THREE.LineSegments(cross, new THREE.LineBasicMaterial({ color: hex }));
    this.group.add(this.#ball, this.#axes);
    this.group.matrixAutoUpdate = false;
    this.#ball.renderOrder = 3;
  }

  set(principal: Principal | null | undefined, at: THREE.Vector3, shown: boolean): void {
    const largest = principal ? Math.max(...principal.values) : 0;
    this.group.visible = shown && largest > 0 && Number.isFinite(largest);
    if (!principal || !this.group.visible) {
      return;
    }
    const columns = principal.directions.map((way, k) => {
      const half = this.reach * Math.max((principal.values[k] as number) / largest, 0.02);
      return new THREE.Vector3(...way).multiplyScalar(half);
    }) as [THREE.Vector3, THREE.Vector3, THREE.Vector3];
    // A left-handed set of directions would turn the ball inside out.
    if (columns[0].clone().cross(columns[1]).dot(columns[2]) < 0) {
      columns[2].negate();
    }
    this.group.matrix.makeBasis(...columns).setPosition(at);
    this.group.matrixWorldNeedsUpdate = true;
  }
}

/** Centre lines of the links without load. */
export class Ghost {
  readonly lines: THREE.LineSegments;
  readonly #pairs: [number, number][] = [];
  readonly #positions: Float32Array;

  constructor(scene: Scene) {
    for (const { vertices, ends } of scene.segments) {
      this.#pairs.push(vertices[1] > 0 ? [vertices[0], vertices[0] + vertices[1] - 1] : ends);
    }
    this.#positions = new Float32Array(6 * this.#pairs.length);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(this.#positions, 3).setUsage(THREE.DynamicDrawUsage));
    const material = new THREE.LineDashedMaterial({ color: '#7b8494', dashSize: 0.02 * scene.size, gapSize: 0.015 * scene.size });
    this.lines = new THREE.LineSegments(geometry, material);
    this.lines.frustumCulled = false;
  }

  update(shape: Shape): void {
    if (!this.lines.visible) {
      return;
    }
    this.#pairs.forEach((pair, k) => {
      pair.forEach((v, end) => {
        for (let c = 0; c < 3; c++) {
          this.#positions[6 * k + 3 * end + c] = shape.places[3 * v + c] as number;
        }
      });
    });
    (this.lines.geometry.attributes.position as THREE.BufferAttribute).needsUpdate = true;
    this.lines.computeLineDistances();
  }
}

/** A line through given points. */
export class Path {
  readonly line: THREE.Line;

  constructor(hex: string) {
    this.line = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: hex }));
    this.line.frustumCulled = false;
  }

  set(points: readonly (readonly number[])[]): void {
    this.line.geometry.dispose();
    this.line.geometry = new THREE.BufferGeometry();
    this.line.geometry.setAttribute('position', new THREE.Float32BufferAttribute(points.flatMap((p) => p.slice(0, 3)), 3));
    this.line.visible = points.length > 1;
  }
}

/** A plane of the workspace as a picture of numbers, filled row by row. */
export class HeatPlane {
  readonly mesh: THREE.Mesh;
  readonly #pixels: Uint8Array;
  readonly #texture: THREE.DataTexture;

  constructor(origin: THREE.Vector3, along: THREE.Vector3, up: THREE.Vector3, columns: number, rows: number) {
    this.#pixels = new Uint8Array(4 * columns * rows);
    this.#texture = new THREE.DataTexture(this.#pixels, columns, rows);
    this.#texture.colorSpace = THREE.SRGBColorSpace;
    this.#texture.magFilter = THREE.NearestFilter;
    const geometry = new THREE.BufferGeometry();
    // A sample is the middle of its pixel: the picture reaches half a step beyond the plane's ends.
    const corner = (a: number, b: number): number[] =>
      origin.clone().addScaledVector(along, stretched(a, columns)).addScaledVector(up, stretched(b, rows)).toArray();
    const positions = [...corner(0, 0), ...corner(1, 0), ...corner(1, 1), ...corner(0, 1)];
    geometry.setAttribute('position', new THREE.Float32BufferAttribute(positions, 3));
    geometry.setAttribute('uv', new THREE.Float32BufferAttribute([0, 0, 1, 0, 1, 1, 0, 1], 2));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    const material = new THREE.MeshBasicMaterial({
      map: this.#texture,
      transparent: true,
      opacity: 0.8,
      side: THREE.DoubleSide,
      depthWrite: false,
    });
    this.mesh = new THREE.Mesh(geometry, material);
    this.mesh.renderOrder = 1;
  }

  /** Paints all values; `scale` brings a value to 0 … 1. NaN is left clear. */
  paint(values: Float64Array, scale: (value: number) => number): void {
    const rgb: [number, number, number] = [0, 0, 0];
    for (let k = 0; k < values.length; k++) {
      const value = values[k] as number;
      const known = Number.isFinite(value);
      colour('map', known ? scale(value) : 0, rgb, 0);
      for (let c = 0; c < 3; c++) {
        this.#pixels[4 * k + c] = Math.round(255 * (rgb[c] as number));
      }
      this.#pixels[4 * k + 3] = known ? 255 : 0;
    }
    this.#texture.needsUpdate = true;
  }

  dispose(): void {
    this.#texture.dispose();
    this.mesh.geometry.dispose();
    (this.mesh.material as THREE.Material).dispose();
  }
}

function stretched(t: number, count: number): number {
  const half = count > 1 ? 0.5 / (count - 1) : 0;
  return t === 0 ? -half : 1 + half;
}
