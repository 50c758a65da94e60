// Small shapes that many parts share: joints, ground, masses. One draw call a kind of shape.

import * as THREE from 'three';

/** One small shape: which, in which colour, where, and of what. */
export interface Glyph {
  shape: string;
  colour: THREE.Color;
  /** The number of the joint or mass that it belongs to. */
  owner: number;
  /** From the owner's frame to its own. */
  local: THREE.Matrix4;
}

export class Glyphs {
  readonly group = new THREE.Group();
  readonly #sets: { mesh: THREE.InstancedMesh; glyphs: Glyph[] }[] = [];
  readonly #matrix = new THREE.Matrix4();

  constructor(glyphs: readonly Glyph[], shapes: ReadonlyMap<string, THREE.BufferGeometry>, material: THREE.Material) {
    for (const [name, own] of Map.groupBy(glyphs, (glyph) => glyph.shape)) {
      const geometry = shapes.get(name);
      if (!geometry) {
        continue;
      }
      const mesh = new THREE.InstancedMesh(geometry, material, own.length);
      mesh.instanceMatrix.setUsage(THREE.DynamicDrawUsage);
      mesh.frustumCulled = false;
      own.forEach((glyph, k) => mesh.setColorAt(k, glyph.colour));
      this.#sets.push({ mesh, glyphs: own });
      this.group.add(mesh);
    }
  }

  /** Puts all shapes where their owners' frames are. */
  place(frameOf: (owner: number) => THREE.Matrix4): void {
    for (const { mesh, glyphs } of this.#sets) {
      glyphs.forEach((glyph, k) => {
        mesh.setMatrixAt(k, this.#matrix.multiplyMatrices(frameOf(glyph.owner), glyph.local));
      });
      mesh.instanceMatrix.needsUpdate = true;
      mesh.boundingSphere = null;
    }
  }

  /** Paints the shapes of some owners in another colour; the others in their own. */
  tint(colourOf: (owner: number) => THREE.Color | null): void {
    for (const { mesh, glyphs } of this.#sets) {
      glyphs.forEach((glyph, k) => mesh.setColorAt(k, colourOf(glyph.owner) ?? glyph.colour));
      if (mesh.instanceColor) {
        mesh.instanceColor.needsUpdate = true;
      }
    }
  }

  /** The owner of what was hit, or null. */
  ownerOf(object: THREE.Object3D, instance: number | undefined): number | null {
    const set = this.#sets.find((each) => each.mesh === object);
    return instance === undefined ? null : (set?.glyphs[instance]?.owner ?? null);
  }

  /** Every shape with its corners' mesh, for a drawing of lines. */
  *each(): Generator<{ geometry: THREE.BufferGeometry; matrix: THREE.Matrix4; colour: THREE.Color; owner: number }> {
    for (const { mesh, glyphs } of this.#sets) {
      for (const [k, glyph] of glyphs.entries()) {
        const matrix = new THREE.Matrix4();
        mesh.getMatrixAt(k, matrix);
        yield { geometry: mesh.geometry, matrix, colour: glyph.colour, owner: glyph.owner };
      }
    }
  }

  dispose(): void {
    for (const { mesh } of this.#sets) {
      mesh.dispose();
    }
  }
}
