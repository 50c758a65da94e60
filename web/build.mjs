// Bundles the page into one file without requests: dist/page.html, the template that `hyperstat view` fills.
//
//     npm ci && npm run build

import { mkdir, readdir, readFile, writeFile } from 'node:fs/promises';
import { build } from 'esbuild';

const common = { bundle: true, minify: true, write: false, format: 'iife', target: 'es2022', legalComments: 'inline', metafile: true, logLevel: 'warning' };

/** The examples of the repository, with the files that they name. */
async function examples() {
  const folder = '../examples';
  const names = (await readdir(folder)).filter((name) => name.endsWith('.ron')).sort();
  return Promise.all(
    names.map(async (name) => {
      const text = await readFile(`${folder}/${name}`, 'utf8');
      const named = [...new Set([...text.matchAll(/(?:Csv|File)\("([^"]+)"/g)].map(([, file]) => file))];
      const files = await Promise.all(named.map(async (file) => [file, await readFile(`${folder}/${file}`, 'utf8')]));
      return { name, text, files: Object.fromEntries(files) };
    }),
  );
}

const worker = await build({ ...common, entryPoints: ['src/worker.ts'] });
const page = await build({
  ...common,
  entryPoints: ['src/main.ts'],
  define: { WORKER: JSON.stringify(worker.outputFiles[0].text), EXAMPLES: JSON.stringify(await examples()) },
});
const style = await build({ ...common, entryPoints: ['src/style.css'], metafile: false });

/** Names of the packages that a bundle holds. */
function packages(metafile) {
  const found = Object.keys(metafile.inputs).map((path) => /node_modules\/((?:@[^/]+\/)?[^/]+)/.exec(path)?.[1]);
  return found.filter((name) => name !== undefined);
}

/** The licence of a package, as it ships it. */
async function licence(name) {
  const folder = `node_modules/${name}`;
  const { version, license } = JSON.parse(await readFile(`${folder}/package.json`, 'utf8'));
  const file = (await readdir(folder)).find((each) => /^licen[cs]e/i.test(each));
  if (!file) {
    throw new Error(`${name} has no licence file`);
  }
  return `${name} ${version} (${license})\n\n${(await readFile(`${folder}/${file}`, 'utf8')).trim()}\n`;
}

const names = [...new Set([page, worker].flatMap(({ metafile }) => packages(metafile)))].sort();
const licences = (await Promise.all(names.map(licence))).join(`\n${'-'.repeat(72)}\n\n`);
if (/<\/script/i.test(licences)) {
  throw new Error('a licence would end its element');
}
const parts = { STYLE: style.outputFiles[0].text.trim(), SCRIPT: page.outputFiles[0].text.trim(), LICENCES: licences.trim() };
const template = await readFile('src/page.html', 'utf8');
// Functions, since `$` in a replacement would mean something.
const made = template.replace(/@(STYLE|SCRIPT|LICENCES)@/g, (_, part) => parts[part]);
for (const mark of ['/*HYPERSTAT-DATA*/', '/*HYPERSTAT-CORE*/', '<title>hyperstat</title>']) {
  if (made.split(mark).length !== 2) {
    throw new Error(`${mark} does not stand in the page once`);
  }
}
await mkdir('dist', { recursive: true });
await writeFile('dist/page.html', made);
console.log(`dist/page.html: ${(made.length / 1e6).toFixed(2)} MB, of ${names.length} packages`);
