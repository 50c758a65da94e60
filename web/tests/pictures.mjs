// Pictures of the page for the README and the book, and of more mechanisms to look at:
//
//     node tests/pictures.mjs FOLDER

import { join } from 'node:path';
import { livePage, opened, ring, text } from './support.mjs';

const folder = process.argv[2] ?? '.';
const wait = (page, ms = 700) => page.waitForTimeout(ms);
const colours = (page, name) => page.getByLabel('Colours', { exact: true }).selectOption(name);
const tab = (page, name) => page.getByRole('tab', { name }).click();

const PICTURES = [
  {
    name: 'view-delta',
    page: () => livePage('examples/paper.ron', { job: 'delta-elastic-trajectory', pose: 20, files: { 'trajectory.csv': text('examples/trajectory.csv') } }),
    act: async (page) => {
      await colours(page, 'displacement');
      const { x, y } = await ring(page);
      await page.mouse.move(x, y);
      await page.mouse.down();
      await page.mouse.move(x + 20, y + 30, { steps: 5 });
      await page.mouse.up();
      await page.mouse.move(400, 300);
    },
  },
  {
    name: 'view-hexapod',
    page: () => livePage('examples/hexapod.ron'),
    act: async (page) => {
      await colours(page, 'share');
      await page.getByRole('button', { name: 'joint M5', exact: true }).click();
    },
  },
  {
    name: 'view-map',
    page: () => livePage('examples/prebuilt.ron', { job: 'linear-delta', pose: 0 }),
    act: async (page) => {
      await tab(page, 'Map');
      for (const [name, value] of [['x from', '-0.3'], ['x to', '0.3'], ['y from', '-0.3'], ['y to', '0.3']]) {
        await page.getByLabel(name, { exact: true }).fill(value);
        await page.keyboard.press('Enter');
      }
      await page.getByLabel('Resolution').selectOption('101');
      await page.waitForFunction(() => document.querySelector('.map progress').hidden);
    },
  },
  {
    name: 'view-modes',
    options: { colorScheme: 'dark' },
    page: () => livePage('examples/three_prs.ron'),
    act: async (page) => {
      await colours(page, 'displacement');
      await tab(page, 'Modes');
      await page.locator('.mode').first().click();
    },
  },
  { name: 'view-tricept', page: () => livePage('examples/tricept.ron'), act: (page) => colours(page, 'stress') },
  {
    name: 'view-text',
    page: () => livePage('examples/gripper.ron'),
    act: async (page) => {
      await tab(page, 'Text');
      await wait(page);
      await page.getByRole('button', { name: 'All in view' }).click();
    },
  },
  { name: 'view-head', page: () => livePage('examples/head.ron'), act: (page) => colours(page, 'displacement') },
  { name: 'view-planar', page: () => livePage('examples/planar_three_rrr.ron'), act: (page) => page.getByRole('button', { name: 'Names' }).click() },
  { name: 'view-tablet', options: { viewport: { width: 820, height: 1180 }, hasTouch: true }, page: () => livePage('examples/orthoglide.ron'), act: (page) => colours(page, 'stress') },
];

for (const { name, options, page: made, act } of PICTURES) {
  const { page, quiet, close } = await opened(made(), options);
  await wait(page, 500);
  await act(page);
  // No field keeps its frame.
  await page.evaluate(() => document.activeElement?.blur());
  await wait(page);
  await page.screenshot({ path: join(folder, `${name}.png`) });
  quiet();
  await close();
  console.log(name);
}
process.exit(0);
