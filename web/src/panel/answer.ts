// The answer, live: stiffness, deflection, stress, frequencies, budget.

import type { App, Solved } from '../app';
import type { Budget, Frame, Principal, Share, Six } from '../core';
import { fill, h, say } from '../dom';
import { number, percent, withoutRounding, withPrefix } from '../format';

const AXES = ['Δx', 'Δy', 'Δz', 'φx', 'φy', 'φz'];
const FORCES = ['Fx', 'Fy', 'Fz', 'Mx', 'My', 'Mz'];

/** A bar of the budget. */
interface Bar {
  row: HTMLElement;
  name: HTMLElement;
  bar: HTMLElement;
  share: HTMLElement;
  size: HTMLElement;
}

export class AnswerPanel {
  readonly element = h('div', { class: 'answer' });
  readonly #app: App;
  readonly #keys = new Map<string, { value: HTMLElement; note: HTMLElement }>();
  readonly #cells: HTMLElement[][] = [];
  readonly #displacement: HTMLElement[] = [];
  readonly #principal: HTMLElement[][] = [];
  readonly #frequencies = h('p', { class: 'frequencies' });
  readonly #parts = h('div', { class: 'bars' });
  readonly #kinds = h('div', { class: 'bars' });
  readonly #along = h('span', {});
  readonly #total = h('p', { class: 'note' });
  readonly #bars: Bar[] = [];
  readonly #kindBars: Bar[] = [];
  readonly #facts = h('p', { class: 'facts' });
  readonly #warnings = h('ul', { class: 'warnings' });
  readonly #state = h('p', { class: 'state', role: 'status' });

  constructor(app: App) {
    this.#app = app;
    const key = (id: string, label: string): HTMLElement => {
      const value = h('output', { class: 'value', id: `key-${id}`, 'aria-label': label }, '–');
      const note = h('span', { class: 'note' });
      this.#keys.set(id, { value, note });
      return h('div', { class: 'key' }, h('span', { class: 'label' }, label), value, note);
    };
    fill(
      this.element,
      this.#state,
      h(
        'div',
        { class: 'keys' },
        key('deflection', 'Deflection'),
        key('rotation', 'Rotation'),
        key('softest', 'Least stiffness'),
        key('stiffest', 'Greatest stiffness'),
        key('stress', 'Largest stress'),
        key('frequency', 'First frequency'),
      ),
      this.#matrix(),
      this.#principals(),
      h(
        'section',
        { 'aria-label': 'Compliance budget' },
        h('div', { class: 'line heading' }, h('h3', {}, 'Budget ', this.#along), app.core.live ? this.#direction() : null),
        this.#total,
        this.#parts,
        h('h4', {}, 'by deformation'),
        this.#kinds,
      ),
      h('section', {}, h('h3', {}, 'Natural frequencies'), this.#frequencies),
      h('section', {}, h('h3', {}, 'Structure'), this.#facts, this.#warnings),
    );
    app.on('frame', ({ frame }) => this.#show(frame));
    app.on('answer', (solved) => this.#tell(solved));
  }

  /** Chooses the direction whose deflection is taken apart. */
  #direction(): HTMLElement {
    const select = h('select', { 'aria-label': 'Direction of the budget' }, h('option', { value: '' }, 'along it'));
    ['x', 'y', 'z', 'rx', 'ry', 'rz'].forEach((name, k) => select.append(h('option', { value: k }, `along ${name}`)));
    select.addEventListener('change', () => {
      const unit: Six = [0, 0, 0, 0, 0, 0];
      unit[Number(select.value)] = 1;
      this.#app.inDirection(select.value === '' ? undefined : unit);
    });
    return select;
  }

  #matrix(): HTMLElement {
    const table = h('table', { class: 'matrix', id: 'stiffness' });
    table.append(h('caption', {}, 'Stiffness of the output ', h('span', { class: 'unit' }, 'N/m, N/rad; N, N·m/rad')));
    table.append(h('tr', {}, h('td', {}), ...AXES.map((name) => h('th', { scope: 'col' }, name))));
    for (const name of FORCES) {
      const cells = AXES.map(() => h('td', {}, '–'));
      this.#cells.push(cells);
      table.append(h('tr', {}, h('th', { scope: 'row' }, name), ...cells));
    }
    const moved = AXES.map(() => h('td', {}, '–'));
    this.#displacement.push(...moved);
    table.append(h('tr', { class: 'displacement', title: 'displacement of the output [m, rad]' }, h('th', { scope: 'row' }, 'u'), ...moved));
    return table;
  }

  #principals(): HTMLElement {
    const table = h('table', { class: 'principal' });
    table.append(h('caption', {}, 'Principal stiffness'));
    for (const name of ['translation [N/m]', 'rotation [N·m/rad]']) {
      const cells = [0, 1, 2].map(() => h('td', {}, '–'));
      this.#principal.push(cells);
      table.append(h('tr', {}, h('th', { scope: 'row' }, name), ...cells));
    }
    return table;
  }

  #key(id: string, value: string, note = ''): void {
    const found = this.#keys.get(id);
    if (found) {
      say(found.value, value);
      say(found.note, note);
    }
  }

  #show(frame: Frame): void {
    const ok = frame.stiffness !== null || frame.displacement !== null;
    this.element.classList.toggle('stale', frame.status !== 'ok');
    say(this.#state, frame.status === 'ok' ? '' : (frame.problem?.message ?? frame.status));
    if (!ok && frame.layout === null) {
      return;
    }
    const translation = frame.principal?.translational_stiffnesses;
    this.#key('deflection', withPrefix(frame.deflection, 'm'));
    this.#key('rotation', withPrefix(frame.rotation, 'rad'));
    this.#key('softest', withPrefix(translation?.values[0], 'N/m'), direction(translation, 0));
    this.#key('stiffest', withPrefix(translation?.values[2], 'N/m'), direction(translation, 2));
    const stress = frame.stress;
    const used = stress?.utilisation ? `, ${percent(stress.utilisation)} of yield` : '';
    this.#key('stress', withPrefix(stress?.value, 'Pa'), stress ? `in ${stress.body}${used}` : '');
    this.#key('frequency', frame.frequencies.length > 0 ? withPrefix(frame.frequencies[0], 'Hz') : '–', frame.frequencies.length > 0 ? '' : 'needs densities');
    const matrix = frame.stiffness ? withoutRounding(frame.stiffness) : null;
    this.#cells.forEach((row, r) => row.forEach((cell, c) => say(cell, number(matrix?.[r]?.[c]))));
    const moved = frame.displacement;
    this.#displacement.forEach((cell, k) => {
      // What is rounding beside the largest of its kind is 0, as in the reports.
      const kind = moved?.slice(k < 3 ? 0 : 3, k < 3 ? 3 : 6) ?? [];
      const own = moved?.[k];
      say(cell, number(own !== undefined && Math.abs(own) < 1e-14 * Math.max(...kind.map(Math.abs)) ? 0 : own, 4));
    });
    [translation, frame.principal?.rotational_stiffnesses].forEach((principal, r) => {
      this.#principal[r]?.forEach((cell, c) => say(cell, number(principal?.values[c])));
    });
    say(this.#frequencies, frame.frequencies.length > 0 ? frame.frequencies.map((each) => withPrefix(each, 'Hz')).join(' · ') : '–');
    this.#budget(frame.budget);
  }

  #budget(budget: Budget | null): void {
    say(this.#along, budget ? (budget.of === 'displacement' ? 'of the deflection' : 'of the compliance') : '');
    say(this.#total, budget ? `${withPrefix(budget.total, unitOf(budget))} ${budget.along.slice(3).some((part) => part !== 0) ? 'about' : 'along'} ${vector(budget.along)}` : '');
    const unit = budget ? unitOf(budget) : '';
    this.#fill(this.#parts, this.#bars, (budget?.by_part ?? []).slice(0, 12), unit, true);
    this.#fill(this.#kinds, this.#kindBars, budget?.by_deformation ?? [], unit, false);
  }

  #fill(parent: HTMLElement, bars: Bar[], shares: readonly Share[], unit: string, pick: boolean): void {
    while (bars.length < shares.length) {
      const bar = h('span', { class: 'bar' });
      const [share, size] = [h('span', { class: 'share' }), h('span', { class: 'size' })];
      const name = pick
        ? h('button', { type: 'button', class: 'name', onclick: () => this.#choose(name.textContent ?? '') })
        : h('span', { class: 'name' });
      const row = h('div', { class: 'budget-row' }, name, h('span', { class: 'track' }, bar), share, size);
      bars.push({ row, name, bar, share, size });
      parent.append(row);
    }
    const most = Math.max(...shares.map(({ share }) => Math.abs(share ?? 0)), 1e-9);
    bars.forEach((own, k) => {
      const each = shares[k];
      own.row.hidden = each === undefined;
      if (each) {
        say(own.name, each.name);
        say(own.share, each.share === null ? '–' : percent(each.share));
        say(own.size, withPrefix(each.displacement, unit, 3));
        own.bar.style.transform = `scaleX(${Math.abs((each.share ?? 0) / most).toFixed(4)})`;
        own.bar.classList.toggle('negative', (each.share ?? 0) < 0);
      }
    });
  }

  #choose(name: string): void {
    const scene = this.#app.scene;
    const joint = /^joint (.*)$/.exec(name)?.[1];
    const index = (joint === undefined ? scene?.bodies : scene?.joints)?.findIndex((each) => each.name === (joint ?? name)) ?? -1;
    if (index >= 0) {
      this.#app.choose({ kind: joint === undefined ? 'body' : 'joint', index, name: joint ?? name, words: '' });
    }
  }

  #tell(solved: Solved | null): void {
    if (solved) {
      const idle = (solved as { idle_modes?: number }).idle_modes ?? 0;
      const facts = [`mobility ${solved.mobility ?? '–'}`, `over-constraint ${solved.overconstraint ?? '–'}`, `idle motions ${idle}`];
      const condition = solved.measures?.condition;
      if (typeof condition === 'number') {
        facts.push(`condition ${number(condition, 4)}`);
      }
      say(this.#facts, facts.join(' · '));
      const told = (solved.warnings ?? []).map((each) => (typeof each === 'string' ? each : (each.message ?? '')));
      fill(this.#warnings, ...[...(this.#app.loaded?.warnings ?? []), ...told].map((text) => h('li', {}, text)));
    }
  }
}

function direction(principal: Principal | null | undefined, k: number): string {
  const way = principal?.directions[k];
  return way ? `along ${vector(way)}` : '';
}

/** What a budget's displacements are in: of a state, or under a unit wrench. */
export function unitOf({ of, along }: Budget): string {
  const turning = along.slice(3).some((part) => part !== 0);
  return of === 'displacement' ? (turning ? 'rad' : 'm') : turning ? 'rad/(N·m)' : 'm/N';
}

function vector(way: readonly number[]): string {
  const parts = way.slice(0, 3).map((part) => (Math.abs(part) < 5e-4 ? '0' : part.toFixed(3).replace('-', '−')));
  if (way.slice(3).some((part) => Math.abs(part) > 1e-12)) {
    return vector(way.slice(3));
  }
  const single = parts.findIndex((_, k) => Math.abs(Math.abs(way[k] as number) - 1) < 1e-6);
  return single >= 0 ? `${(way[single] as number) < 0 ? '−' : ''}${'xyz'[single]}` : `(${parts.join(', ')})`;
}
