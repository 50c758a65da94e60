// Coordinates and drives by sliders.

import type { App } from '../app';
import type { Movable, Pose } from '../core';
import { fill, h } from '../dom';
import { number } from '../format';
import type { Stage } from '../scene/stage';

interface Row {
  movable: Movable;
  slider: HTMLInputElement;
  field: HTMLInputElement;
}

/** A slider with a field for the number beside it. */
export function slider(
  label: string,
  range: { from: number; to: number; value: number; unit: string },
  changed: (value: number, done: boolean) => void,
): { row: HTMLElement; slider: HTMLInputElement; field: HTMLInputElement } {
  const step = (range.to - range.from) / 1000 || 1e-6;
  const bar = h('input', { type: 'range', min: range.from, max: range.to, step, value: range.value, 'aria-label': label, 'aria-valuetext': `${number(range.value, 4)} ${range.unit}` });
  const field = h('input', { type: 'text', inputmode: 'decimal', class: 'field', 'aria-label': `${label} [${range.unit}]`, value: number(range.value, 5) });
  bar.addEventListener('input', () => {
    field.value = number(bar.valueAsNumber, 5);
    bar.setAttribute('aria-valuetext', `${field.value} ${range.unit}`);
    changed(bar.valueAsNumber, false);
  });
  bar.addEventListener('change', () => changed(bar.valueAsNumber, true));
  field.addEventListener('change', () => {
    const value = Number(field.value.replace(',', '.').replace('−', '-'));
    field.setAttribute('aria-invalid', String(!Number.isFinite(value)));
    if (Number.isFinite(value)) {
      bar.value = String(value);
      changed(value, true);
    }
  });
  const row = h('div', { class: label.length > 4 ? 'slider named' : 'slider' }, h('span', { class: 'slider-name', title: label }, label), bar, field, h('span', { class: 'unit' }, range.unit));
  return { row, slider: bar, field };
}

export class MovePanel {
  readonly element = h('div', { class: 'move' });
  readonly #app: App;
  readonly #stage: Stage;
  readonly #coordinates: Row[] = [];
  readonly #drives: Row[] = [];
  #drivesDue: Record<string, number> | null = null;

  constructor(app: App, stage: Stage) {
    this.#app = app;
    this.#stage = stage;
    app.on('loaded', () => this.#make());
    app.on('frame', () => this.#follow());
  }

  #make(): void {
    const { loaded, core } = this.#app;
    const live = core.live;
    const make = (movable: Movable, into: Row[], able: boolean, changed: (value: number) => void): HTMLElement => {
      const made = slider(movable.name, { ...movable }, changed);
      made.slider.disabled = made.field.disabled = !able;
      into.push({ movable, slider: made.slider, field: made.field });
      return made.row;
    };
    this.#coordinates.length = this.#drives.length = 0;
    const coordinates = (loaded?.coordinates ?? []).map((movable) =>
      make(movable, this.#coordinates, this.#app.moves, (value) => this.#stage.drag.ask({ [movable.name]: value })),
    );
    const drives = (loaded?.drives ?? []).map((movable) => make(movable, this.#drives, live, (value) => this.#drive(movable.name, value)));
    fill(
      this.element,
      live ? null : h('p', { class: 'recorded', role: 'note' }, ...coded(this.#app.data?.live ?? '')),
      coordinates.length + drives.length === 0 ? h('p', { class: 'empty' }, 'A structure: nothing of it moves.') : null,
      coordinates.length > 0 ? h('h3', {}, 'Output') : null,
      ...coordinates,
      drives.length > 0 ? h('h3', {}, 'Drives ', h('span', { class: 'unit' }, 'from the configuration of the file')) : null,
      ...drives,
      live || this.#app.moves
        ? h('button', { type: 'button', onclick: () => this.#app.go(undefined) }, 'Back to the pose of the file')
        : null,
      this.#app.moves ? h('p', { class: 'note' }, live ? '' : 'It moves among the poses that were worked out. ', 'Or drag the ring in the scene; with Shift it turns. Keys: Alt and arrows, Page Up and Down.') : null,
    );
  }

  #drive(name: string, value: number): void {
    const due = this.#drivesDue !== null;
    const now = Object.fromEntries(this.#drives.map(({ movable, slider: bar }) => [movable.name, bar.valueAsNumber]));
    this.#drivesDue = { ...now, [name]: value };
    if (!due) {
      requestAnimationFrame(() => {
        const drives = this.#drivesDue ?? {};
        this.#drivesDue = null;
        this.#app.go({ drives } satisfies Pose);
        this.#stage.drag.onstep();
      });
    }
  }

  /** Brings the sliders to the pose that is shown; one that is being moved is left alone. */
  #follow(): void {
    const frame = this.#app.frame;
    const pose = frame?.pose;
    if (pose) {
      for (const row of this.#coordinates) {
        put(row, pose[['x', 'y', 'z', 'rx', 'ry', 'rz'].indexOf(row.movable.name)]);
      }
    }
    for (const row of this.#drives) {
      put(row, frame?.drives?.[row.movable.name]);
    }
  }
}

/** Words with what stands in backquotes as code. */
function coded(words: string): (Node | string)[] {
  return words.split('`').map((part, k) => (k % 2 === 1 ? h('code', {}, part) : part));
}

function put(row: Row, value: number | undefined): void {
  if (value !== undefined && Number.isFinite(value) && document.activeElement !== row.slider && document.activeElement !== row.field) {
    // Poses beyond the range that the job has are poses, too.
    row.slider.min = String(Math.min(Number(row.slider.min), value));
    row.slider.max = String(Math.max(Number(row.slider.max), value));
    row.slider.value = String(value);
    row.field.value = number(value, 5);
  }
}
