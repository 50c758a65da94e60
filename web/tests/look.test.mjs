// What is drawn: deformation, colours, modes, maps, poses; and the text beside it.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { key, livePage, opened, text } from './support.mjs';

const frame = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

/** The picture of the scene, as bytes. */
async function picture(page) {
  await frame(page);
  return (await page.locator('.stage').screenshot()).toString('base64');
}

test('deformation, views and colours change the picture', async () => {
  const { page, quiet, close } = await opened(livePage('examples/delta.ron'));
  const seen = new Set([await picture(page)]);
  const fresh = async (what) => {
    const now = await picture(page);
    assert.ok(!seen.has(now), what);
    seen.add(now);
  };
  await page.getByLabel('Times that deformation is shown').fill('100');
  await fresh('factor');
  for (const colours of ['displacement', 'stress', 'share']) {
    await page.getByLabel('Colours', { exact: true }).selectOption(colours);
    await fresh(colours);
    assert.ok(await page.locator('.legend').isVisible());
  }
  for (const view of ['Front', 'Right', 'Top']) {
    await page.getByRole('button', { name: view, exact: true }).click();
    await fresh(view);
  }
  await page.getByRole('button', { name: 'Ortho' }).click();
  await fresh('orthographic');
  await page.getByRole('button', { name: 'Light or dark' }).click();
  await fresh('dark');
  await page.getByRole('button', { name: 'What is shown' }).click();
  await page.getByRole('menuitemcheckbox', { name: 'Ground' }).click();
  await page.keyboard.press('Escape');
  await fresh('ground');
  quiet();
  await close();
});

test('the budget is of a direction that is chosen', async () => {
  const { page, quiet, close } = await opened(livePage('examples/delta.ron'));
  const budget = page.getByLabel('Compliance budget');
  assert.match(await budget.textContent(), /129\.3 µm along \(−0\.304, 0\.636, 0\.709\)/);
  await page.getByLabel('Direction of the budget').selectOption('along z');
  assert.match(await budget.textContent(), /91\.69 µm along z/);
  await page.getByLabel('Direction of the budget').selectOption('along rx');
  assert.match(await budget.textContent(), /486\.4 µrad about x/);
  quiet();
  await close();
});

test('a pointer over a part says its name', async () => {
  const { page, quiet, close } = await opened(livePage('examples/delta.ron'));
  await page.getByRole('button', { name: 'Names' }).click();
  await frame(page);
  const joint = page.locator('.scene-label.joint:visible', { hasText: /^A\d$/ }).first();
  const [name, label] = [await joint.textContent(), await joint.boundingBox()];
  await page.mouse.move(label.x + label.width / 2, label.y + label.height / 2);
  await page.locator('.tip', { hasText: name }).waitFor();
  assert.match(await page.locator('.tip').textContent(), /Revolute, ground – arm\d.*held v/s);
  quiet();
  await close();
});

test('modes move', async () => {
  const { page, quiet, close } = await opened(livePage('examples/delta.ron'));
  await page.getByRole('tab', { name: 'Modes' }).click();
  await page.locator('.mode').first().waitFor();
  assert.match(await page.locator('.mode').first().textContent(), /53\.829 Hz/);
  await page.locator('.mode').first().click();
  const seen = new Set();
  for (let k = 0; k < 20 && seen.size < 4; k++) {
    seen.add(await picture(page));
  }
  assert.equal(seen.size, 4);
  await page.getByRole('tab', { name: 'Answer' }).click();
  const still = await picture(page);
  await page.waitForTimeout(200);
  assert.equal(await picture(page), still);
  quiet();
  await close();
});

test('a map of 10 000 poses takes less than a second, and holds up nothing', async () => {
  const files = { 'trajectory.csv': text('examples/trajectory.csv') };
  const { page, quiet, close } = await opened(livePage('examples/paper.ron', { job: 'delta-rigid-trajectory', pose: 0, files }));
  await page.getByRole('tab', { name: 'Map' }).click();
  await page.waitForFunction(() => performance.getEntriesByName('hyperstat map').length > 0);
  const map = async (count) => {
    await page.evaluate(() => performance.clearMeasures());
    await page.getByLabel('Resolution').selectOption(String(count));
    const held = await page.evaluate(async () => {
      let [most, last] = [0, performance.now()];
      while (performance.getEntriesByName('hyperstat map').length === 0) {
        await new Promise((done) => setTimeout(done));
        const now = performance.now();
        [most, last] = [Math.max(most, now - last), now];
      }
      return most;
    });
    const [took, poses] = await page.evaluate(() => performance.getEntriesByName('hyperstat map').map(({ duration, detail }) => [duration, detail.poses])[0]);
    console.log(`map: ${poses} poses in ${took.toFixed(0)} ms, the page held up for ${held.toFixed(0)} ms at most`);
    assert.equal(poses, count * count);
    return took;
  };
  // What else the machine does is no work of the page: the best of three counts.
  let took = await map(101);
  for (let run = 0; run < 2 && took >= 1000; run++) {
    await map(21);
    took = Math.min(took, await map(101));
  }
  assert.ok(took < 1000, `${took} ms`);
  // A click brings the output there.
  const canvas = page.locator('.map canvas');
  const box = await canvas.boundingBox();
  await page.mouse.click(box.x + box.width * 0.5, box.y + box.height * 0.5);
  await page.waitForTimeout(100);
  const own = await page.evaluate(() => window.hyperstat.solve());
  const [from, to] = await page.locator('.move .slider input[type=range]').first().evaluate((bar) => [Number(bar.min), Number(bar.max)]);
  assert.ok(Math.abs(own.output.position[0] - (from + to) / 2) < 0.02 * (to - from), String(own.output.position));
  // Another value, another map. (A pointer over the map would have its value told.)
  await page.mouse.move(600, 400);
  await page.locator('.map .told', { hasText: 'poses reached' }).waitFor();
  const before = await page.locator('.map .told').textContent();
  await page.getByRole('tab', { name: 'Values' }).click();
  await page.getByLabel('Find a value by its path').fill('arm.section.diameter');
  await page.locator('.value-list .field').first().fill('0.04');
  await page.locator('.value-list .field').first().press('Enter');
  await page.waitForFunction((words) => {
    const now = document.querySelector('.map .told').textContent;
    return now !== words && /poses reached;/.test(now) && document.querySelector('.map progress').hidden;
  }, before);
  quiet();
  await close();
});

test('poses of a job play, with curves', async () => {
  const files = { 'trajectory.csv': text('examples/trajectory.csv') };
  const { page, quiet, close } = await opened(livePage('examples/paper.ron', { job: 'delta-rigid-trajectory', pose: 0, files }));
  await page.getByRole('tab', { name: 'Poses' }).click();
  await page.locator('.uplot').waitFor();
  const before = await page.evaluate(() => window.hyperstat.solve());
  await page.getByLabel('Pose of the job').fill('30');
  const after = await page.evaluate(() => window.hyperstat.solve());
  assert.notDeepEqual(after.output.position, before.output.position);
  await page.getByRole('button', { name: '▶ Play' }).click();
  for (let k = 0; k < 3; k++) {
    const now = await page.locator('.path output').textContent();
    await page.waitForFunction((words) => document.querySelector('.path output').textContent !== words, now);
  }
  quiet();
  await close();
});

test('the scene follows the text, and mistakes are underlined where they are', async () => {
  const { page, quiet, close } = await opened(livePage('examples/portal.ron'));
  await page.getByRole('tab', { name: 'Text' }).click();
  const before = await key(page, 'deflection');
  const write = async (words) => {
    await page.locator('.cm-content').click();
    await page.keyboard.press('Control+a');
    await page.keyboard.insertText(words);
    await page.waitForTimeout(350);
  };
  const own = text('examples/portal.ron');
  await write(own.replace('diameter: 0.014', 'diameter: 0.02'));
  const thicker = await key(page, 'deflection');
  assert.ok(thicker < before);
  await write(own.replace('young:', 'youg:'));
  await page.locator('.cm-lintRange-error').waitFor();
  assert.equal(await page.locator('.cm-lintRange-error').first().textContent(), 'youg');
  assert.match(await page.locator('.problem').textContent(), /line 8: .*youg/);
  await page.locator('.cm-lintRange-error').first().hover();
  await page.locator('.cm-tooltip', { hasText: 'young' }).waitFor();
  assert.equal(await key(page, 'deflection'), thicker);
  await write(own);
  assert.equal(await page.locator('.cm-lintRange-error').count(), 0);
  assert.equal(await page.locator('.problem').isVisible(), false);
  assert.equal(await key(page, 'deflection'), before);
  quiet();
  await close();
});

test('the editor completes', async () => {
  const { page, quiet, close } = await opened(livePage('examples/portal.ron'));
  await page.getByRole('tab', { name: 'Text' }).click();
  await page.locator('.cm-content').click();
  await page.keyboard.press('Control+a');
  await page.keyboard.insertText('(sections: {"rod": ');
  await page.keyboard.type('Rec');
  await page.locator('.cm-tooltip-autocomplete', { hasText: 'Rectangle' }).waitFor();
  await page.waitForTimeout(120);
  await page.keyboard.press('Enter');
  assert.match(await page.locator('.cm-content').textContent(), /Rectangle\(/);
  quiet();
  await close();
});
