// Sliders for any value of the file, by its path.

import type { App } from '../app';
import type { Value } from '../core';
import { fill, h } from '../dom';
import { numbers } from '../editor/outline';
import { slider } from './move';

/** Rows that are shown at once; the filter finds the others. */
const MOST = 40;

export class ValuesPanel {
  readonly element = h('div', { class: 'values' });
  readonly #app: App;
  readonly #filter = h('input', { type: 'search', placeholder: 'Path, such as rod.diameter', 'aria-label': 'Find a value by its path' });
  readonly #list = h('div', { class: 'value-list' });
  readonly #reset = h('button', { type: 'button', hidden: true }, 'Take all back');
  #due: [string, number] | null = null;

  constructor(app: App) {
    this.#app = app;
    this.#filter.addEventListener('input', () => this.#show());
    this.#reset.addEventListener('click', () => {
      for (const path of [...app.changed.keys()]) {
        app.set(path, null);
      }
      this.#show();
    });
    fill(this.element, this.#filter, this.#list, this.#reset);
    app.on('loaded', () => this.#show());
    app.on('values', () => {
      this.#reset.hidden = app.changed.size === 0;
    });
  }

  /** Brings a value to the front. */
  find(path: string): void {
    this.#filter.value = path;
    this.#show();
    this.#list.querySelector('input')?.focus();
  }

  #show(): void {
    const wanted = this.#filter.value.trim().toLowerCase();
    const found = [...this.#app.values, ...(wanted === '' ? [] : this.#others())].filter(({ path }) => path.toLowerCase().includes(wanted));
    // Values that were changed stay in sight; exact names come first.
    const rank = ({ path }: Value): number => (this.#app.changed.has(path) ? 0 : path.toLowerCase() === wanted ? 1 : 2);
    const shown = [...found].sort((a, b) => rank(a) - rank(b)).slice(0, MOST);
    const groups = Map.groupBy(shown, ({ group }) => group);
    const live = this.#app.core.live;
    fill(
      this.#list,
      ...[...groups].flatMap(([group, values]) => [h('h3', {}, TITLES[group] ?? group), ...values.map((value) => this.#row(value, live))]),
      found.length === 0 ? h('p', { class: 'empty' }, this.#app.values.length === 0 ? 'No values.' : 'No value has that in its path.') : null,
      found.length > MOST ? h('p', { class: 'note' }, `${found.length - MOST} more: write a part of the path.`) : null,
    );
    this.#reset.hidden = this.#app.changed.size === 0;
  }

  /** Numbers of the text that the core does not list, such as those of loads: they can be set by their paths, too. */
  #others(): Value[] {
    const { loaded, text, values } = this.#app;
    const job = loaded?.jobs.findIndex(({ name }) => name === loaded.job) ?? -1;
    const known = new Set(values.map(({ path }) => path));
    return numbers(text).flatMap(({ path, value }) => {
      const own = job < 0 ? path : (/^jobs\.(\d+)\.(?:mechanism\.)?((?!poses|figures|vary|zip).*)$/.exec(path) ?? []);
      const short = typeof own === 'string' ? own : Number(own[1]) === job ? own[2] : undefined;
      return short === undefined || known.has(short) ? [] : [{ path: short, value, unit: '', group: 'text', parts: [] }];
    });
  }

  #row(value: Value, live: boolean): HTMLElement {
    const now = this.#app.changed.get(value.path) ?? value.value;
    const around = value.value === 0 ? (value.unit === 'rad' ? 1 : 0.5 * (this.#app.loaded?.size ?? 1)) : Math.abs(value.value);
    const [from, to] = value.value === 0 || value.group === 'placing' ? [value.value - 0.5 * around, value.value + 0.5 * around] : [value.value - 0.6 * around, value.value + around];
    const made = slider(value.path, { from: Math.min(from, now), to: Math.max(to, now), value: now, unit: value.unit }, (next) => {
      back.hidden = false;
      this.#set(value.path, next);
    });
    made.slider.disabled = made.field.disabled = !live;
    const back = h('button', { type: 'button', class: 'back', title: `back to ${value.value}`, 'aria-label': `${value.path} back to ${value.value}` }, '↺');
    back.hidden = !this.#app.changed.has(value.path);
    back.addEventListener('click', () => {
      this.#app.set(value.path, null);
      this.#show();
    });
    made.row.append(back);
    made.row.classList.add('long');
    return made.row;
  }

  /** The latest value of a frame is set, so that a quick slider holds nothing up. */
  #set(path: string, value: number): void {
    const due = this.#due !== null;
    this.#due = [path, value];
    if (!due) {
      requestAnimationFrame(() => {
        const next = this.#due;
        this.#due = null;
        if (next) {
          this.#app.set(...next);
        }
      });
    }
  }
}

const TITLES: Record<string, string> = {
  parameter: 'Parameters',
  section: 'Sections',
  material: 'Materials',
  stiffness: 'Stiffness of joints',
  mass: 'Masses',
  placing: 'Lengths and places',
  text: 'Other numbers of the text',
};
