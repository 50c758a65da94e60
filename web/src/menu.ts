// Menus that open below a button.

import { fill, h } from './dom';

export interface Item {
  name: string;
  note?: string;
  /** Of an item that is on or off. */
  checked?: boolean;
  act: () => void;
}

/** A button with a menu; its items are asked for each time it opens. Keys as of a menu button. */
export function menu(label: string | Node, name: string, items: () => (Item | string)[]): HTMLElement {
  const list = h('div', { role: 'menu', class: 'menu-list', hidden: true, 'aria-label': name });
  const button = h('button', { type: 'button', 'aria-haspopup': 'menu', 'aria-expanded': 'false', title: name, 'aria-label': name }, label);
  const close = (focus = false): void => {
    list.hidden = true;
    button.setAttribute('aria-expanded', 'false');
    document.removeEventListener('pointerdown', outside, true);
    if (focus) {
      button.focus();
    }
  };
  const outside = (event: Event): void => {
    if (!root.contains(event.target as Node)) {
      close();
    }
  };
  const entries = (): HTMLElement[] => [...list.querySelectorAll<HTMLElement>('button')];
  const show = (): void => {
    fill(
      list,
      ...items().map((item) =>
        typeof item === 'string'
          ? h('div', { class: 'menu-title', role: 'presentation' }, item)
          : h(
              'button',
              {
                type: 'button',
                role: item.checked === undefined ? 'menuitem' : 'menuitemcheckbox',
                'aria-checked': item.checked === undefined ? undefined : String(item.checked),
                tabindex: -1,
                onclick: () => {
                  item.act();
                  if (item.checked === undefined) {
                    close(true);
                  } else {
                    show();
                  }
                },
              },
              item.checked === undefined ? null : h('span', { class: 'tick', 'aria-hidden': 'true' }, item.checked ? '✓' : ''),
              item.name,
              item.note ? h('span', { class: 'note' }, item.note) : null,
            ),
      ),
    );
    if (list.hidden) {
      list.hidden = false;
      button.setAttribute('aria-expanded', 'true');
      document.addEventListener('pointerdown', outside, true);
      entries()[0]?.focus();
    }
  };
  button.addEventListener('click', () => (list.hidden ? show() : close()));
  list.addEventListener('keydown', (event) => {
    const all = entries();
    const now = all.indexOf(document.activeElement as HTMLElement);
    const next = { ArrowDown: now + 1, ArrowUp: now - 1, Home: 0, End: all.length - 1 }[event.key];
    if (event.key === 'Escape') {
      close(true);
      event.stopPropagation();
    } else if (event.key === 'Tab') {
      close();
    } else if (next !== undefined) {
      all[(next + all.length) % all.length]?.focus();
      event.preventDefault();
    }
  });
  const root = h('div', { class: 'menu' }, button, list);
  return root;
}

/** A dialog with a heading, which Escape closes. */
export function dialog(title: string, ...content: (Node | string)[]): void {
  const close = h('button', { type: 'button', class: 'close', 'aria-label': 'Close' }, '×');
  const box = h('dialog', { 'aria-label': title }, h('header', {}, h('h2', {}, title), close), h('div', { class: 'dialog-body' }, ...content));
  close.addEventListener('click', () => box.close());
  box.addEventListener('close', () => box.remove());
  box.addEventListener('click', (event) => {
    if (event.target === box) {
      box.close();
    }
  });
  document.body.append(box);
  box.showModal();
}
