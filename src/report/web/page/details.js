// SPDX-License-Identifier: GPL-3.0-or-later
// What the run was asked, from what, by which version and how long it took.
import { countText, shortText } from './data.js';
import { byId, element } from './dom.js';

const code = (text) => element('code', {}, text);

function facts(title, rows) {
  const body = element('tbody');
  for (const [label, value] of rows) {
    if (value === undefined || value === null || value === '') continue;
    body.append(element('tr', {}, element('th', { scope: 'row' }, label), element('td', {}, value instanceof Node ? value : String(value))));
  }
  return element('div', { class: 'card' }, element('h2', {}, title), element('table', { class: 'facts' }, body));
}

const plain = (value) => (typeof value === 'number' ? shortText(value, 6) : typeof value === 'boolean' ? (value ? 'yes' : 'no')
  : value === null || value === '' ? '\u2013' : typeof value === 'object' ? JSON.stringify(value) : String(value));

function bodyRows(body) {
  const size = [];
  if (body.atoms) size.push(countText(body.atoms, 'atom'));
  if (body.residues) size.push(countText(body.residues, 'residue'));
  if (body.triangles) size.push(countText(body.triangles, 'triangle'));
  if (body.knots) size.push(countText(body.knots, 'knot'));
  return [
    [body.role, element('strong', { class: body.role === 'fixed' ? 'name-fixed' : 'name-moving' }, body.name)],
    ['file', code(body.spec)],
    ['found at', body.found && body.found !== body.path ? code(body.found) : ''],
    ['SHA-256', body.sha256 ? code(body.sha256) : 'not recorded'],
    ['size', size.join(', ')],
    ['shown', body.deviation ? `${countText(body.shown_triangles, 'triangle')}; the file\u2019s surface lies within ${shortText(body.deviation, 2)} ${body.unit || ''}`.trimEnd() + ` (${shortText((100 * body.deviation) / (2 * body.radius), 2)}% of its diameter), measured at 20,000 points` : ''],
    ['unit', body.mesh ? body.unit || 'not in the file' : ''],
  ];
}

export function makeDetails(run) {
  const speed = run.seconds > 0 && run.rotations.done ? `${shortText(run.rotations.done / run.seconds, 3)} rotations/s` : '';
  const key = (text) => element('kbd', {}, text);
  const figure = ([name, value]) => (name.startsWith('seconds_') ? [`time to ${name.slice(8)}`, `${shortText(value, 3)} s`]
    : name === 'peak_memory_mb' ? ['peak memory', `${shortText(value, 3)} MB`] : [name.replaceAll('_', ' '), shortText(value, 5)]);
  byId('details').append(
    element('div', { class: 'column' },
      facts('Inputs', run.bodies.flatMap(bodyRows)),
      element('div', { class: 'card' }, element('h2', {}, 'Keys and files'),
        element('p', { class: 'prose' }, key('\u2191'), ' ', key('\u2193'), ' or ', key('K'), ' ', key('J'), ' step through the poses, ', key('Page up'), ' ',
          key('Page down'), ' by 20, ', key('Home'), ' ', key('End'), ' to the ends; ', key('R'), ' resets the view. In 3D: drag to turn, scroll to zoom, ',
          key('Ctrl'), ' and drag to shift.'),
        element('p', { class: 'prose' }, 'Beside this page: ', code('poses.csv'), ', ', code('poses.json'), ', ', code('clusters.csv'), ', ', code('clusters.json'),
          run.bodies.every((body) => body.structure || body.mesh) ? ', the best poses in ' : '', run.bodies.every((body) => body.structure || body.mesh) ? code('poses/') : '',
          run.bodies.every((body) => body.structure || body.mesh) ? ', scripts for PyMOL and ChimeraX.' : '.'))),
    facts('Run', [
      ['command', code(run.command)],
      ['directory', code(run.directory)],
      ['version', `Mortise ${run.version}`],
      ['made', `${run.time} on ${run.host}`],
      ['state', run.complete ? 'complete' : 'not finished'],
      ['seed', run.seed],
      ['rotations', `${run.rotations.done.toLocaleString('en')} of ${run.rotations.count.toLocaleString('en')} searched`],
      ['covering radius', run.rotations.covering_radius > 0 ? `${run.rotations.covering_radius.toFixed(2)}\u00b0` : ''],
      ['time', `${shortText(run.seconds, 3)} s${speed ? ` (${speed})` : ''}`],
      ...run.figures.filter(([name]) => name !== 'seconds').map(figure),
    ]),
    facts('Options', Object.entries(run.options).map(([name, value]) => [name.replaceAll('_', ' '), plain(value)])),
  );
  byId('footer').append(`Made by Mortise ${run.page_version}; 3D view by 3Dmol.js. This page loads nothing from the network.`);
}
