// The live core: the study compiled to WebAssembly, called as `INTERFACE.md` says.

import type { Answer, Answers, Core, Failed, Problem, Request } from "./core";

/** A request that was refused. */
export class Refused extends Error {
  constructor(readonly problem: Problem) {
    super(problem.message);
    this.name = "Refused";
  }
}

interface Exports {
  memory: WebAssembly.Memory;
  request(length: number): number;
  ask(): void;
  answer(part: number): number;
  answer_length(part: number): number;
}

/** Opens a core of its compiled bytes; each has a memory of its own. */
export async function open(module: WebAssembly.Module | BufferSource): Promise<Core> {
  const compiled = module instanceof WebAssembly.Module ? module : await WebAssembly.compile(module);
  const instance = await WebAssembly.instantiate(compiled, {});
  const core = instance.exports as unknown as Exports;
  const encoder = new TextEncoder();
  const decoder = new TextDecoder();
  const ask = <R extends Request>(request: R): Answer<Answers[R["ask"]]> => {
    const text = encoder.encode(JSON.stringify(request));
    const at = core.request(text.length);
    new Uint8Array(core.memory.buffer, at, text.length).set(text);
    core.ask();
    // The memory may have grown: its buffer is then another one.
    const memory = core.memory.buffer;
    const value = JSON.parse(decoder.decode(new Uint8Array(memory, core.answer(0), core.answer_length(0))));
    const problem = (value as Failed).error;
    if (problem) throw new Refused(problem);
    const numbers = new Float64Array(memory, core.answer(1), core.answer_length(1)).slice();
    return { value, numbers };
  };
  return { live: true, ask };
}
