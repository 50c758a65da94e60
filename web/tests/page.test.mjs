// The page opens from the disk without a network, and gives the numbers of the program.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { difference, key, livePage, opened, playground, program, root, solved, text } from './support.mjs';
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';

test('the answer is that of solve --format json', async () => {
  const { page, quiet, close } = await opened(livePage('examples/delta.ron'));
  const own = await page.evaluate(() => window.hyperstat.solve());
  const native = solved('examples/delta.ron');
  assert.deepEqual(Object.keys(own).sort(), Object.keys(native).sort());
  assert.ok(difference(own.output.stiffness, native.output.stiffness) < 1e-12);
  assert.equal(own.mobility, native.mobility);
  assert.ok(Math.abs((await key(page, 'deflection')) / 1.29307e-4 - 1) < 1e-3);
  assert.equal(await page.title(), 'delta – hyperstat');
  quiet();
  await close();
});

test('stiffnesses are the native ones to 1e-12 over the examples and the references', async () => {
  const { page, quiet, close } = await opened(playground());
  const folders = ['examples', 'tests/reference'];
  const files = folders.flatMap((folder) => readdirSync(join(root, folder)).map((name) => `${folder}/${name}`));
  let compared = 0;
  for (const file of files.filter((name) => name.endsWith('.ron'))) {
    const words = text(file);
    if (/Csv\(|File\(|jobs:|include:/.test(words)) {
      continue;
    }
    const native = solved(file);
    if (!native.output.stiffness) {
      continue;
    }
    const own = await page.evaluate((words) => window.hyperstat.solve(words), words);
    const apart = difference(own.output.stiffness, native.output.stiffness);
    assert.ok(apart < 1e-12, `${file}: ${apart}`);
    compared += 1;
  }
  assert.ok(compared >= 15, `${compared} files`);
  quiet();
  await close();
});

test('a job and a pose of a batch', async () => {
  const job = 'delta-rigid-trajectory';
  const files = { 'trajectory.csv': text('examples/trajectory.csv') };
  const { page, quiet, close } = await opened(livePage('examples/paper.ron', { job, pose: 12, files }));
  const own = await page.evaluate(() => window.hyperstat.solve());
  const native = solved('examples/paper.ron', '--job', job, '--pose', '12');
  assert.ok(difference(own.output.stiffness, native.output.stiffness) < 1e-12);
  await page.getByLabel('Job of the batch').selectOption('delta-elastic-trajectory');
  const other = await page.evaluate(() => window.hyperstat.solve());
  assert.notEqual(other.output.stiffness[0][0], own.output.stiffness[0][0]);
  quiet();
  await close();
});

test('a text of its own is solved without touching what is shown, and what is wrong rejects', async () => {
  const { page, quiet, close } = await opened(livePage('examples/delta.ron'));
  const before = await page.locator('#stiffness').textContent();
  const own = await page.evaluate((words) => window.hyperstat.solve(words), text('examples/portal.ron'));
  assert.equal(own.name, 'portal');
  assert.equal(await page.locator('#stiffness').textContent(), before);
  const wrong = await page.evaluate(() => window.hyperstat.solve('(name: 1)').then(() => '', (error) => error.message));
  assert.notEqual(wrong, '');
  quiet();
  await close();
});

test('every example and beginning is shown', async () => {
  const { page, quiet, close } = await opened(playground());
  const menu = page.getByRole('button', { name: 'Examples and files to begin with' });
  await menu.click();
  const names = await page.getByRole('menuitem').allTextContents();
  assert.ok(names.length >= 10, names.join());
  await page.keyboard.press('Escape');
  for (const name of names) {
    await menu.click();
    await page.getByRole('menuitem', { name, exact: true }).click();
    await page.waitForTimeout(60);
    assert.equal(await page.locator('.problem').isVisible(), false, `${name}: ${await page.locator('.problem').textContent()}`);
    assert.match(await page.locator('#key-deflection').textContent(), /\d/, name);
  }
  quiet();
  await close();
});

test('a link holds the text', async () => {
  const { page, close } = await opened(livePage('examples/portal.ron'));
  await page.getByRole('button', { name: 'Share' }).click();
  await page.waitForFunction(() => location.hash.startsWith('#s='));
  const hash = await page.evaluate(() => location.hash);
  await close();
  const other = await opened(playground(), { hash });
  assert.equal(await other.page.locator('h1').textContent(), 'portal');
  other.quiet();
  await other.close();
});

test('pictures are saved as PNG and SVG, texts as they are', async () => {
  const { page, quiet, close } = await opened(livePage('examples/delta.ron'), { acceptDownloads: true });
  const saved = async (button, item) => {
    await page.getByRole('button', { name: button, exact: true }).click();
    const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('menuitem', { name: item }).first().click()]);
    return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
  };
  const png = await saved('Save a picture', 'PNG');
  assert.equal(png.name, 'delta.png');
  assert.equal(png.bytes.subarray(1, 4).toString(), 'PNG');
  const svg = await saved('Save a picture', 'SVG');
  assert.match(svg.bytes.toString(), /^<svg [\s\S]*<polygon [\s\S]*<\/svg>\n$/);
  const words = await saved('Save', 'Text');
  assert.equal(words.bytes.toString(), text('examples/delta.ron'));
  const pose = await saved('Save', 'RON');
  assert.match(pose.bytes.toString(), /name: "delta"/);
  quiet();
  await close();
});

test('keys and names: all that a pointer does', async () => {
  const { page, quiet, close } = await opened(livePage('examples/delta.ron'));
  const nameless = await page.evaluate(() =>
    [...document.querySelectorAll('button, input, select, canvas')]
      .filter((each) => each.checkVisibility())
      .filter((each) => !(each.getAttribute('aria-label') || each.textContent?.trim() || each.labels?.length || each.title))
      .map((each) => each.outerHTML.slice(0, 80)),
  );
  assert.deepEqual(nameless, []);
  const canvas = page.locator('.stage canvas');
  await canvas.focus();
  await page.keyboard.press(']');
  assert.match(await page.locator('.part h3').textContent(), /arm1/);
  const before = await page.locator('#key-deflection').textContent();
  await canvas.focus();
  for (let k = 0; k < 3; k++) {
    await page.keyboard.press('Alt+ArrowRight');
    await page.waitForTimeout(40);
  }
  await page.getByRole('tab', { name: 'Part' }).focus();
  await page.keyboard.press('ArrowLeft');
  assert.equal(await page.getByRole('tab', { name: 'Answer' }).getAttribute('aria-selected'), 'true');
  assert.notEqual(await page.locator('#key-deflection').textContent(), before);
  await canvas.focus();
  await page.keyboard.press('?');
  assert.ok(await page.getByRole('dialog').isVisible());
  assert.match(await page.getByRole('dialog').textContent(), /three [\d.]+ \(MIT\)/);
  await page.keyboard.press('Escape');
  quiet();
  await close();
});

test('a tablet shows all of it', async () => {
  const { page, quiet, close } = await opened(livePage('examples/delta.ron'), { viewport: { width: 820, height: 1180 }, hasTouch: true });
  for (const part of ['.stage canvas', '#key-deflection', '.move .slider']) {
    const box = await page.locator(part).first().boundingBox();
    assert.ok(box && box.x >= 0 && box.x + box.width <= 820 && box.y + box.height <= 1180, part);
  }
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  quiet();
  await close();
});
