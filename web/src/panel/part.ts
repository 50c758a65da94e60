// A part that was clicked: what it gives, what is in it, and what 1 % more of its values would change.

import type { App, Sensitivity } from '../app';
import { fill, h } from '../dom';
import { number, percent, signed, withPrefix } from '../format';
import type { Part } from '../scene/mechanism';
import { unitOf } from './answer';

export class PartPanel {
  readonly element = h('div', { class: 'part', 'aria-live': 'polite' });
  readonly #app: App;
  /** Brings a value's slider to the front. */
  onvalue: (path: string) => void = () => {};

  constructor(app: App) {
    this.#app = app;
    app.on('part', () => this.#show());
    app.on('answer', () => this.#show());
    this.#show();
  }

  #show(): void {
    const part = this.#app.part;
    if (!part || part.kind === 'mass') {
      fill(
        this.element,
        h('p', { class: 'empty' }, part ? `${part.name}: ${part.words}` : 'Click a link or a joint in the scene, or a name in the budget. With the keys [ and ] one part after the other is chosen.'),
        ...this.#sensitivities(null),
      );
      return;
    }
    fill(this.element, ...this.#about(part), ...this.#gives(part), ...(part.kind === 'body' ? this.#stress(part) : this.#wrench(part)), ...this.#sensitivities(part));
  }

  #about(part: Part): HTMLElement[] {
    const scene = this.#app.scene;
    const rows: [string, string][] = [];
    if (part.kind === 'body') {
      const body = scene?.bodies[part.index];
      rows.push(['kind', body?.kind ?? '']);
      const links = (body?.segments ?? []).map((s) => scene?.segments[s]).filter((each) => each !== undefined);
      for (const words of new Set(links.map(({ from, to }) => (from.words === to.words ? from.words : `${from.words} to ${to.words}`)))) {
        rows.push(['section', words]);
      }
      if (links.length > 0) {
        rows.push(['length', withPrefix(links.reduce((sum, { length }) => sum + length, 0), 'm')]);
      }
      rows.push(['points', (body?.nodes ?? []).map((v) => scene?.nodes[v]?.point ?? '').join(', ')]);
    } else {
      const joint = scene?.joints[part.index];
      rows.push(['kind', joint?.kind ?? '']);
      rows.push(['between', (joint?.bodies ?? []).map((b) => (b === null ? 'ground' : (scene?.bodies[b]?.name ?? ''))).join(' – ')]);
      for (const [name, list] of [['free', joint?.free], ['held', joint?.locked], ['elastic', joint?.elastic]] as const) {
        if (list && list.length > 0) {
          rows.push([name, list.join(' ')]);
        }
      }
    }
    return [
      h('h3', {}, part.name),
      h('dl', {}, ...rows.flatMap(([name, value]) => [h('dt', {}, name), h('dd', {}, value)])),
    ];
  }

  #gives(part: Part): HTMLElement[] {
    const budget = this.#app.frame?.budget;
    if (!budget) {
      return [];
    }
    const name = part.kind === 'joint' ? `joint ${part.name}` : part.name;
    const own = budget.by_part.find((each) => each.name === name);
    const unit = unitOf(budget);
    const pieces = budget.parts.filter((each) => (part.kind === 'joint' ? each.joint === part.name : each.body === part.name));
    return [
      h('h4', {}, 'It gives'),
      h(
        'p',
        { class: 'gives' },
        h('b', {}, own ? (own.share === null ? '–' : percent(own.share)) : '0 %'),
        ` of the ${budget.of === 'displacement' ? 'deflection' : 'compliance'}: ${withPrefix(own?.displacement ?? 0, unit)}`,
      ),
      h('dl', {}, ...pieces.flatMap((each) => [h('dt', {}, each.deformation), h('dd', {}, `${each.share === null ? '–' : percent(each.share)}  ${withPrefix(each.displacement, unit, 3)}`)])),
    ];
  }

  #stress(part: Part): HTMLElement[] {
    const worst = this.#app.solved?.bodies?.[part.name]?.worst;
    if (!worst || worst.von_mises === null) {
      return [];
    }
    const used = worst.utilisation === null ? '' : `, ${percent(worst.utilisation)} of yield`;
    return [
      h('h4', {}, 'Largest equivalent stress'),
      h('p', {}, `${withPrefix(worst.von_mises, 'Pa')}${used}, ${withPrefix(worst.at, 'm', 3)} from ${worst.segment[0]} towards ${worst.segment[1]}`),
    ];
  }

  #wrench(part: Part): HTMLElement[] {
    const wrench = this.#app.solved?.joints?.[part.name]?.wrench;
    if (!wrench) {
      return [];
    }
    const names = ['Fx', 'Fy', 'Fz', 'Mx', 'My', 'Mz'];
    return [
      h('h4', {}, 'Wrench on the second body, joint frame'),
      h('dl', { class: 'two' }, ...names.flatMap((name, k) => [h('dt', {}, name), h('dd', {}, `${number(wrench[k])} ${k < 3 ? 'N' : 'N·m'}`)])),
    ];
  }

  /** Values of the part first; without a part all. */
  #sensitivities(part: Part | null): HTMLElement[] {
    const solved = this.#app.solved;
    if (!solved) {
      const words = this.#app.core.live ? 'Working out what 1 % more changes …' : 'What 1 % more changes was worked out at the pose of the file alone.';
      return part ? [h('p', { class: 'note' }, words)] : [];
    }
    const all = (solved.sensitivities ?? []).filter(({ relative }) => relative !== null && Number.isFinite(relative));
    const paths = this.#paths(part);
    const own = paths ? all.filter((each) => paths.has(each.path ?? each.parameter) || paths.has(each.parameter)) : all;
    const list = [...(own.length > 0 ? own : all)].sort((a, b) => Math.abs(b.relative ?? 0) - Math.abs(a.relative ?? 0)).slice(0, 14);
    if (list.length === 0) {
      return [];
    }
    const heading = part && own.length > 0 ? 'What 1 % more of it changes' : 'What 1 % more of each value changes';
    const of = this.#app.frame?.budget?.of === 'compliance' ? 'compliance' : 'deflection';
    const head = h('tr', {}, h('th', { scope: 'col' }, 'value'), h('th', { scope: 'col', class: 'num' }, 'now'), h('th', { scope: 'col', class: 'num' }, of));
    return [h('h4', {}, heading), h('table', { class: 'sensitivities' }, head, ...list.map((each) => this.#row(each)))];
  }

  #paths(part: Part | null): Set<string> | null {
    if (!part) {
      return null;
    }
    const name = part.kind === 'joint' ? `joint ${part.name}` : part.name;
    return new Set(this.#app.values.filter(({ parts }) => parts.includes(name)).map(({ path }) => path));
  }

  #row(each: Sensitivity): HTMLElement {
    const path = each.path ?? each.parameter;
    const amount = each.relative ?? 0;
    return h(
      'tr',
      {},
      h('td', {}, this.#app.core.live ? h('button', { type: 'button', class: 'link', title: 'change it', onclick: () => this.onvalue(path) }, each.parameter) : each.parameter),
      h('td', { class: 'num' }, number(each.value)),
      h('td', { class: `num ${amount < 0 ? 'less' : 'more'}` }, signed(amount)),
    );
  }
}
