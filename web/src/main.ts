// The page begins: reads what stands in it, opens the core, shows the first mechanism.

import { App } from './app';
import type { Core } from './core';
import { pageCore, pageData } from './data';
import { Layout } from './layout';
import { recorded } from './recorded';
import { fromHash } from './share';
import { open } from './wasm';

declare global {
  interface Window {
    hyperstat: {
      /** Fulfilled when the first mechanism is shown. */
      ready: Promise<void>;
      /** The object of `hyperstat solve --format json` for the job and pose shown, of another text where one is given. */
      solve(text?: string): Promise<object>;
      /** Where the output is shown, from the corner of the window [CSS pixels]. */
      output(): Promise<{ x: number; y: number } | null>;
    };
  }
}

async function begin(): Promise<{ app: App; layout: Layout }> {
  const data = pageData();
  const module = await pageCore();
  const none = { version: '', title: '', load: { ask: 'load', files: {}, main: '' } as const, poses: [], maps: [], answers: [], live: '' };
  const core: Core = module ? await open(module) : recorded(data ?? none);
  const app = new App(core, module, data);
  const layout = new Layout(app);
  document.getElementById('app')?.replaceWith(layout.element);
  const shared = core.live ? await fromHash(location.hash) : null;
  if (shared) {
    layout.open(shared.text, {
      main: 'shared.ron',
      files: shared.files ?? {}, ...(shared.job === undefined ? {} : { job: shared.job }), ...(shared.pose === undefined ? {} : { pose: shared.pose }),
    });
  } else if (data) {
    const { files, main, job, pose } = data.load;
    layout.open(files[main] ?? '', { main, files, ...(job === undefined ? {} : { job }), ...(pose === undefined ? {} : { pose }) });
  } else if (core.live) {
    layout.begin();
  }
  return { app, layout };
}

const begun = begin();
begun.catch((error: unknown) => {
  const words = error instanceof Error ? error.message : String(error);
  const place = document.getElementById('app');
  if (place) {
    place.className = 'failed';
    place.textContent = `This page could not begin: ${words}. It needs a browser with WebGL 2 and WebAssembly.`;
  }
});
window.hyperstat = {
  ready: begun.then(() => undefined),
  solve: async (text) => (await begun).app.solve(text),
  output: async () => (await begun).layout.output(),
};
