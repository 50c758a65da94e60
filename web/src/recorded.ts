// The core of a page without the live one: answers that were worked out beforehand, found by their request.

import type { Answer, Answers, Core, Request } from './core';
import type { Data } from './data';
import { unBase64 } from './share';
import { Refused } from './wasm';

/** Answers what stands in the data, and refuses all else with the code `not-live`. */
export function recorded(data: Data): Core {
  const found = new Map(data.answers.map((each) => [key(each.request), each] as const));
  return {
    live: false,
    ask<R extends Request>(request: R): Answer<Answers[R['ask']]> {
      const own = found.get(key(request));
      if (!own) {
        const message = 'this page holds what was worked out beforehand, and this is not among it';
        throw new Refused({ code: 'not-live', message, help: data.live, path: null, line: null, column: null, length: null });
      }
      return { value: own.value as Answers[R['ask']], numbers: own.numbers ? doubles(own.numbers) : new Float64Array() };
    },
  };
}

/** A request as text: fields that are undefined are left out, the others are in order. */
export function key(request: object): string {
  return JSON.stringify(request, (_, value: unknown) =>
    value && typeof value === 'object' && !Array.isArray(value)
      ? Object.fromEntries(Object.entries(value).sort(([a], [b]) => (a < b ? -1 : 1)))
      : value,
  );
}

function doubles(packed: string): Float64Array {
  return Float64Array.from(new Float32Array(unBase64(packed).buffer));
}
