// Below the scene: how much of the deformation is shown, and what the colours mean.

import { h, say } from './dom';
import type { Colouring } from './scene/mechanism';
import type { Stage } from './scene/stage';

/** The slider's middle is the factor that suits; each end is 30 times that, or none. */
const SPAN = 30;

export class BottomBar {
  readonly element: HTMLElement;
  readonly #stage: Stage;
  readonly #bar = h('input', { type: 'range', min: 0, max: 100, step: 1, value: 60, 'aria-label': 'Times that deformation is shown', id: 'factor' });
  readonly #told = h('output', { class: 'told', for: 'factor' });

  constructor(stage: Stage) {
    this.#stage = stage;
    const colouring = h('select', { 'aria-label': 'Colours' });
    for (const [value, words] of [
      ['plain', 'plain'],
      ['displacement', 'displacement'],
      ['stress', 'stress'],
      ['share', 'budget share'],
    ]) {
      colouring.append(h('option', { value }, words));
    }
    colouring.addEventListener('change', () => {
      stage.colouring = colouring.value as Colouring;
      stage.refresh();
    });
    this.#bar.addEventListener('input', () => {
      stage.factor = this.#factor(this.#bar.valueAsNumber);
      this.#tell();
      stage.refresh();
    });
    stage.onchange = () => {
      this.#bar.value = '60';
      this.#tell();
    };
    const true_ = h('button', { type: 'button', title: 'As it is: times 1', onclick: () => this.#set(1) }, '× 1');
    const auto = h('button', { type: 'button', title: 'A factor that shows the deflection well', onclick: () => this.#set(stage.auto) }, 'Auto');
    this.element = h(
      'div',
      { class: 'bottom', role: 'toolbar', 'aria-label': 'Deformation and colours' },
      h('label', { for: 'factor' }, 'Deformation'),
      this.#bar,
      this.#told,
      auto,
      true_,
      h('span', { class: 'spring' }),
      h('label', {}, h('span', {}, 'Colours'), colouring),
    );
  }

  #factor(place: number): number {
    if (place === 0) {
      return 0;
    }
    const exact = this.#stage.auto * SPAN ** ((place - 60) / 40);
    return Number(exact.toPrecision(2));
  }

  #set(factor: number): void {
    this.#stage.factor = factor;
    const place = 60 + (40 * Math.log(factor / this.#stage.auto)) / Math.log(SPAN);
    this.#bar.value = String(Math.min(Math.max(place, 1), 100));
    this.#tell();
    this.#stage.refresh();
  }

  #tell(): void {
    const { factor } = this.#stage;
    const words = factor === 0 ? 'off' : `× ${factor >= 1e5 ? factor.toExponential(0).replace('e+', 'e') : String(factor)}`;
    say(this.#told, words);
    this.#bar.setAttribute('aria-valuetext', words);
  }
}
