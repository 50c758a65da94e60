// Names over the scene, kept from lying on each other.

import * as THREE from 'three';
import { h } from '../dom';
import type { Viewer } from './viewer';

export interface Label {
  text: string;
  kind: 'body' | 'joint' | 'axis' | 'load';
  at: () => THREE.Vector3;
}

export class Labels {
  readonly layer = h('div', { class: 'labels', 'aria-hidden': 'true' });
  #labels: { label: Label; element: HTMLElement; width: number }[] = [];

  set(labels: readonly Label[]): void {
    this.#labels = labels.map((label) => ({
      label,
      element: h('span', { class: `scene-label ${label.kind}` }, label.text),
      width: 7 * label.text.length + 8,
    }));
    this.layer.replaceChildren(...this.#labels.map(({ element }) => element));
  }

  /** Puts all names where their parts are seen; of two that would overlap the nearer one stays. */
  update(viewer: Viewer): void {
    if (this.#labels.length === 0) {
      return;
    }
    const seen = this.#labels.map((each) => ({ ...each, place: viewer.project(each.label.at()) }));
    seen.sort((a, b) => rank(a.label) - rank(b.label) || a.place[2] - b.place[2]);
    const taken: [number, number, number][] = [];
    for (const { element, place, width } of seen) {
      const [x, y, depth] = place;
      const free = taken.every(([tx, ty, tw]) => Math.abs(tx - x) > (tw + width) / 2 || Math.abs(ty - y) > 15);
      const shown = free && depth < 1 && depth > -1;
      element.style.display = shown ? '' : 'none';
      if (shown) {
        taken.push([x, y, width]);
        element.style.transform = `translate(-50%, -50%) translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
      }
    }
  }

  /** The names that are shown, with their places on the canvas. */
  shown(): { text: string; x: number; y: number; kind: string }[] {
    return this.#labels
      .filter(({ element }) => element.style.display !== 'none')
      .map(({ label, element }) => {
        const [x, y] = (/translate\(([-\d.]+)px, ([-\d.]+)px\)/.exec(element.style.transform) ?? []).slice(1).map(Number);
        return { text: label.text, kind: label.kind, x: x ?? 0, y: y ?? 0 };
      });
  }
}

function rank(label: Label): number {
  return ['axis', 'load', 'body', 'joint'].indexOf(label.kind);
}
