// The scene as an SVG of clean outlines: every convex piece as the outline of its picture, far ones first.

import * as THREE from 'three';
import { css } from './colours';
import type { Mechanism } from './mechanism';
import type { Stage } from './stage';

interface Piece {
  depth: number;
  svg: string;
}

type At = [number, number];

/** The picture of the stage as it stands, in SVG. */
export function svg(stage: Stage, dark: boolean): string {
  const mechanism = stage.mechanism;
  const [width, height] = stage.viewer.extent;
  const ink = dark ? '#e8ebf0' : '#1d232c';
  const pieces: Piece[] = mechanism ? [...links(stage, mechanism), ...hulls(stage, mechanism), ...arrows(stage, mechanism)] : [];
  pieces.sort((a, b) => b.depth - a.depth);
  const names = stage.labels.shown().map(
    ({ text, x, y }) => `<text x="${x.toFixed(1)}" y="${(y + 4).toFixed(1)}" text-anchor="middle">${escaped(text)}</text>`,
  );
  return [
    `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" font-family="sans-serif" font-size="12" fill="${ink}">`,
    `<title>${escaped(mechanism?.scene.title ?? 'mechanism')}</title>`,
    `<rect width="${width}" height="${height}" fill="${dark ? '#14181f' : '#ffffff'}"/>`,
    ...(mechanism ? lines(stage, mechanism, true) : []),
    `<g stroke="#20262f" stroke-width="0.5" stroke-linejoin="round">`,
    ...pieces.map((piece) => piece.svg),
    '</g>',
    ...(mechanism ? lines(stage, mechanism, false) : []),
    ...names,
    ...legend(stage, ink, height),
    '</svg>',
    '',
  ].join('\n');
}

function links(stage: Stage, mechanism: Mechanism): Piece[] {
  const { viewer } = stage;
  const colours = mechanism.beams.mesh.geometry.attributes.color as THREE.BufferAttribute;
  return mechanism.scene.segments.flatMap(({ vertices: [, stations] }, s) =>
    Array.from({ length: stations - 1 }, (_, k): Piece => {
      const rings = [mechanism.beams.ring(s, k), mechanism.beams.ring(s, k + 1)];
      const at = rings.flatMap((ring) => Array.from({ length: ring.length / 3 }, (_, c) => viewer.project(new THREE.Vector3(...ring.subarray(3 * c, 3 * c + 3)))));
      const first = mechanism.beams.firstOf(s, k);
      const fill = hex(new THREE.Color(colours.getX(first), colours.getY(first), colours.getZ(first)));
      // Its own colour as the line, so that the pieces of a link show no seams.
      return { depth: mean(at.map(([, , z]) => z)), svg: polygon(hull(at), fill, ` stroke="${fill}"`) };
    }),
  );
}

/** Lines: dashed ones of what is undeformed, or those of frames and axes. */
function lines(stage: Stage, mechanism: Mechanism, undeformed: boolean): string[] {
  const found: string[] = [];
  mechanism.group.traverseVisible((object) => {
    const drawn = object as THREE.LineSegments;
    if (!drawn.isLineSegments) {
      return;
    }
    drawn.updateWorldMatrix(true, false);
    const { position, color } = drawn.geometry.attributes as { position: THREE.BufferAttribute; color?: THREE.BufferAttribute };
    const material = drawn.material as THREE.LineBasicMaterial;
    const dashed = (material as { isLineDashedMaterial?: boolean }).isLineDashedMaterial === true;
    if (dashed !== undeformed) {
      return;
    }
    for (let k = 0; k + 1 < position.count; k += 2) {
      const [a, b] = [k, k + 1].map((v) => stage.viewer.project(new THREE.Vector3().fromBufferAttribute(position, v).applyMatrix4(drawn.matrixWorld)));
      const stroke = color ? hex(new THREE.Color(color.getX(k), color.getY(k), color.getZ(k))) : hex(material.color);
      const [[x1, y1], [x2, y2]] = [a, b] as [number[], number[]];
      found.push(
        `<line x1="${x1?.toFixed(1)}" y1="${y1?.toFixed(1)}" x2="${x2?.toFixed(1)}" y2="${y2?.toFixed(1)}" stroke="${stroke}" stroke-width="1"${dashed ? ' stroke-dasharray="5 4"' : ''}/>`,
      );
    }
  });
  return found;
}

function hulls(stage: Stage, mechanism: Mechanism): Piece[] {
  const found: Piece[] = [];
  for (const { block, material } of mechanism.blocks) {
    found.push(piece(stage, block.mesh.geometry, new THREE.Matrix4(), hex(material.color)));
  }
  for (const [glyphs, shown] of [[mechanism.joints.glyphs, mechanism.shown.joints], [mechanism.joints.ground, mechanism.shown.ground]] as const) {
    if (shown) {
      for (const { geometry, matrix, colour } of glyphs.each()) {
        found.push(piece(stage, geometry, matrix, hex(colour)));
      }
    }
  }
  return found;
}

/** One mesh: convex ones as their outline, rings and coils as a line as wide as their tube. */
function piece(stage: Stage, geometry: THREE.BufferGeometry, matrix: THREE.Matrix4, fill: string, edge = ''): Piece {
  const corners = geometry.attributes.position as THREE.BufferAttribute;
  const at = Array.from({ length: corners.count }, (_, k) => stage.viewer.project(new THREE.Vector3().fromBufferAttribute(corners, k).applyMatrix4(matrix)));
  const depth = mean(at.map(([, , z]) => z));
  const line = middle(geometry);
  if (!line) {
    return { depth, svg: polygon(hull(at), fill, edge) };
  }
  const scale = new THREE.Vector3().setFromMatrixScale(matrix).x;
  const width = (2 * line.tube * scale) / stage.viewer.pixel(new THREE.Vector3().setFromMatrixPosition(matrix));
  const points = line.points.map((point) => stage.viewer.project(point.applyMatrix4(matrix)));
  const told = points.map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`).join(' ');
  return { depth, svg: `<polyline points="${told}" fill="none" stroke="${fill}" stroke-width="${width.toFixed(2)}"/>` };
}

/** The middle line of a ring (turned about y) or a coil, and the radius of its tube. */
function middle(geometry: THREE.BufferGeometry): { points: THREE.Vector3[]; tube: number } | null {
  if (geometry.type === 'TorusGeometry') {
    const { radius, tube, arc } = (geometry as THREE.TorusGeometry).parameters;
    const points = Array.from({ length: 33 }, (_, k) => {
      const angle = (k * arc) / 32;
      return new THREE.Vector3(radius * Math.cos(angle), 0, radius * Math.sin(angle));
    });
    return { points, tube };
  }
  if (geometry.type === 'TubeGeometry') {
    const { path, radius } = (geometry as THREE.TubeGeometry).parameters;
    return { points: path.getPoints(60) as THREE.Vector3[], tube: radius };
  }
  return null;
}

/** Meshes of loads, masses and gravity. */
function arrows(stage: Stage, mechanism: Mechanism): Piece[] {
  const found: Piece[] = [];
  for (const group of mechanism.acting()) {
    group.traverseVisible((object) => {
      const mesh = object as THREE.Mesh;
      if (mesh.isMesh) {
        mesh.updateWorldMatrix(true, false);
        const fill = hex((mesh.material as THREE.MeshLambertMaterial).color);
        found.push(piece(stage, mesh.geometry, mesh.matrixWorld, fill, ` stroke="${fill}"`));
      }
    });
  }
  return found;
}

function legend(stage: Stage, ink: string, height: number): string[] {
  const own = stage.mechanism?.legend();
  if (!own) {
    return [];
  }
  const stops = Array.from({ length: 9 }, (_, k) => `<stop offset="${k / 8}" stop-color="${css(own.ramp, k / 8)}"/>`);
  const ends = [...stage.legend.querySelectorAll('.legend-ends span')].map((each) => each.textContent ?? '');
  const y = height - 44;
  return [
    `<defs><linearGradient id="ramp">${stops.join('')}</linearGradient></defs>`,
    `<text x="20" y="${y - 6}">${escaped(own.title)}</text>`,
    `<rect x="20" y="${y}" width="220" height="10" fill="url(#ramp)"/>`,
    ...ends.map((text, k) => `<text x="${20 + 110 * k}" y="${y + 24}" text-anchor="${['start', 'middle', 'end'][k]}" fill="${ink}">${escaped(text)}</text>`),
  ];
}

/** Corners of the smallest convex polygon around points (Andrew's monotone chain). */
export function hull(points: readonly (readonly number[])[]): At[] {
  const sorted = points.map(([x, y]): At => [x as number, y as number]).sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const cross = (o: At, a: At, b: At): number => (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
  const chain = (list: readonly At[]): At[] => {
    const made: At[] = [];
    for (const point of list) {
      while (made.length > 1 && cross(made[made.length - 2] as At, made[made.length - 1] as At, point) <= 0) {
        made.pop();
      }
      made.push(point);
    }
    return made.slice(0, -1);
  };
  return [...chain(sorted), ...chain([...sorted].reverse())];
}

function polygon(corners: readonly At[], fill: string, more = ''): string {
  return `<polygon points="${corners.map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`).join(' ')}" fill="${fill}"${more}/>`;
}

function hex(colour: THREE.Color): string {
  return `#${colour.getHexString()}`;
}

function mean(all: readonly number[]): number {
  return all.reduce((sum, each) => sum + each, 0) / Math.max(all.length, 1);
}

function escaped(text: string): string {
  return text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;');
}
