// The text beside the scene.

import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from '@codemirror/autocomplete';
import { defaultKeymap, history, historyKeymap, indentWithTab } from '@codemirror/commands';
import { bracketMatching, foldGutter, foldKeymap, indentOnInput, indentUnit } from '@codemirror/language';
import { type Diagnostic, lintGutter, lintKeymap, setDiagnostics } from '@codemirror/lint';
import { highlightSelectionMatches, search, searchKeymap } from '@codemirror/search';
import { Compartment, EditorState } from '@codemirror/state';
import {
  drawSelection,
  EditorView,
  highlightActiveLine,
  highlightActiveLineGutter,
  highlightSpecialChars,
  keymap,
  lineNumbers,
} from '@codemirror/view';
import { completer, type Schema } from './complete';
import { ron, ronColours } from './ron';

/** A mistake or a doubt at a place of the text; lines and columns count from 1. */
export interface Marked {
  line: number;
  column: number;
  /** Letters that are underlined, where the core tells them. */
  length?: number;
  severity: 'error' | 'warning';
  message: string;
}

const look = EditorView.theme({
  '&': { height: '100%', fontSize: '12.5px', color: 'var(--ink)', backgroundColor: 'var(--paper)' },
  '.cm-scroller': { fontFamily: 'var(--mono)', lineHeight: '1.5' },
  '.cm-gutters': { backgroundColor: 'var(--paper)', color: 'var(--faint)', border: 'none' },
  '.cm-activeLine, .cm-activeLineGutter': { backgroundColor: 'var(--shade)' },
  '.cm-cursor': { borderLeftColor: 'var(--ink)' },
  '&.cm-focused .cm-selectionBackground, .cm-selectionBackground': { backgroundColor: 'var(--select) !important' },
  '.cm-tooltip': { backgroundColor: 'var(--panel)', color: 'var(--ink)', border: '1px solid var(--line)', borderRadius: '6px' },
  '.cm-tooltip-autocomplete ul li[aria-selected]': { backgroundColor: 'var(--accent)', color: 'var(--on-accent)' },
  '.cm-diagnosticText': { whiteSpace: 'pre-wrap' },
  '.cm-panels': { backgroundColor: 'var(--panel)', color: 'var(--ink)' },
  '.cm-matchingBracket': { backgroundColor: 'var(--select) !important' },
});

export class Editor {
  readonly view: EditorView;
  readonly #lock = new Compartment();
  #quiet = false;

  /** An editor in `parent`; `changed` is called with what a person writes, not with what the page puts in. */
  constructor(parent: HTMLElement, text: string, schema: Schema | null, changed: (text: string) => void) {
    this.view = new EditorView({
      parent,
      state: EditorState.create({
        doc: text,
        extensions: [
          this.#lock.of([]),
          lineNumbers(),
          foldGutter(),
          highlightSpecialChars(),
          history(),
          drawSelection(),
          indentOnInput(),
          indentUnit.of('    '),
          EditorState.tabSize.of(4),
          bracketMatching(),
          closeBrackets(),
          highlightActiveLine(),
          highlightActiveLineGutter(),
          highlightSelectionMatches(),
          search({ top: true }),
          lintGutter(),
          ron,
          ronColours,
          look,
          autocompletion(schema ? { override: [completer(schema)] } : {}),
          keymap.of([
            ...closeBracketsKeymap,
            ...defaultKeymap,
            ...searchKeymap,
            ...historyKeymap,
            ...foldKeymap,
            ...completionKeymap,
            ...lintKeymap,
            indentWithTab,
          ]),
          EditorView.contentAttributes.of({ 'aria-label': 'Text of the mechanism', spellcheck: 'false' }),
          EditorView.updateListener.of((update) => {
            if (update.docChanged && !this.#quiet) {
              changed(update.state.doc.toString());
            }
          }),
        ],
      }),
    });
  }

  get text(): string {
    return this.view.state.doc.toString();
  }

  /** Puts another text in, without telling it as a person's. */
  set text(text: string) {
    if (text !== this.text) {
      this.#quiet = true;
      this.view.dispatch({ changes: { from: 0, to: this.view.state.doc.length, insert: text } });
      this.#quiet = false;
    }
  }

  /** Puts another text in as if a person had written it, so that it can be undone. */
  replace(text: string): void {
    if (text !== this.text) {
      this.view.dispatch({ changes: { from: 0, to: this.view.state.doc.length, insert: text } });
    }
  }

  /** Changes parts of the text, quietly; they can be undone. */
  change(parts: readonly { from: number; to: number; insert: string }[]): void {
    this.#quiet = true;
    this.view.dispatch({ changes: parts.map(({ from, to, insert }) => ({ from, to, insert })) });
    this.#quiet = false;
  }

  /** To be read only. */
  freeze(): void {
    this.view.dispatch({ effects: this.#lock.reconfigure(EditorState.readOnly.of(true)) });
  }

  /** Underlines mistakes where they stand. */
  mark(all: readonly Marked[]): void {
    const doc = this.view.state.doc;
    const marked = all.map((each): Diagnostic => {
      const line = doc.line(Math.min(Math.max(each.line, 1), doc.lines));
      const from = Math.min(line.from + Math.max(each.column - 1, 0), line.to);
      const word = /^(?:"(?:[^"\\]|\\.)*"?|[\w.+-]+)/.exec(doc.sliceString(from, line.to))?.[0].length ?? 1;
      const to = Math.min(from + Math.max(each.length ?? word, 1), doc.length);
      return { from: Math.min(from, to), to, severity: each.severity, message: each.message };
    });
    this.view.dispatch(setDiagnostics(this.view.state, marked));
  }

  /** Brings a place into view and puts the cursor there. */
  show(line: number, column: number): void {
    const doc = this.view.state.doc;
    const at = doc.line(Math.min(Math.max(line, 1), doc.lines));
    this.select(Math.min(at.from + Math.max(column - 1, 0), at.to));
  }

  /** Selects a part of the text and brings it into view. */
  select(from: number, to = from): void {
    this.view.dispatch({ selection: { anchor: from, head: to }, effects: EditorView.scrollIntoView(from, { y: 'center' }) });
    this.view.focus();
  }
}
