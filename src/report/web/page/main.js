// SPDX-License-Identifier: GPL-3.0-or-later
// The ranked-pose page: puts table, view, plots and details together and keeps them on the same pose.
import { makeCards } from './cards.js';
import { countText, loadRun, valueText } from './data.js';
import { makeDetails } from './details.js';
import { byId, element } from './dom.js';
import { makeTable } from './table.js';
import { makeViewer } from './viewer.js';

const PAGE_ROWS = 20;

function stored(value) {
  try {  // some browsers refuse storage to local files
    if (value) localStorage.setItem('mortise-theme', value);
    return localStorage.getItem('mortise-theme');
  } catch {
    return null;
  }
}

function setUpTheme(changed) {
  const system = matchMedia('(prefers-color-scheme: dark)');
  const button = byId('theme');
  const apply = (name) => {
    document.documentElement.dataset.theme = name;
    button.textContent = name === 'dark' ? 'Light' : 'Dark';
    changed();
  };
  let chosen = stored();
  const inForce = () => chosen ?? (system.matches ? 'dark' : 'light');
  apply(inForce());
  system.addEventListener('change', () => apply(inForce()));
  button.addEventListener('click', () => {
    chosen = inForce() === 'dark' ? 'light' : 'dark';
    stored(chosen);
    apply(chosen);
  });
}

function showHead(run) {
  const [fixed, moving] = run.bodies;
  document.title = `${run.title} \u2013 Mortise`;
  byId('title').append(element('span', { class: 'name-fixed' }, fixed.name), element('span', { class: 'join' }, ' + '), element('span', { class: 'name-moving' }, moving.name));
  const what = run.kind === 'mate' ? 'Mating of parts' : 'Docking of molecules';
  byId('subtitle').textContent = [what, countText(run.count, 'pose'), `${run.rotations.done.toLocaleString('en')} rotations`,
    `${Number(run.seconds.toPrecision(3))} s`, run.time.slice(0, 10)].join(' \u00b7 ');
  for (const text of run.notices) byId('notices').append(element('p', { class: 'notice' }, text));
}

function showPose(run, pose) {
  byId('viewer-title').textContent = `Pose ${pose + 1}`;
  const chips = run.columns.filter((c) => ['score', 'interface_rmsd', 'ligand_rmsd', 'dockq', 'sc', 'contact_area', 'penetration_depth', 'placement_largest'].includes(c.key))
    .map((c) => element('span', {}, `${c.label} `, element('b', {}, valueText(c, pose)), c.unit && valueText(c, pose) !== '\u2013' ? ` ${c.unit}` : ''));
  const { capri } = run.column;
  if (capri && capri.values[pose] >= 0) chips.push(element('span', { class: `class class-${valueText(capri, pose)}` }, valueText(capri, pose)));
  byId('pose-chips').replaceChildren(...chips);
}

async function start() {
  let refresh = () => {};
  setUpTheme(() => refresh());
  const run = await loadRun();
  showHead(run);
  makeDetails(run);
  let viewer = null;
  const state = { pose: -1, select };
  const table = makeTable(run, select);
  let cards = { repaint() {} };

  function select(pose) {
    if (pose === state.pose || pose < 0 || pose >= run.count) return;
    state.pose = pose;
    showPose(run, pose);
    table.show(pose);
    viewer?.show(pose);
    cards.repaint();
  }

  addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest('select, input')) return;
    const steps = { ArrowDown: 1, j: 1, ArrowUp: -1, k: -1, PageDown: PAGE_ROWS, PageUp: -PAGE_ROWS, Home: -Infinity, End: Infinity };
    const steer = event.key.startsWith('Arrow') || event.key.length > 1;  // these scroll the page unless the table or the view has the focus
    if (event.key in steps && (!steer || event.target.closest('#poses, #viewer') || event.target === document.body)) {
      table.step(steps[event.key]);
      event.preventDefault();
    } else if (event.key === 'r') {
      viewer?.home();
    }
  });
  byId('previous').addEventListener('click', () => table.step(-1));
  byId('next').addEventListener('click', () => table.step(1));
  byId('previous').disabled = byId('next').disabled = run.count === 0;

  if (run.count > 0) select(0);
  document.documentElement.dataset.ready = 'table';
  // One frame with table and text before the 3D view is built.
  await new Promise((resolve) => { requestAnimationFrame(() => setTimeout(resolve)); });
  viewer = await makeViewer(run);
  cards = makeCards(run, state, viewer);
  if (run.count > 0) viewer?.show(state.pose);
  refresh = () => {
    viewer?.theme();
    cards.repaint();
  };
  viewer?.onContacts(() => cards.repaint());
  // The plots paint in the next frame, when their sizes are known.
  await new Promise((resolve) => { requestAnimationFrame(() => requestAnimationFrame(resolve)); });
  document.documentElement.dataset.ready = 'all';
  globalThis.mortise = { run, state, viewer };  // for the browser's console
}

start().catch((error) => {
  byId('notices').append(element('p', { class: 'notice' }, `This page could not be shown: ${error.message}`));
  throw error;
});
