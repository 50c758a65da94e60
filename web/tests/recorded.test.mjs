// The page without the core shows what was worked out beforehand, and says so.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { difference, key, opened, solved, viewed } from './support.mjs';

test('results, modes, maps and poses that stand in the page', async () => {
  const { page, quiet, close } = await opened(viewed('examples/delta.ron'));
  const own = await page.evaluate(() => window.hyperstat.solve());
  const native = solved('examples/delta.ron');
  assert.ok(difference(own.output.stiffness, native.output.stiffness) < 1e-12);
  const rejected = await page.evaluate(() => window.hyperstat.solve('(…)').then(() => '', (error) => error.message));
  assert.match(rejected, /live/);
  assert.match(await page.locator('.recorded').textContent(), /just web/);
  assert.ok(Math.abs((await key(page, 'deflection')) / 1.29307e-4 - 1) < 1e-3);
  await page.getByRole('button', { name: 'arm3', exact: true }).click();
  assert.match(await page.locator('#panel-part').textContent(), /sections\.arm\.diameter/);
  await page.getByRole('tab', { name: 'Modes' }).click();
  await page.locator('.mode').first().click();
  await page.getByRole('tab', { name: 'Map' }).click();
  await page.locator('.map .told', { hasText: 'poses reached' }).waitFor();
  await page.getByRole('tab', { name: 'Answer' }).click();
  // It moves among the poses that were worked out.
  const before = await key(page, 'deflection');
  const x = page.locator('.move .slider input[type=range]').first();
  await x.evaluate((bar) => {
    bar.value = bar.max;
    bar.dispatchEvent(new Event('input'));
  });
  await page.waitForTimeout(80);
  assert.notEqual(await key(page, 'deflection'), before);
  quiet();
  await close();
});

test('a batch: the poses of its job', async () => {
  const { page, quiet, close } = await opened(viewed('examples/paper.ron', '--job', 'delta-rigid-trajectory'));
  await page.getByRole('tab', { name: 'Poses' }).click();
  await page.locator('.uplot').waitFor();
  const before = await key(page, 'deflection');
  await page.getByLabel('Pose of the job').fill('20');
  assert.notEqual(await key(page, 'deflection'), before);
  quiet();
  await close();
});
