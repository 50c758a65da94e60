// Natural modes: their frequencies, and one of them moving in the scene.

import type { App } from '../app';
import { Dropped } from '../background';
import type { Modes } from '../core';
import { fill, h } from '../dom';
import { percent, withPrefix } from '../format';
import type { Stage } from '../scene/stage';
import { Refused } from '../wasm';

export class ModesPanel {
  readonly element = h('div', { class: 'modes' });
  readonly #app: App;
  readonly #stage: Stage;
  readonly #count = h('input', { type: 'number', min: 1, max: 40, value: 6, class: 'field', 'aria-label': 'How many modes' });
  readonly #list = h('div', { class: 'mode-list', role: 'list' });
  readonly #amplitude = h('input', { type: 'range', min: 0.01, max: 0.3, step: 0.01, value: 0.1, 'aria-label': 'Amplitude' });
  readonly #about = h('div', {});
  #answer: { value: Modes; numbers: Float64Array } | null = null;
  #playing: number | null = null;
  #visible = false;
  #stale = true;

  constructor(app: App, stage: Stage) {
    this.#app = app;
    this.#stage = stage;
    this.#count.addEventListener('change', () => void this.#ask());
    this.#amplitude.addEventListener('input', () => this.#play(this.#playing));
    fill(
      this.element,
      h('div', { class: 'line' }, h('label', {}, 'Modes ', this.#count), h('label', {}, 'amplitude ', this.#amplitude)),
      this.#list,
      this.#about,
    );
    app.on('scene', () => {
      this.#playing = null;
      this.#stale = true;
    });
    app.on('answer', (answer) => {
      this.#stale = this.#stale || answer === null;
      if (answer && this.#visible && this.#stale) {
        void this.#ask();
      }
    });
  }

  /** The tab came to the front, or went. */
  show(visible: boolean): void {
    this.#visible = visible;
    if (!visible) {
      this.#play(null);
    } else if (this.#stale) {
      void this.#ask();
    }
  }

  async #ask(): Promise<void> {
    const count = this.#app.core.live ? Math.round(Math.min(Math.max(this.#count.valueAsNumber || 6, 1), 40)) : this.#recorded();
    const pose = this.#app.pose;
    try {
      this.#answer = await this.#app.background.ask(this.#app.setup, { ask: 'modes', ...(pose ? { pose } : {}), count }, 'modes', 4);
      this.#stale = false;
      this.#show();
      this.#play(this.#playing);
    } catch (error) {
      if (error instanceof Refused) {
        this.#stage.move(null);
        fill(this.#list, h('p', { class: 'empty' }, error.problem.message), error.problem.help ? h('p', { class: 'note' }, error.problem.help) : null);
        fill(this.#about);
      } else if (!(error instanceof Dropped)) {
        throw error;
      }
    }
  }

  /** How many modes the page has. */
  #recorded(): number {
    const found = this.#app.data?.answers.find(({ request }) => request.ask === 'modes')?.request;
    return found?.ask === 'modes' ? found.count : 6;
  }

  #show(): void {
    const modes = this.#answer?.value.modes ?? [];
    const remarks = this.#answer?.value.remarks ?? [];
    fill(
      this.#list,
      ...modes.map((mode, k) =>
        h(
          'button',
          { type: 'button', class: 'mode', role: 'listitem', 'aria-pressed': String(k === this.#playing), onclick: () => this.#play(k === this.#playing ? null : k) },
          h('span', { class: 'mode-number' }, `${k + 1}`),
          h('b', {}, withPrefix(mode.frequency, 'Hz', 5)),
          h('span', { class: 'note' }, masses(mode.effective_mass, this.#answer?.value.mass ?? 0)),
        ),
      ),
      modes.length === 0 ? h('p', { class: 'empty' }, 'No modes.') : null,
      ...remarks.map((remark) => h('p', { class: 'note' }, remark)),
    );
  }

  #play(which: number | null): void {
    this.#playing = which;
    const mode = which === null ? undefined : this.#answer?.value.modes[which];
    [...this.#list.querySelectorAll('.mode')].forEach((button, k) => button.setAttribute('aria-pressed', String(k === which)));
    if (!mode || !this.#answer) {
      this.#playing = null;
      if (this.#stage.isMoving) {
        this.#stage.move(null);
      }
      fill(this.#about);
      return;
    }
    const [offset, length] = mode.shape;
    this.#stage.move({ shape: this.#answer.numbers.subarray(offset, offset + length), amplitude: this.#amplitude.valueAsNumber });
    const energies = Object.entries(mode.kinetic_energy).filter(([, share]) => share > 5e-4).sort(([, a], [, b]) => b - a).slice(0, 8);
    fill(
      this.#about,
      h('h4', {}, 'Kinetic energy'),
      ...energies.map(([name, share]) =>
        h(
          'div',
          { class: 'budget-row' },
          h('span', { class: 'name' }, name),
          h('span', { class: 'track' }, h('span', { class: 'bar', style: `transform: scaleX(${share})` })),
          h('span', { class: 'share' }, percent(share)),
        ),
      ),
    );
  }
}

function masses(effective: readonly number[], whole: number): string {
  const told = effective.map((mass, k) => [mass, 'xyz'[k]] as const).filter(([mass]) => mass > 0.01 * whole);
  return told.map(([mass, axis]) => `${axis} ${percent(mass / (whole || 1), 0)}`).join('  ') || 'no effective mass';
}
