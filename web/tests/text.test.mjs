// What the editor knows of a text: places, paths, completion; numbers as the reports tell them; links.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { test } from 'node:test';
import { program, source, text } from './support.mjs';

test('places have the path that vary takes', async () => {
  const { numbers } = await source('editor/outline.ts');
  const leaves = numbers(text('examples/delta.ron'));
  const value = (path) => leaves.find((leaf) => leaf.path === path)?.value;
  assert.equal(value('sections.arm.diameter'), 0.03);
  assert.equal(value('materials.steel.young'), 2.1e11);
  assert.equal(value('points.C1.1'), -0.14);
  assert.equal(value('joints.B1.kind.axis.0'), 1);
  assert.equal(value('loads.0.force.2'), 100);
  const batch = numbers(text('examples/paper.ron'));
  assert.equal(batch.find(({ path }) => path === 'jobs.2.mechanism.rod.section.diameter').value, 0.014);
});

test('half a text has places, too', async () => {
  const { placeAt, pathOf } = await source('editor/outline.ts');
  const half = '( name: "a", // (not a bracket\n sections: { "rod": Circle(dia';
  const place = placeAt(half, half.length);
  assert.equal(place.word, 'dia');
  assert.deepEqual(place.levels.map(({ bracket, variant, key }) => [bracket, variant, key]), [
    ['(', null, 'sections'],
    ['{', null, 'rod'],
    ['(', 'Circle', null],
  ]);
  const within = '(joints: { "A": (at: "';
  const quoted = placeAt(within, within.length);
  assert.equal(quoted.quoted, true);
  assert.equal(pathOf(quoted.levels), 'joints.A.at');
});

test('completion offers what the schema and the file have', async () => {
  const { completer } = await source('editor/complete.ts');
  const schema = JSON.parse(execFileSync(program, ['schema'], { maxBuffer: 1 << 26 }));
  const complete = completer(schema);
  const at = (words) => {
    const found = complete({ state: { doc: { toString: () => words } }, pos: words.length, explicit: true });
    return found ? found.options.map(({ label }) => label) : [];
  };
  assert.ok(at('(name: "a", ').includes('sections'));
  assert.ok(!at('(name: "a", ').includes('name'));
  assert.deepEqual(at('(sections: {"rod": Ci').filter((label) => label === 'Circle'), ['Circle']);
  assert.ok(at('(sections: {"rod": Circle(').includes('diameter'));
  assert.ok(at('(joints: {"A": (kind: Rev').includes('Revolute'));
  assert.ok(at('(joints: {"A": (').includes('stiffness'));
  assert.ok(at('(jobs: [(mechanism: Delta(').includes('arm_length'));
  assert.ok(at('(points: {"P": (0, 0, 0)}, joints: {"A": (at: "').includes('P'));
  assert.deepEqual(at('(bodies: {"arm": Rigid(points: [])}, joints: {"A": (between: ("'), ['ground', 'arm']);
});

test('numbers are written as in the reports', async () => {
  const { number, withPrefix, signed } = await source('format.ts');
  const cases = [
    [0, '0'],
    [1, '1.00000'],
    [-12.3456789, '-12.3457'],
    [0.05, '0.0500000'],
    [99999.4, '99999.4'],
    [99999.96, '1.00000e5'],
    [9.9999999e-3, '0.0100000'],
    [123456789, '1.23457e8'],
    [-1.5e-7, '-1.50000e-7'],
  ];
  for (const [value, words] of cases) {
    assert.equal(number(value), words);
  }
  assert.equal(withPrefix(1.293e-4, 'm'), '129.3 µm');
  assert.equal(withPrefix(1433100, 'N/m'), '1.433 MN/m');
  assert.equal(withPrefix(0.99999, 'm'), '1.000 m');
  assert.equal(signed(-3.569), '−3.569 %');
});

test('a link holds the text', async () => {
  const { toHash, fromHash } = await source('share.ts');
  const shared = { text: text('examples/paper.ron'), job: 'delta-rigid-trajectory', pose: 3 };
  const hash = await toHash(shared);
  assert.match(hash, /^#s=[\w-]+$/);
  assert.ok(hash.length < shared.text.length);
  assert.deepEqual(await fromHash(hash), shared);
  assert.equal(await fromHash('#elsewhere'), null);
  assert.equal(await fromHash('#s=broken'), null);
});
