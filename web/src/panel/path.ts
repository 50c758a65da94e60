// Poses of a job: one after the other in the scene, and what changes along them as curves.

import uPlot from 'uplot';
import type { App } from '../app';
import { Dropped } from '../background';
import type { Pose, Six } from '../core';
import { fill, h, say } from '../dom';
import { number } from '../format';
import type { Stage } from '../scene/stage';
import { Refused } from '../wasm';

/** Poses whose curves are drawn at the most; of more, every n-th. */
const MOST = 240;
/** How many times the size a path is long at most. */
const LONGEST = 12;

interface Step {
  label: string;
  pose: Pose;
}

interface Found {
  pose: Six;
  displacement: Six;
  deflection: number;
  stress: number;
  frequency: number;
}

const CURVES = [
  { name: 'deflection', unit: 'm', of: (found: Found) => found.deflection },
  { name: 'largest stress', unit: 'Pa', of: (found: Found) => found.stress },
  { name: 'first frequency', unit: 'Hz', of: (found: Found) => found.frequency },
];

export class PathPanel {
  readonly element = h('div', { class: 'path' });
  readonly #app: App;
  readonly #stage: Stage;
  readonly #bar = h('input', { type: 'range', min: 0, max: 0, value: 0, 'aria-label': 'Pose of the job' });
  readonly #name = h('output', { class: 'told' });
  readonly #play = h('button', { type: 'button', 'aria-pressed': 'false' }, '▶ Play');
  readonly #curve = h('select', { 'aria-label': 'Curve' });
  readonly #note = h('p', { class: 'note' });
  readonly #chart = h('div', { class: 'chart' });
  #plot: uPlot | null = null;
  #steps: Step[] = [];
  #found: (Found | null)[] = [];
  #visible = false;
  #playing = false;
  #run = 0;

  constructor(app: App, stage: Stage) {
    this.#app = app;
    this.#stage = stage;
    CURVES.forEach(({ name, unit }, k) => this.#curve.append(h('option', { value: k }, `${name} [${unit}]`)));
    this.#curve.addEventListener('change', () => this.draw());
    this.#bar.addEventListener('input', () => this.#go(this.#bar.valueAsNumber));
    this.#play.addEventListener('click', () => this.#toggle());
    fill(
      this.element,
      h('div', { class: 'line' }, this.#play, this.#bar),
      this.#name,
      h('div', { class: 'line' }, this.#curve),
      this.#chart,
      this.#note,
    );
    fill(
      this.#note,
      'In the scene: where the output is led (grey), and where it goes under load (orange), deformed as much as the links.',
    );
    app.on('loaded', () => this.#offer());
    app.on('scene', () => {
      this.#found = [];
      if (this.#visible) {
        void this.#work();
      } else {
        this.#stage.path([], []);
      }
    });
  }

  show(visible: boolean): void {
    this.#visible = visible;
    if (!visible) {
      this.#playing = false;
      this.#stage.path([], []);
    } else if (this.#found.length === 0) {
      void this.#work();
    } else {
      this.#lines();
    }
  }

  /** Whether there is more than one pose. */
  get any(): boolean {
    return this.#steps.length > 1;
  }

  #offer(): void {
    const { loaded, core, data } = this.#app;
    const job = loaded?.jobs.find(({ name }) => name === loaded.job);
    this.#steps = core.live
      ? Array.from({ length: job?.poses ?? 0 }, (_, number_) => ({ label: `pose ${number_}`, pose: { number: number_ } }))
      : [...(data?.poses ?? [])];
    this.#bar.max = String(Math.max(this.#steps.length - 1, 0));
    this.#bar.value = String(core.live ? (loaded?.pose ?? 0) : 0);
    say(this.#name, this.any ? `${this.#steps.length} poses` : 'It has one pose. Jobs of a batch have more of them.');
    for (const part of [this.#play, this.#bar, this.#curve, this.#note]) {
      part.hidden = !this.any;
    }
    this.#found = [];
  }

  #go(k: number): void {
    const step = this.#steps[k];
    if (step) {
      this.#bar.value = String(k);
      this.#bar.setAttribute('aria-valuetext', step.label);
      const frame = this.#app.go(step.pose, this.#playing);
      const at = frame?.pose ? ` (${frame.pose.slice(0, 3).map((c) => number(c, 3)).join(', ')}) m` : '';
      say(this.#name, `${step.label}${at}${frame && frame.status !== 'ok' ? `: ${frame.status}` : ''}`);
      this.#plot?.setCursor({ left: this.#plot.valToPos(k, 'x'), top: 0 });
    }
  }

  #toggle(): void {
    this.#playing = !this.#playing;
    this.#play.setAttribute('aria-pressed', String(this.#playing));
    say(this.#play, this.#playing ? '❚❚ Pause' : '▶ Play');
    let last = 0;
    const step = (now: number): void => {
      if (!this.#playing) {
        this.#play.setAttribute('aria-pressed', 'false');
        say(this.#play, '▶ Play');
        return;
      }
      if (now - last > 60) {
        last = now;
        this.#go((this.#bar.valueAsNumber + 1) % Math.max(this.#steps.length, 1));
      }
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  async #work(): Promise<void> {
    const run = ++this.#run;
    const every = Math.max(1, Math.ceil(this.#steps.length / MOST));
    this.#found = this.#steps.map(() => null);
    const about = this.#app.caseName === undefined ? {} : { case: this.#app.caseName };
    for (let k = 0; k < this.#steps.length; k += every) {
      const step = this.#steps[k] as Step;
      try {
        const { value } = await this.#app.background.ask(this.#app.setup, { ask: 'frame', pose: step.pose, ...about }, '', 2);
        if (run !== this.#run || !this.#visible) {
          return;
        }
        this.#found[k] = value.pose
          ? {
              pose: value.pose,
              displacement: value.displacement ?? [0, 0, 0, 0, 0, 0],
              deflection: value.deflection ?? Number.NaN,
              stress: value.stress?.value ?? Number.NaN,
              frequency: value.frequencies[0] ?? Number.NaN,
            }
          : null;
      } catch (error) {
        if (!(error instanceof Refused) && !(error instanceof Dropped)) {
          throw error;
        }
      }
    }
    this.#lines();
    this.draw();
  }

  #lines(): void {
    const known = this.#found.filter((each) => each !== null);
    const factor = this.#stage.factor;
    const length = known.reduce((sum, { pose }, k) => sum + Math.hypot(...[0, 1, 2].map((c) => (pose[c] as number) - (known[Math.max(k - 1, 0)]?.pose[c] as number))), 0);
    // Poses of a grid are no path.
    if (length > LONGEST * (this.#stage.mechanism?.scene.size ?? 1)) {
      this.#stage.path([], []);
      return;
    }
    this.#stage.path(
      known.map(({ pose }) => pose),
      known.map(({ pose, displacement }) => [0, 1, 2].map((k) => (pose[k] as number) + factor * (displacement[k] as number))),
    );
  }

  /** Draws the curve, in the colours of the page. */
  draw(): void {
    this.#plot?.destroy();
    this.#plot = null;
    const curve = CURVES[Number(this.#curve.value)] as (typeof CURVES)[number];
    const known = this.#found.flatMap((found, k) => (found ? [[k, curve.of(found)] as const] : []));
    if (known.length < 2) {
      return;
    }
    const style = getComputedStyle(document.documentElement);
    const [ink, line, accent] = ['--ink', '--line', '--accent'].map((name) => style.getPropertyValue(name).trim()) as [string, string, string];
    const axis = { stroke: ink, grid: { stroke: line, width: 1 }, ticks: { stroke: line }, font: '11px system-ui, sans-serif' };
    this.#plot = new uPlot(
      {
        width: this.#chart.clientWidth || 340,
        height: 210,
        cursor: { drag: { x: false, y: false } },
        scales: { x: { time: false } },
        legend: { show: false },
        axes: [
          { ...axis, label: 'pose', labelSize: 16, size: 34 },
          { ...axis, size: 62, values: (_, ticks) => ticks.map((tick) => (Math.abs(tick) >= 1e5 || (tick !== 0 && Math.abs(tick) < 1e-3) ? tick.toExponential(1).replace('e+', 'e') : String(tick))) },
        ],
        series: [{}, { stroke: accent, width: 2, points: { show: known.length < 30 } }],
        hooks: {
          ready: [
            (plot) =>
              plot.over.addEventListener('click', () => {
                const at = plot.cursor.idx;
                const k = at === null || at === undefined ? undefined : known[at]?.[0];
                if (k !== undefined) {
                  this.#go(k);
                }
              }),
          ],
        },
      },
      [known.map(([k]) => k), known.map(([, value]) => (Number.isFinite(value) ? value : null))],
      this.#chart,
    );
  }
}
