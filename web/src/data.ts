// What stands in the page: the text, its results, the core.

import type { Pose, Request } from './core';
import { through, unBase64 } from './share';

export interface Data {
  version: string;
  title: string;
  load: Extract<Request, { ask: 'load' }>;
  poses: { label: string; pose: Pose }[];
  maps: Extract<Request, { ask: 'sweep' }>[];
  answers: { request: Request; value: unknown; numbers?: string }[];
  /** How to get the live page. */
  live: string;
}

/** A file of the menu, with those that it names. */
export interface Example {
  name: string;
  text: string;
  files?: Record<string, string>;
}

/** Examples of the repository, which the build puts here. */
declare const EXAMPLES: Example[];
export const examples = EXAMPLES;

function content(id: string): string | null {
  const text = document.getElementById(id)?.textContent?.trim() ?? '';
  // A template that was not filled has a comment in the place.
  return text === '' || text.startsWith('/*') ? null : text;
}

/** The data of the page, or `null` in an empty template. */
export function pageData(): Data | null {
  const text = content('hyperstat-data');
  return text ? (JSON.parse(text) as Data) : null;
}

/** The compiled core, or `null` where the page has none. */
export async function pageCore(): Promise<WebAssembly.Module | null> {
  const packed = content('hyperstat-core');
  if (!packed) {
    return null;
  }
  const bytes = await through(unBase64(packed), new DecompressionStream('gzip'));
  return WebAssembly.compile(bytes);
}
