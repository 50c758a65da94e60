// Buttons over the scene: views, what is shown, pictures.

import { download, h, icon } from './dom';
import { type Item, menu } from './menu';
import type { Shown } from './scene/mechanism';
import type { Stage } from './scene/stage';
import { svg } from './scene/svg';
import type { View } from './scene/viewer';

const VIEWS: [View, string][] = [
  ['iso', 'Iso'],
  ['front', 'Front'],
  ['right', 'Right'],
  ['top', 'Top'],
];

const LAYERS: [keyof Shown, string][] = [
  ['joints', 'Joints'],
  ['ground', 'Ground'],
  ['loads', 'Loads'],
  ['weights', 'Masses and gravity'],
  ['frames', 'Frames'],
  ['ghost', 'Undeformed lines'],
  ['translational', 'Ellipsoid of stiffness'],
  ['rotational', 'Ellipsoid of rotational stiffness'],
];

export class StageBar {
  readonly element: HTMLElement;

  constructor(stage: Stage, name: () => string, note: (words: string) => void) {
    const flat = h('button', { type: 'button', 'aria-pressed': 'false', title: 'Orthographic or perspective' }, 'Ortho');
    flat.addEventListener('click', () => {
      stage.viewer.orthographic(!stage.viewer.isOrthographic);
      flat.setAttribute('aria-pressed', String(stage.viewer.isOrthographic));
    });
    const names = h('button', { type: 'button', 'aria-pressed': 'false', title: 'Names of links and joints' }, 'Names');
    names.addEventListener('click', () => {
      stage.names(!stage.namesShown);
      names.setAttribute('aria-pressed', String(stage.namesShown));
    });
    const isDark = (): boolean => getComputedStyle(document.documentElement).getPropertyValue('--dark').trim() === '1';
    this.element = h(
      'div',
      { class: 'stagebar', role: 'toolbar', 'aria-label': 'View' },
      h(
        'div',
        { class: 'group' },
        ...VIEWS.map(([view, words]) => h('button', { type: 'button', title: `${words} view`, onclick: () => stage.viewer.look(view) }, words)),
        h('button', { type: 'button', class: 'square', title: 'All in view (F)', 'aria-label': 'All in view', onclick: () => stage.viewer.fit() }, icon('M2 6V2h4M10 2h4v4M14 10v4h-4M6 14H2v-4')),
      ),
      h('div', { class: 'group' }, flat, names),
      h(
        'div',
        { class: 'group' },
        menu('Show', 'What is shown', () => this.#layers(stage)),
        menu('Picture', 'Save a picture', () => [
          {
            name: 'PNG',
            note: 'twice the pixels',
            act: () => {
              void stage.viewer.png(2).then((blob) => (blob ? download(`${name()}.png`, blob, 'image/png') : note('The picture could not be made.')));
            },
          },
          { name: 'SVG', note: 'lines to edit', act: () => download(`${name()}.svg`, svg(stage, isDark()), 'image/svg+xml') },
        ]),
      ),
    );
  }

  #layers(stage: Stage): Item[] {
    const layers = LAYERS.map(
      ([layer, name]): Item => ({
        name,
        checked: stage.shown[layer],
        act: () => {
          stage.shown[layer] = !stage.shown[layer];
          stage.names(stage.namesShown);
          stage.refresh();
        },
      }),
    );
    return [
      ...layers,
      {
        name: 'Floor',
        checked: stage.viewer.floorShown,
        act: () => {
          stage.viewer.floorShown = !stage.viewer.floorShown;
        },
      },
    ];
  }
}
