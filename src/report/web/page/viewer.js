// SPDX-License-Identifier: GPL-3.0-or-later
// The 3D view of one pose: molecules as surface and cartoon, parts as meshes.
import { BODY, CONTACT_3D, OVERLAP, css, hex, isDark, mix, ramp, rampCss } from './colors.js';
import { byId, checkbox, choice, element, slider, themeColor } from './dom.js';
import { Cells, motion, moved } from './geometry.js';
import { showMesh } from './mesh.js';
import { makePartContact } from './part_contact.js';

export const INTERFACE_CUTOFF = 5;  // angstrom between heavy atoms

const isPolymer = (atom) => !atom.hetflag;
const residueKey = (atom) => `${atom.chain}\u0000${atom.resi}\u0000${atom.icode ?? ''}\u0000${atom.resn}`;

/** Residues of a model in file order, with names and the number of each atom's residue. */
function residuesOf(atoms) {
  const names = [];
  const of = new Int32Array(atoms.length);
  let last = null;
  atoms.forEach((atom, i) => {
    const key = residueKey(atom);
    if (key !== last) names.push({ chain: atom.chain?.trim() || '\u2013', text: `${atom.resn}${atom.resi}${(atom.icode ?? '').trim()}`, number: `${atom.resi}${(atom.icode ?? '').trim()}` });
    last = key;
    of[i] = names.length - 1;
  });
  return { names, of };
}

function molecule(viewer, structure) {
  const model = viewer.addModel(structure.text, structure.format, { keepH: true, doAssembly: false, assignBonds: true });
  const atoms = model.selectedAtoms({});
  const input = new Float32Array(3 * atoms.length);
  atoms.forEach((atom, i) => input.set([atom.x, atom.y, atom.z], 3 * i));
  const backbone = atoms.filter((a) => isPolymer(a) && (a.atom === 'CA' || a.atom === 'P')).length;
  return { model, atoms, input, at: input, hasTrace: backbone > 3, ...residuesOf(atoms) };
}

export async function makeViewer(run) {
  const stage = byId('stage');
  const message = byId('stage-message');
  const [fixedBody, movingBody] = run.bodies;
  const hasStructures = run.bodies.every((body) => body.structure || body.mesh);
  if (!hasStructures) {
    message.textContent = 'Without structures: an input file was not found when this page was made. The numbers and plots need none.';
    return null;
  }
  let viewer;
  try {
    viewer = globalThis.$3Dmol.createViewer(stage, { backgroundColor: themeColor('stage'), antialias: true, cartoonQuality: 6, disableFog: true });
  } catch {
    viewer = null;
  }
  if (!viewer) {
    message.textContent = 'This browser offers no WebGL, which the 3D view needs. Table and plots work without it.';
    return null;
  }
  const canvas = viewer.getCanvas();
  canvas.setAttribute('role', 'img');
  canvas.setAttribute('aria-label', '3D view of the chosen pose');

  const isMesh = Boolean(fixedBody.mesh);
  const options = { seeThrough: isMesh ? 40 : 15, exploded: 0, fixedStyle: 'surface', colour: 'plain', residues: !isMesh, labels: false, wayOut: true };
  let current = -1;
  let shown = null;  // { fixed: Set of atom indices, moving: Set } of the interface
  let contacts = [];
  const listeners = [];

  const fixed = isMesh ? null : molecule(viewer, fixedBody.structure);
  const moving = isMesh ? null : molecule(viewer, movingBody.structure);
  const cells = fixed ? new Cells(fixed.input, INTERFACE_CUTOFF) : null;
  let surface = null;
  let surfaceBusy = null;
  const frequency = run.frequency ?? [];
  const most = frequency.reduce((a, b) => Math.max(a, b), 0);
  const share = (index) => (most > 0 ? (frequency[index] ?? 0) / most : 0);

  // The surface follows the fixed body's atoms, so it is made once; colour and opacity change its material.
  // No atom may change while 3Dmol's workers read them.
  const surfaceStyle = () => ({
    opacity: 1 - options.seeThrough / 100,
    ...(options.colour === 'density'
      ? { colorfunc: (atom) => hex(ramp(share(fixed.of[atom.index]), false)) }
      : { color: BODY.fixed }),
  });
  async function updateSurface() {
    if (isMesh) return;
    if (options.fixedStyle !== 'surface') {
      if (surface !== null) viewer.removeSurface(surface);
      surface = null;
      return;
    }
    if (surface === null) {
      surfaceBusy ??= viewer.addSurface(fixed.atoms.length > 30000 ? 'VDW' : 'SES', surfaceStyle(), { model: fixed.model });
      surface = await surfaceBusy;
      surfaceBusy = null;
      if (options.fixedStyle !== 'surface') return updateSurface();
    }
    viewer.setSurfaceMaterialStyle(surface, surfaceStyle());
  }

  function explodedShift() {
    if (!options.exploded || current < 0) return [0, 0, 0];
    const at = moved(motion(run, current), movingBody.center);
    const away = run.pull?.[current] ?? [0, 1, 2].map((k) => at[k] - fixedBody.center[k]);
    const length = Math.hypot(...away) || 1;
    const reach = (options.exploded / 100) * 1.2 * (movingBody.radius + 0.3 * fixedBody.radius);
    return away.map((x) => (x / length) * reach);
  }

  function measureContacts() {
    const at = moved(motion(run, current), moving.input);  // not exploded
    const nearest = new Map();
    const near = { fixed: new Set(), moving: new Set() };
    for (let i = 0; i < moving.atoms.length; ++i) {
      cells.near(at[3 * i], at[3 * i + 1], at[3 * i + 2], (j, d) => {
        near.fixed.add(fixed.of[j]);
        near.moving.add(moving.of[i]);
        const pair = fixed.of[j] * 1e6 + moving.of[i];
        if (d < (nearest.get(pair) ?? Infinity)) nearest.set(pair, d);
      });
    }
    shown = near;
    contacts = [...nearest].map(([pair, d]) => ({ fixed: Math.floor(pair / 1e6), moving: pair % 1e6, distance: Math.sqrt(d) }));
  }

  function styleMolecules() {
    const trace = (body, colour) => (body.hasTrace ? { cartoon: { color: colour, thickness: 0.5 } } : { stick: { color: colour, radius: 0.18 } });
    const hetero = (colour) => ({ stick: { radius: 0.2, colorscheme: { prop: 'elem', map: { ...$3Dmol.elementColors.rasmol, C: colour } } }, sphere: { scale: 0.22, colorscheme: { prop: 'elem', map: { ...$3Dmol.elementColors.rasmol, C: colour } } } });
    for (const [body, colour, deep, name] of [[fixed, BODY.fixed, BODY.fixedDeep, 'fixed'], [moving, BODY.moving, BODY.movingDeep, 'moving']]) {
      body.model.setStyle({}, trace(body, name === 'fixed' ? deep : colour));
      if (body.hasTrace) body.model.setStyle({ hetflag: true }, hetero(deep));
      if (options.residues && shown)
        body.model.setStyle({ predicate: (atom) => isPolymer(atom) && shown[name].has(body.of[atom.index]) },
          { stick: { radius: 0.13, colorscheme: { prop: 'elem', map: { ...$3Dmol.elementColors.rasmol, C: deep } } } }, true);
    }
    viewer.removeAllLabels();
    if (options.labels && shown) {
      const style = { fontSize: 11, fontColor: isDark() ? 'white' : 'black', backgroundColor: isDark() ? 'black' : 'white', backgroundOpacity: 0.6, inFront: true };
      for (const [body, name] of [[fixed, 'fixed'], [moving, 'moving']]) {
        const labelled = new Set();
        for (const atom of body.atoms) {
          const residue = body.of[atom.index];
          if (!shown[name].has(residue) || labelled.has(residue) || (atom.atom !== 'CA' && atom.atom !== 'P')) continue;
          labelled.add(residue);
          viewer.addLabel(`${body.names[residue].chain}:${body.names[residue].text}`, { ...style, position: { x: atom.x, y: atom.y, z: atom.z } });
        }
      }
    }
  }

  const partContact = isMesh ? makePartContact(run) : null;
  let faceContacts = { pairs: [], contact: 0, overlap: 0 };
  let pair = null;  // of faces

  // Along the way out, from just beyond the moving part.
  function wayOut() {
    const pull = run.pull?.[current];
    if (!options.wayOut || !pull) return null;
    const at = moved(motion(run, current, explodedShift()), movingBody.mesh.vertices);
    const centre = moved(motion(run, current, explodedShift()), movingBody.center);
    let far = -Infinity;
    for (let i = 0; i < at.length; i += 3) {
      const along = (at[i] - centre[0]) * pull[0] + (at[i + 1] - centre[1]) * pull[1] + (at[i + 2] - centre[2]) * pull[2];
      if (along > far) far = along;
    }
    const point = (distance) => pull.map((x, k) => centre[k] + distance * x);
    return { from: point(far + 0.04 * movingBody.radius), to: point(far + 0.5 * movingBody.radius) };
  }

  /** What is coloured on the fixed part: how often poses touch it, or where this one does, of one pair of faces or all. */
  function partColours() {
    if (options.colour === 'density') {
      const table = Array.from(frequency, (_, i) => ramp(share(i), false));
      return { colours: (v) => table[v] };
    }
    if (options.colour !== 'contact' || current < 0) return {};
    const { gaps, touching } = faceContacts;
    const { tolerance, reach, faces } = partContact;
    const triangles = [];
    gaps.forEach((gap, t) => {
      if (pair ? touching[t] && faces[0].of[t] === pair.fixed && faceContacts.partner[t] === pair.moving : !Number.isNaN(gap)) triangles.push(t);
    });
    const near = (gap) => 0.65 * (1 - (Math.abs(gap) - tolerance) / (reach - tolerance));
    return { patch: { triangles, colour: (t) => (touching[t] === 2 ? OVERLAP : touching[t] ? CONTACT_3D[1] : mix(CONTACT_3D, near(gaps[t]))) } };
  }

  /** Shows where one pair of faces touches; the same pair again, or none: all of them. */
  function showPair(chosen) {
    pair = chosen && !(pair && pair.fixed === chosen.fixed && pair.moving === chosen.moving) ? chosen : null;
    options.colour = 'contact';
    byId('colour').value = 'contact';
    drawLegend();
    redraw();
  }

  const meshes = isMesh ? showMesh(viewer, fixedBody, movingBody, partContact.faces) : null;

  function place() {
    if (isMesh) {
      meshes.draw(current < 0 ? null : motion(run, current, explodedShift()), { opacity: 1 - options.seeThrough / 100, ...partColours(), way: current < 0 ? null : wayOut() });
    } else {
      moved(current < 0 ? [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0] : motion(run, current, explodedShift()), moving.input, moving.at = new Float32Array(moving.input.length));
      moving.atoms.forEach((atom, i) => { [atom.x, atom.y, atom.z] = moving.at.subarray(3 * i, 3 * i + 3); });
      styleMolecules();
    }
    viewer.render();
  }

  let waiting = false;
  function redraw() {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      place();
    });
  }

  function show(pose) {
    const first = current < 0;
    current = pose;
    pair = null;
    if (isMesh) faceContacts = partContact.measure(pose);
    else measureContacts();
    drawLegend();
    if (first) {
      place();
      home();
    } else {
      redraw();
    }
    for (const listener of listeners) listener();
  }

  // Molecules: at right angles to the line between the bodies, so that neither hides the other. Parts: obliquely
  // from above, as drawings show them.
  function home() {
    const at = current < 0 ? movingBody.center : [...moved(motion(run, current), movingBody.center)];
    const d = [0, 1, 2].map((k) => at[k] - fixedBody.center[k]);
    const length = Math.hypot(...d) || 1;
    const u = d.map((x) => x / length);
    // The rotation that carries u to (0.94, 0.34, 0), a little above the horizontal.
    const goal = [0.94, 0.342, 0];
    const axis = [u[1] * goal[2] - u[2] * goal[1], u[2] * goal[0] - u[0] * goal[2], u[0] * goal[1] - u[1] * goal[0]];
    const dot = u[0] * goal[0] + u[1] * goal[1] + u[2] * goal[2];
    const w = 1 + dot;
    const norm = Math.hypot(w, ...axis);
    const beside = norm < 1e-6 ? [0, 0, 1, 0] : [axis[0] / norm, axis[1] / norm, axis[2] / norm, w / norm];
    const q = isMesh ? run.view : beside;
    const view = viewer.getView();
    viewer.setView([view[0], view[1], view[2], view[3], ...q]);
    if (isMesh) meshes.zoom();
    else viewer.zoomTo();
    if (!isMesh) viewer.zoom(0.9);
    viewer.render();
  }

  const legend = element('div', { class: 'legend' });
  function drawLegend() {
    const box = (colour) => {
      const made = element('i', { class: 'swatch' });
      made.style.background = colour;
      return made;
    };
    const swatch = (colour, text) => element('div', {}, box(`#${colour.toString(16).padStart(6, '0')}`), element('span', {}, text));
    const rows = [swatch(BODY.fixed, fixedBody.name), swatch(BODY.moving, movingBody.name)];
    if (options.colour === 'density') {
      const bar = element('i', { class: 'ramp' });
      bar.style.background = rampCss(false);
      rows.push(element('div', {}, bar, element('span', {}, `touched by 0 to ${Math.round(100 * most)}% of the best ${run.frequency_poses.toLocaleString('en')} poses`)));
    }
    if (options.colour === 'contact')
      rows.push(element('div', {}, box(css(CONTACT_3D[1])), element('span', {}, pair ? `${partContact.faces[0].names[pair.fixed]} on ${partContact.faces[1].names[pair.moving]}` : 'in contact, paler: near')), element('div', {}, box(css(OVERLAP)), element('span', {}, 'overlapping')));
    if (isMesh && options.wayOut && run.pull?.[current]) {
      const held = run.column.pull_blocked?.values[current];
      rows.push(swatch(BODY.wayOut, Number.isFinite(held) ? `way out, held by ${Math.round(held)}% of the contact` : 'way out'));
    }
    legend.replaceChildren(...rows);
  }
  stage.append(legend);

  function drawControls() {
    const change = (name, after) => (value) => {
      options[name] = value;
      after();
    };
    const surfaceThen = () => updateSurface().then(redraw);
    const hasMap = most > 0;
    const colour = () => {
      pair = null;
      drawLegend();
      surfaceThen();
    };
    const wide = (label, control) => element('label', { class: 'field' }, element('span', {}, label), control);
    byId('controls').replaceChildren(
      isMesh ? '' : wide('Receptor', choice('Receptor shown as', [['surface', 'surface'], ['cartoon', 'cartoon']], options.fixedStyle, change('fixedStyle', surfaceThen), { id: 'fixed-style' })),
      hasMap || isMesh ? wide('Colour', choice('Colour of the fixed body', [['plain', 'by body'], ...(isMesh ? [['contact', 'contact of this pose']] : []), ...(hasMap ? [['density', 'where poses sit']] : [])], options.colour, change('colour', colour), { id: 'colour' })) : '',
      slider('See-through', options.seeThrough, (v) => `${v}%`, change('seeThrough', isMesh ? redraw : surfaceThen), { max: 90, id: 'see-through' }),
      isMesh && run.pull?.some(Boolean) ? checkbox('Way out', options.wayOut, change('wayOut', () => {
        drawLegend();
        redraw();
      }), { id: 'way-out' }) : '',
      slider('Exploded', options.exploded, (v) => `${v}%`, change('exploded', redraw), { id: 'exploded' }),
      isMesh ? '' : checkbox('Interface', options.residues, change('residues', redraw), { id: 'interface' }),
      isMesh ? '' : checkbox('Labels', options.labels, change('labels', redraw)),
      element('span', { class: 'grow' }),
      element('button', { type: 'button', class: 'button', id: 'home', onclick: home }, 'Reset view'),
      element('button', { type: 'button', class: 'button', onclick: save }, 'Save PNG'),
    );
  }

  function save() {
    const link = element('a', { href: viewer.pngURI(), download: `${run.title.replaceAll(/[^\w.-]+/g, '_')}_pose_${current + 1}.png` });
    link.click();
  }

  // The ground is opaque: over a see-through one the browser would blend see-through surfaces twice.
  function theme() {
    viewer.setBackgroundColor(themeColor('stage'), 1);
    drawLegend();
    redraw();  // labels
  }

  new ResizeObserver(() => viewer.resize()).observe(stage);
  drawControls();
  drawLegend();
  place();
  home();
  message.hidden = true;
  // The table and the plots come first; the surface, which takes longest, after them.
  setTimeout(() => updateSurface().then(redraw), 60);

  return {
    show, theme, home, fixed, moving, isMesh, partContact,
    faceContacts: () => faceContacts,
    showPair,
    contacts: () => contacts,
    onContacts: (listener) => listeners.push(listener),
    surfaceReady: () => surface !== null || isMesh,
  };
}
