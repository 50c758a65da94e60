// The editor with its bar: what is wrong, even lines, and values of sliders written into the text.

import type { App } from '../app';
import type { Problem } from '../core';
import { h, say } from '../dom';
import type { Schema } from './complete';
import { Editor, type Marked } from './editor';
import { numbers } from './outline';
import { Refused } from '../wasm';

export class EditorPane {
  readonly element = h('div', { class: 'editor' });
  readonly editor: Editor;
  readonly #app: App;
  readonly #told = h('output', { class: 'told', 'aria-live': 'polite' });
  readonly #write = h('button', { type: 'button', hidden: true, title: 'Put the values of the sliders into the text' }, 'Write values');
  #typed = 0;

  constructor(app: App) {
    this.#app = app;
    const live = app.core.live;
    const tidy = h('button', { type: 'button', title: 'Put lines in order', onclick: () => this.#tidy() }, 'Tidy');
    this.element.append(h('div', { class: 'editor-bar' }, this.#told, this.#write, live ? tidy : null));
    this.editor = new Editor(this.element, '', live ? this.#schema() : null, (text) => {
      clearTimeout(this.#typed);
      this.#typed = window.setTimeout(() => app.load(text, { keep: true }), 220);
    });
    this.#write.addEventListener('click', () => this.#put());
    app.on('loaded', () => {
      this.editor.text = app.text;
      if (!live) {
        this.editor.freeze();
      }
      this.#offer();
    });
    app.on('values', () => this.#offer());
    app.on('problem', (problem) => this.#mark(problem));
  }

  #schema(): Schema | null {
    try {
      return this.#app.core.ask({ ask: 'schema' }).value as Schema;
    } catch {
      return null;
    }
  }

  /** Underlines where the text is wrong. */
  #mark(problem: Problem | null): void {
    const own = problem?.line && (problem.path === null || problem.path === this.#app.main) ? problem : null;
    const marks: Marked[] = own
      ? [
          {
            line: own.line ?? 1,
            column: own.column ?? 1,
            ...(own.length ? { length: own.length } : {}),
            severity: 'error',
            message: own.help ? `${own.message}\n${own.help}` : own.message,
          },
        ]
      : [];
    this.editor.mark(marks);
    this.#told.classList.toggle('bad', problem !== null);
    say(this.#told, problem ? `${own ? `line ${own.line}: ` : ''}${problem.message}` : this.#app.core.live ? 'no mistakes' : 'to read only');
    this.#told.title = problem?.help ?? '';
  }

  #tidy(): void {
    try {
      this.editor.replace(this.#app.core.ask({ ask: 'format', text: this.editor.text, name: this.#app.main }).value.text);
    } catch (error) {
      if (!(error instanceof Refused)) {
        throw error;
      }
      this.#mark(error.problem);
    }
  }

  #offer(): void {
    this.#write.hidden = this.#app.changed.size === 0;
  }

  /** Places of the text that hold the values that were changed. */
  #put(): void {
    const { changed, loaded } = this.#app;
    const job = loaded?.jobs.findIndex(({ name }) => name === loaded.job) ?? -1;
    const before = job >= 0 ? [`jobs.${job}.mechanism.`, `jobs.${job}.`, ''] : [''];
    const leaves = numbers(this.editor.text);
    const found = [...changed].flatMap(([path, value]) => {
      const leaf = before.flatMap((start) => leaves.filter((each) => each.path === start + path))[0];
      return leaf ? [{ path, from: leaf.from, to: leaf.to, insert: String(value) }] : [];
    });
    const missing = [...changed.keys()].filter((path) => !found.some((each) => each.path === path));
    this.editor.change(found);
    if (found.length > 0) {
      for (const { path } of found) {
        changed.delete(path);
      }
      this.#app.load(this.editor.text, { keep: true });
    }
    if (missing.length > 0) {
      say(this.#told, `not a plain number in the text: ${missing.join(', ')}`);
    }
    this.#offer();
  }
}
