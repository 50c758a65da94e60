// The page around the scene: bar, editor, panels, and what their buttons do.

import { type App, refusal } from './app';
import { BottomBar } from './bottom';
import type { Problem } from './core';
import { type Example, examples } from './data';
import { download, fill, h, icon, say } from './dom';
import { EditorPane } from './editor/pane';
import { help } from './help';
import { menu } from './menu';
import { AnswerPanel } from './panel/answer';
import { MapPanel } from './panel/map';
import { ModesPanel } from './panel/modes';
import { MovePanel } from './panel/move';
import { PartPanel } from './panel/part';
import { PathPanel } from './panel/path';
import { Tabs } from './panel/tabs';
import { ValuesPanel } from './panel/values';
import { Stage } from './scene/stage';
import { StageBar } from './stagebar';
import { toHash } from './share';

interface Opened {
  main?: string;
  files?: Record<string, string>;
  job?: string;
  pose?: number;
}

export class Layout {
  readonly element: HTMLElement;
  readonly #app: App;
  readonly #stage: Stage;
  readonly #pane: EditorPane;
  readonly #left: Tabs;
  readonly #right: Tabs;
  readonly #path: PathPanel;
  readonly #title = h('h1', {}, '');
  readonly #job = h('select', { 'aria-label': 'Job of the batch', hidden: true });
  readonly #design = h('select', { 'aria-label': 'Design of the job', hidden: true });
  readonly #case = h('select', { 'aria-label': 'Load case', hidden: true });
  readonly #problem = h('button', { type: 'button', class: 'problem', role: 'alert', hidden: true });
  readonly #note = h('div', { class: 'toast', role: 'status', hidden: true });
  #noted = 0;
  #at: Problem | null = null;

  constructor(app: App) {
    this.#app = app;
    const stage = new Stage(app);
    this.#stage = stage;
    const part = new PartPanel(app);
    const values = new ValuesPanel(app);
    const modes = new ModesPanel(app, stage);
    const map = new MapPanel(app, stage);
    const path = new PathPanel(app, stage);
    this.#path = path;
    this.#pane = new EditorPane(app);
    this.#left = new Tabs('Input', [
      { id: 'move', name: 'Move', content: new MovePanel(app, stage).element },
      { id: 'values', name: 'Values', content: values.element },
      { id: 'text', name: 'Text', content: this.#pane.element },
    ]);
    this.#right = new Tabs('Results', [
      { id: 'answer', name: 'Answer', content: new AnswerPanel(app).element },
      { id: 'part', name: 'Part', content: part.element },
      { id: 'modes', name: 'Modes', content: modes.element, onshow: (shown) => modes.show(shown) },
      { id: 'map', name: 'Map', content: map.element, onshow: (shown) => map.show(shown) },
      { id: 'path', name: 'Poses', content: path.element, onshow: (shown) => path.show(shown) },
    ]);
    part.onvalue = (name) => {
      this.#left.show('values');
      values.find(name);
    };
    app.on('part', (chosen) => {
      if (chosen) {
        this.#right.show('part');
      }
    });
    this.#left.onchange = (id) => this.element.classList.toggle('writing', id === 'text');
    const bottom = new BottomBar(stage);
    const middle = h('main', { class: 'middle' }, stage.element, new StageBar(stage, () => this.#name(), (words) => this.note(words)).element, bottom.element);
    this.element = h('div', { id: 'app', class: 'page' }, this.#bar(), this.#left.element, middle, this.#right.element, this.#note);
    this.#left.element.classList.add('left');
    this.#right.element.classList.add('right');
    this.#listen();
  }

  #bar(): HTMLElement {
    const live = this.#app.core.live;
    const open = h('input', { type: 'file', accept: '.ron,.json,.csv,text/plain', multiple: true, hidden: true, 'aria-label': 'Files to open' });
    open.addEventListener('change', () => void this.#read([...(open.files ?? [])]).then(() => (open.value = '')));
    this.#job.addEventListener('change', () => this.#app.job(this.#job.value));
    this.#design.addEventListener('change', () => this.#app.job(this.#job.value, Number(this.#design.value)));
    this.#case.addEventListener('change', () => this.#app.inCase(this.#case.value || undefined));
    return h(
      'header',
      { class: 'bar' },
      h('span', { class: 'brand', title: 'hyperstat' }, icon('M2 13h12M3 13 8 3l5 10M5 9h6M8 3v10'), h('span', {}, 'hyperstat')),
      this.#title,
      this.#job,
      this.#design,
      this.#case,
      this.#problem,
      h('span', { class: 'spring' }),
      live ? menu('Examples', 'Examples and files to begin with', () => this.#examples()) : null,
      live ? h('button', { type: 'button', onclick: () => open.click() }, 'Open') : null,
      live ? menu('Save', 'Save', () => this.#saves()) : h('button', { type: 'button', onclick: () => this.save() }, 'Save'),
      live ? h('button', { type: 'button', title: 'A link that holds the text', onclick: () => void this.share() }, 'Share') : null,
      h('button', { type: 'button', class: 'square', title: 'Light or dark', 'aria-label': 'Light or dark', onclick: () => this.#theme() }, icon('M8 2a6 6 0 1 0 0 12zM8 2a6 6 0 0 1 0 12')),
      h('button', { type: 'button', class: 'square', title: 'Help (?)', 'aria-label': 'Help', onclick: () => help(this.#app) }, '?'),
      open,
    );
  }

  /** Shows a file. */
  open(text: string, opened: Opened = {}): void {
    this.#pane.editor.text = text;
    this.#app.load(text, opened);
  }

  /** Where the output is shown, from the corner of the window [CSS pixels]. */
  output(): { x: number; y: number } | null {
    const at = this.#stage.mechanism?.output();
    const { left, top } = this.#stage.viewer.canvas.getBoundingClientRect();
    const [x, y] = at ? this.#stage.viewer.project(at) : [0, 0];
    return at ? { x: left + x, y: top + y } : null;
  }

  /** Shows the first example, where the page holds no file. */
  begin(): void {
    const first = examples.find(({ name }) => name === 'delta.ron') ?? examples[0];
    if (first) {
      this.#take(first);
    }
  }

  #take({ name, text, files }: Example): void {
    this.open(text, { main: /\.(ron|json)$/.test(name) ? name : `${name}.ron`, files: files ?? {} });
  }

  #examples(): (string | { name: string; act: () => void })[] {
    const item = (example: Example): { name: string; act: () => void } => ({ name: example.name, act: () => this.#take(example) });
    let beginnings: Example[] = [];
    try {
      beginnings = this.#app.core.ask({ ask: 'beginnings' }).value;
    } catch (error) {
      this.note(refusal(error).message);
    }
    return ['To begin with', ...beginnings.map(item), 'Examples', ...examples.map(item)];
  }

  async #read(files: File[]): Promise<void> {
    const read = await Promise.all(files.map(async (file) => [file.name, await file.text()] as const));
    const main = read.find(([name]) => /\.(ron|json)$/i.test(name)) ?? read.find(([name]) => !/\.csv$/i.test(name));
    const tables = Object.fromEntries(read.filter((each) => each !== main));
    if (main) {
      this.open(main[1], { main: main[0], files: tables });
    } else {
      // Tables alone belong to the file that is shown.
      this.open(this.#app.text, { main: this.#app.main, files: { ...this.#app.files, ...tables } });
    }
  }

  save(): void {
    download(this.#app.main, this.#pane.editor.text, 'text/plain');
  }

  #saves(): { name: string; note: string; act: () => void }[] {
    const written = (json: boolean) => (): void => {
      const { pose, main } = this.#app;
      try {
        const { text } = this.#app.core.ask({ ask: 'write', ...(pose ? { pose } : {}), json }).value;
        download(main.replace(/\.(ron|json)$/, json ? '-pose.json' : '-pose.ron'), text, 'text/plain');
      } catch (error) {
        this.note(refusal(error).message);
      }
    };
    return [
      { name: 'Text', note: 'as it is written', act: () => this.save() },
      { name: 'Mechanism at this pose', note: 'RON', act: written(false) },
      { name: 'Mechanism at this pose', note: 'JSON', act: written(true) },
    ];
  }

  async share(): Promise<void> {
    const { loaded, pose } = this.#app;
    const number = pose && 'number' in pose ? pose.number : undefined;
    const { [this.#app.main]: _, ...files } = this.#app.files;
    const hash = await toHash({
      text: this.#pane.editor.text,
      ...(Object.keys(files).length > 0 ? { files } : {}), ...(loaded?.job ? { job: loaded.job } : {}), ...(number === undefined ? {} : { pose: number }),
    });
    history.replaceState(null, '', hash);
    try {
      await navigator.clipboard.writeText(location.href);
      this.note(`The link is copied; it holds the text (${location.href.length} characters).`);
    } catch {
      this.note('The address of this page now holds the text: copy it from there.');
    }
  }

  #name(): string {
    return this.#app.loaded?.name ?? 'mechanism';
  }

  /** Says something for a while. */
  note(words: string): void {
    say(this.#note, words);
    this.#note.hidden = false;
    clearTimeout(this.#noted);
    this.#noted = window.setTimeout(() => (this.#note.hidden = true), 5000);
  }

  #theme(): void {
    const root = document.documentElement;
    const dark = getComputedStyle(root).getPropertyValue('--dark').trim() === '1';
    root.dataset.theme = dark ? 'light' : 'dark';
    this.#tones();
    this.#path.draw();
  }

  #tones(): void {
    const style = getComputedStyle(document.documentElement);
    const tone = (name: string): string => style.getPropertyValue(name).trim();
    this.#stage.viewer.tones({ background: tone('--stage'), floor: tone('--floor'), floorLine: tone('--floor-line') });
  }

  #listen(): void {
    const app = this.#app;
    app.on('loaded', (loaded) => {
      say(this.#title, loaded.name);
      document.title = `${loaded.name} – hyperstat`;
      this.#job.hidden = loaded.jobs.length < 2 || !app.core.live;
      fill(this.#job, ...loaded.jobs.map(({ name }) => h('option', { value: name, selected: name === loaded.job }, name)));
      const designs = loaded.jobs.find(({ name }) => name === loaded.job)?.designs ?? 1;
      this.#design.hidden = designs < 2 || !app.core.live;
      fill(this.#design, ...Array.from({ length: Math.min(designs, 500) }, (_, k) => h('option', { value: k, selected: k === (loaded.design ?? 0) }, `design ${k}`)));
      this.#case.hidden = loaded.cases.length === 0;
      fill(this.#case, h('option', { value: '' }, 'loads'), ...loaded.cases.map((name) => h('option', { value: name, selected: name === app.caseName }, `case ${name}`)));
    });
    app.on('problem', (problem) => this.#tell(problem));
    this.#problem.addEventListener('click', () => {
      if (this.#at?.line) {
        this.#left.show('text');
        this.#pane.editor.show(this.#at.line, this.#at.column ?? 1);
      }
    });
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.#tones());
    requestAnimationFrame(() => this.#tones());
    document.addEventListener('keydown', (event) => {
      const writing = (event.target as HTMLElement).closest('input, textarea, select, .cm-editor');
      if (event.key === 's' && (event.ctrlKey || event.metaKey)) {
        event.preventDefault();
        this.save();
      } else if (event.key === '?' && !writing) {
        help(app);
      }
    });
    document.addEventListener('dragover', (event) => event.preventDefault());
    document.addEventListener('drop', (event) => {
      event.preventDefault();
      if (app.core.live) {
        void this.#read([...(event.dataTransfer?.files ?? [])]);
      }
    });
    addEventListener('hashchange', () => location.hash.startsWith('#s=') && location.reload());
  }

  #tell(problem: Problem | null): void {
    this.#at = problem;
    this.#problem.hidden = problem === null;
    if (problem) {
      const place = problem.line ? `line ${problem.line}: ` : '';
      say(this.#problem, `${place}${problem.message}`);
      this.#problem.title = problem.help ?? problem.message;
    }
  }
}
