// What the keys do, what the colours of joints mean, and whose work is in the page.

import type { App } from './app';
import { h } from './dom';
import { dialog } from './menu';
import { STATE } from './scene/joints';

const KEYS: [string, string][] = [
  ['drag', 'turns the view; right button or two fingers move it; wheel or pinch comes nearer'],
  ['drag the ring', 'moves the platform within its mobility; with Shift it turns'],
  ['click', 'chooses a link or joint: what it gives, and what 1 % more of it changes'],
  ['arrow keys', 'turn the view; + and − come nearer and go away; F shows all'],
  ['Alt + arrows, Page Up/Down', 'move the platform; with Shift they turn it'],
  ['[ and ]', 'choose one part after the other'],
  ['Ctrl + S', 'saves the text'],
  ['Ctrl + Space', 'completes in the text'],
];

const STATES: [keyof typeof STATE, string][] = [
  ['free', 'free by its kind'],
  ['driven', 'held: a drive (with a ring)'],
  ['elastic', 'elastic (with a coil)'],
  ['fixed', 'fixed'],
];

export function help(app: App): void {
  const licences = document.getElementById('licences')?.textContent ?? '';
  dialog(
    'Help',
    h('table', { class: 'help' }, ...KEYS.map(([key, words]) => h('tr', {}, h('th', { scope: 'row' }, key), h('td', {}, words)))),
    h('h3', {}, 'Joints'),
    h('ul', { class: 'states' }, ...STATES.map(([state, words]) => h('li', {}, h('span', { class: 'swatch', style: `background: ${STATE[state]}` }), words))),
    h('p', {}, 'Red, green and blue lines are the axes x, y and z, at the origin and at the output. Green ellipsoid: principal stiffness in translation; purple: in rotation. Orange arrows are forces, purple ones moments.'),
    h('p', { class: 'note' }, app.core.live ? `The core works in this page (${app.data?.version ?? 'playground'}); nothing is sent anywhere.` : (app.data?.live ?? '').replaceAll('`', '')),
    h('details', {}, h('summary', {}, 'Licences of what is in the page'), h('pre', {}, licences)),
  );
}
