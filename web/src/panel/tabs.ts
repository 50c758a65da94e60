// Tabs, as screen readers and keys know them.

import { h } from '../dom';

export interface Tab {
  id: string;
  name: string;
  content: HTMLElement;
  /** Called when the tab comes to the front, and when it goes. */
  onshow?: (shown: boolean) => void;
}

export class Tabs {
  readonly element: HTMLElement;
  readonly #tabs: readonly Tab[];
  readonly #buttons: HTMLButtonElement[];
  #current = -1;
  /** Called with the tab that came to the front. */
  onchange: (id: string) => void = () => {};

  constructor(name: string, tabs: readonly Tab[]) {
    this.#tabs = tabs;
    this.#buttons = tabs.map((tab, k) =>
      h(
        'button',
        {
          type: 'button',
          role: 'tab',
          id: `tab-${tab.id}`,
          'aria-controls': `panel-${tab.id}`,
          onclick: () => this.show(tab.id),
          onkeydown: (event) => this.#key(event as KeyboardEvent, k),
        },
        tab.name,
      ),
    );
    const panels = tabs.map((tab) =>
      h(
        'div',
        { role: 'tabpanel', id: `panel-${tab.id}`, 'aria-labelledby': `tab-${tab.id}`, class: 'tabpanel', hidden: true },
        tab.content,
      ),
    );
    this.element = h('div', { class: 'tabs' }, h('div', { role: 'tablist', 'aria-label': name, class: 'tablist' }, ...this.#buttons), ...panels);
    this.#show(0);
  }

  get current(): string {
    return this.#tabs[this.#current]?.id ?? '';
  }

  show(id: string): void {
    this.#show(this.#tabs.findIndex((tab) => tab.id === id));
  }

  #show(next: number): void {
    if (next < 0 || next === this.#current) {
      return;
    }
    const before = this.#tabs[this.#current];
    this.#current = next;
    this.#buttons.forEach((button, k) => {
      button.setAttribute('aria-selected', String(k === next));
      button.tabIndex = k === next ? 0 : -1;
    });
    [...this.element.querySelectorAll<HTMLElement>(':scope > [role=tabpanel]')].forEach((panel, k) => {
      panel.hidden = k !== next;
    });
    before?.onshow?.(false);
    this.#tabs[next]?.onshow?.(true);
    this.onchange(this.current);
  }

  #key(event: KeyboardEvent, from: number): void {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (step !== undefined) {
      const next = (from + step + this.#tabs.length) % this.#tabs.length;
      this.#show(next);
      this.#buttons[next]?.focus();
      event.preventDefault();
    }
  }
}
