// Requests that wait their turn beside the drag: those of higher rank first, the rest in order.

import type { Answer, Answers, Core, Request } from './core';
import { Refused } from './wasm';
import type { Message, Reply, Setup } from './worker';

/** The text of the worker's program, which the build puts here. */
declare const WORKER: string;

interface Waiting {
  message: Extract<Message, { id: number }>;
  rank: number;
  /** A later request of the same topic takes the place of one that waits. */
  topic: string;
  done(answer: Timed<unknown>): void;
  failed(error: Error): void;
}

/** An answer, and how long the core took [ms]. */
export type Timed<T> = Answer<T> & { took: number };

/** A request was no longer wanted. */
export class Dropped extends Error {}

export class Background {
  readonly #worker: Worker | null;
  readonly #core: Core | null;
  readonly #waiting: Waiting[] = [];
  #running: Waiting | null = null;
  #count = 0;

  /** Asks a core of its own in a worker; without a module, the recorded answers. */
  constructor(module: WebAssembly.Module | null, recorded: Core | null) {
    this.#core = recorded;
    this.#worker = null;
    if (module) {
      const address = URL.createObjectURL(new Blob([WORKER], { type: 'text/javascript' }));
      this.#worker = new Worker(address);
      this.#worker.onmessage = (event: MessageEvent<Reply>) => this.#take(event.data);
      this.#worker.postMessage({ module } satisfies Message);
    }
  }

  /** Asks; what waits with the same topic is dropped, unless the topic is empty. */
  ask<R extends Request>(setup: Setup | null, request: R, topic = '', rank = 0): Promise<Timed<Answers[R['ask']]>> {
    this.drop(topic);
    return new Promise((done, failed) => {
      const message = { id: ++this.#count, setup, request };
      this.#waiting.push({ message, rank, topic, done: done as (answer: Timed<unknown>) => void, failed });
      this.#next();
    });
  }

  /** Drops what waits with a topic. */
  drop(topic: string): void {
    if (topic === '') {
      return;
    }
    for (let k = this.#waiting.length - 1; k >= 0; k--) {
      if (this.#waiting[k]?.topic === topic) {
        this.#waiting.splice(k, 1)[0]?.failed(new Dropped(topic));
      }
    }
  }

  #next(): void {
    if (this.#running || this.#waiting.length === 0) {
      return;
    }
    const best = this.#waiting.reduce((a, b) => (b.rank > a.rank ? b : a));
    this.#waiting.splice(this.#waiting.indexOf(best), 1);
    this.#running = best;
    if (this.#worker) {
      this.#worker.postMessage(best.message);
      return;
    }
    queueMicrotask(() => this.#take(this.#recorded(best.message)));
  }

  #recorded({ id, request }: Extract<Message, { id: number }>): Reply {
    try {
      const answer = this.#core?.ask(request);
      return answer ? { id, ...answer } : { id, failed: 'no core' };
    } catch (error) {
      return error instanceof Refused ? { id, problem: error.problem } : { id, failed: String(error) };
    }
  }

  #take(reply: Reply): void {
    const running = this.#running;
    this.#running = null;
    if (running && reply.id === running.message.id) {
      if (reply.problem) {
        running.failed(new Refused(reply.problem));
      } else if (reply.failed !== undefined) {
        running.failed(new Error(reply.failed));
      } else {
        running.done({ value: reply.value, numbers: reply.numbers ?? new Float64Array(), took: reply.took ?? 0 });
      }
    }
    this.#next();
  }
}
