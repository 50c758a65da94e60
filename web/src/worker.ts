// A core of its own in a worker: maps, sensitivities and trajectories, so that nothing of it holds up a drag.

import type { Core, Request } from './core';
import { open, Refused } from './wasm';

/** What a request is asked of: the file and the values in it. */
export interface Setup {
  load: Extract<Request, { ask: 'load' }>;
  values: [string, number | string][];
}

export type Message = { module: WebAssembly.Module } | { id: number; setup: Setup | null; request: Request };

export interface Reply {
  id: number;
  value?: unknown;
  numbers?: Float64Array;
  /** How long the core took [ms]. */
  took?: number;
  problem?: Refused['problem'];
  failed?: string;
}

const here = self as unknown as { onmessage: (event: MessageEvent<Message>) => void; postMessage(reply: Reply, move: Transferable[]): void };
let module: WebAssembly.Module | null = null;
let core: Promise<Core> | null = null;
let ready = '';

async function answer(message: Extract<Message, { id: number }>): Promise<Reply> {
  const { id, setup, request } = message;
  try {
    core ??= open(module as WebAssembly.Module);
    const opened = await core;
    const wanted = setup ? JSON.stringify(setup) : ready;
    if (setup && wanted !== ready) {
      ready = '';
      opened.ask(setup.load);
      if (setup.values.length > 0) {
        opened.ask({ ask: 'set', values: setup.values });
      }
      ready = wanted;
    }
    const begun = performance.now();
    const { value, numbers } = opened.ask(request);
    return { id, value, numbers, took: performance.now() - begun };
  } catch (error) {
    if (error instanceof Refused) {
      return { id, problem: error.problem };
    }
    // A trap is a bug of the core; the next request gets a new one.
    core = null;
    ready = '';
    return { id, failed: String(error) };
  }
}

let last: Promise<unknown> = Promise.resolve();
here.onmessage = ({ data }) => {
  if ('module' in data) {
    module = data.module;
    return;
  }
  last = last.then(async () => {
    const reply = await answer(data);
    here.postMessage(reply, reply.numbers ? [reply.numbers.buffer] : []);
  });
};
