// What all tests of the page need: pages, a browser without a network, and eyes for what a person sees.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { after } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { build } from 'esbuild';
import { chromium } from 'playwright-core';

export const root = fileURLToPath(new URL('../../', import.meta.url));
const web = join(root, 'web');
/** The program to compare with; a page of the program without the core is tested with it, too. */
export const program = process.env.HYPERSTAT ?? join(root, 'target/release/hyperstat');
const folder = mkdtempSync(join(tmpdir(), 'hyperstat-page-'));
after(() => rmSync(folder, { recursive: true, force: true }));

/** Text of a file of the repository. */
export function text(path) {
  return readFileSync(join(root, path), 'utf8');
}

/** A page with the live core that shows a file; `files` beside it by their names. */
export function livePage(path, { job, pose, files = {} } = {}) {
  const main = basename(path);
  const load = { ask: 'load', files: { [main]: text(path), ...files }, main, job, pose };
  const data = { version: 'test', title: main, load, poses: [], maps: [], answers: [], live: '' };
  const core = readFileSync(join(web, 'dist/core.wasm.gz')).toString('base64');
  return written(data, core);
}

function written(data, core) {
  const template = readFileSync(join(web, 'dist/page.html'), 'utf8');
  const json = JSON.stringify(data).replaceAll('<', '\\u003c');
  const made = template.replace('/*HYPERSTAT-DATA*/', () => json).replace('/*HYPERSTAT-CORE*/', () => core);
  const page = join(folder, `${Math.random().toString(36).slice(2)}.html`);
  writeFileSync(page, made);
  return page;
}

/** The template as it was built, with the core alone: the playground. */
export function playground() {
  const template = readFileSync(join(web, 'dist/page.html'), 'utf8');
  const core = readFileSync(join(web, 'dist/core.wasm.gz')).toString('base64');
  const page = join(folder, 'playground.html');
  writeFileSync(page, template.replace('/*HYPERSTAT-DATA*/', '').replace('/*HYPERSTAT-CORE*/', () => core));
  return page;
}

/** The page that the program itself writes. */
export function viewed(path, ...options) {
  const page = join(folder, `${Math.random().toString(36).slice(2)}.html`);
  execFileSync(program, ['view', join(root, path), '--out', page, ...options]);
  return page;
}

/** What the program says of a file, as JSON. */
export function solved(path, ...options) {
  return JSON.parse(execFileSync(program, ['solve', join(root, path), '--format', 'json', ...options], { maxBuffer: 1 << 28 }));
}

const flags = [
  '--no-sandbox',
  '--disable-gpu',
  '--enable-unsafe-swiftshader',
  '--no-first-run',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
];

let browser = null;
after(() => browser?.close());

/** Opens a page in a window of its own, without a network. It must make no request and say no error. */
export async function opened(path, options = {}) {
  const executablePath = process.env.CHROMIUM ?? ['/usr/bin/chromium', '/usr/bin/chromium-browser'].find(existsSync);
  browser ??= await chromium.launch({ executablePath, args: flags });
  const { hash = '', ...context } = options;
  const window = await browser.newContext({ viewport: { width: 1280, height: 720 }, offline: true, ...context });
  const page = await window.newPage();
  const seen = [];
  page.on('console', (message) => message.type() === 'error' && seen.push(`console: ${message.text()}`));
  page.on('pageerror', (error) => seen.push(`error: ${error.message}`));
  page.on('request', (request) => /^(?:file|data|blob):/.test(request.url()) || seen.push(`request: ${request.url()}`));
  const address = pathToFileURL(path).href;
  let files = 0;
  page.on('request', (request) => request.url().startsWith('file:') && (files += 1));
  await page.goto(address + hash);
  await page.evaluate(() => window.hyperstat.ready);
  return {
    page,
    /** Nothing was asked of a network or a disk, and nothing failed. */
    quiet: () => {
      assert.deepEqual(seen, []);
      assert.equal(files, 1);
    },
    close: () => window.close(),
  };
}

/** A number with its unit as the page tells it: `129.3 µm` is 1.293e-4. */
export function told(words) {
  const found = /^([−-]?[\d.]+(?:e-?\d+)?)\s*([GMkmµn]?)(?:m|N|Pa|Hz|rad)/.exec(words.trim());
  assert.ok(found, `no number in ${words}`);
  const scale = { G: 1e9, M: 1e6, k: 1e3, '': 1, m: 1e-3, µ: 1e-6, n: 1e-9 };
  // `m` alone is the metre, no prefix.
  const bare = /^[−-]?[\d.]+(?:e-?\d+)?\s*m(?:\/|$)/.test(words.trim());
  return Number(found[1].replace('−', '-')) * (bare ? 1 : scale[found[2]]);
}

export async function key(page, id) {
  return told(await page.locator(`#key-${id}`).textContent());
}

/** Where the ring of the output is on the screen. */
export async function ring(page) {
  return page.evaluate(() => window.hyperstat.output());
}

/** The largest difference of two stiffnesses, beside their diagonals. */
export function difference(a, b) {
  let most = 0;
  for (let r = 0; r < 6; r++) {
    for (let c = 0; c < 6; c++) {
      most = Math.max(most, Math.abs(a[r][c] - b[r][c]) / Math.sqrt(Math.abs(b[r][r] * b[c][c])));
    }
  }
  return most;
}

/** A module of the page's sources, to be tested without a browser. */
export async function source(path) {
  const made = await build({ entryPoints: [join(web, 'src', path)], bundle: true, format: 'esm', write: false, logLevel: 'silent' });
  return import(`data:text/javascript;base64,${Buffer.from(made.outputFiles[0].text).toString('base64')}`);
}
