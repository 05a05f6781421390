// SPDX-License-Identifier: GPL-3.0-or-later
// The run that is stored in the page: unpacking it, its columns and how their numbers read.

/** What the known columns mean; a column of another name is shown under that name. */
const KNOWN = {
  rank: { label: 'Rank', digits: 0, about: 'Place in the ranking by score' },
  score: { label: 'Score', digits: 2, good: 'high', about: 'What the poses are ranked by; higher is better' },
  cluster: { label: 'Cluster', digits: 0, about: 'Clusters are numbered by the rank of their best pose' },
  cluster_size: { label: 'Size', digits: 0, good: 'high', about: 'Poses in the same cluster' },
  interface_area: { label: 'Interface', unit: '\u00c5\u00b2', digits: 0, good: 'high', about: 'Interface area: half of the buried area' },
  buried_area: { label: 'Buried', unit: '\u00c5\u00b2', digits: 0, good: 'high', about: 'Solvent-accessible area that both bodies lose together' },
  contacts: { label: 'Contacts', digits: 0, good: 'high', about: 'Residue pairs in contact' },
  hydrogen_bonds: { label: 'H bonds', digits: 0, good: 'high', about: 'Hydrogen bonds across the interface' },
  clashes: { label: 'Clashes', digits: 0, good: 'low', about: 'Atom pairs that come too close' },
  sc: { label: 'Sc', digits: 2, good: 'high', about: 'Shape complementarity of Lawrence and Colman' },
  interface_rmsd: { label: 'i-RMSD', unit: '\u00c5', digits: 2, good: 'low', about: 'RMSD of the interface residues\u2019 backbone from the reference complex' },
  ligand_rmsd: { label: 'L-RMSD', unit: '\u00c5', digits: 2, good: 'low', about: 'RMSD of the ligand\u2019s backbone from the reference complex, receptors superposed' },
  fnat: { label: 'fnat', digits: 2, good: 'high', about: 'Fraction of the reference\u2019s residue contacts that the pose has' },
  fnonnat: { label: 'fnonnat', digits: 2, good: 'low', about: 'Fraction of the pose\u2019s residue contacts that the reference has not' },
  dockq: { label: 'DockQ', digits: 3, good: 'high', about: 'DockQ, from 0 to 1' },
  capri: { label: 'CAPRI', digits: 0, good: 'high', classes: ['incorrect', 'acceptable', 'medium', 'high'], about: 'CAPRI quality class' },
  shape: { label: 'Shape', score: true, about: 'Shape complementarity, a part of the score' },
  contact: { label: 'Contact', score: true, about: 'Contacts between the bodies, a part of the score' },
  penetration: { label: 'Penetration', score: true, about: 'What overlaps, a part of the score' },
  clearance: { label: 'Clearance', power: 1, about: 'Gap between the parts that the pose was searched and judged with' },
  contact_area: { label: 'Contact area', power: 2, good: 'high', about: 'Area over which the parts touch' },
  penetration_volume: { label: 'Overlap', power: 3, good: 'low', about: 'Volume that both parts would fill' },
  penetration_depth: { label: 'Depth', power: 1, good: 'low', about: 'How deep one part reaches into the other at most' },
  pull_blocked: { label: 'Held', unit: '%', scale: 100, digits: 0, good: 'low', about: 'Share of the contact that stands against pulling the part out: 0 = it comes free' },
  placement_largest: { label: 'Error', unit: '%', scale: 100, digits: 2, good: 'low', about: 'Largest distance of a point of the part from its true place, in percent of the part\u2019s diameter' },
  placement_rms: { label: 'RMS error', unit: '%', scale: 100, digits: 2, good: 'low', about: 'RMS distance of the part\u2019s points from their true places, in percent of the part\u2019s diameter' },
};

/** Columns measured against a reference, of which one makes the funnel's axis. */
export const REFERENCE_COLUMNS = ['interface_rmsd', 'ligand_rmsd', 'placement_largest', 'placement_rms', 'dockq', 'fnat'];

const fromBase64 = (text) => {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
};

async function unpack(text) {
  const stream = new Blob([fromBase64(text)]).stream().pipeThrough(new DecompressionStream('gzip'));
  return JSON.parse(await new Response(stream).text());
}

const SUPERSCRIPT = ['', '', '\u00b2', '\u00b3'];
const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);

/** The run's unit of length, as it is written; 'units' where the files name none. */
export const lengthUnit = (run) => (run.bodies[0].unit === 'angstrom' ? '\u00c5' : run.bodies[0].unit || '');

export const powerUnit = (unit, power) => (unit ? unit + SUPERSCRIPT[power] : '');

function column(key, values, sharedDigits, length) {
  const known = KNOWN[key] ?? {};
  const scale = known.scale ?? 1;
  const numbers = Float64Array.from(values, (value) => (value === null ? NaN : scale * value));
  let low = Infinity;
  let high = -Infinity;
  let whole = true;
  for (const value of numbers) {
    if (!(Math.abs(value) < Infinity)) continue;
    if (value < low) low = value;
    if (value > high) high = value;
    if (whole && value !== Math.round(value)) whole = false;
  }
  // Scores and channels share one scale, so that they can be compared digit by digit. What has the files' unit of
  // length, which may be any, shows four digits of the largest value.
  const largest = Math.max(Math.abs(low), Math.abs(high));
  const four = largest > 0 && largest < Infinity ? Math.max(0, Math.min(6, 3 - Math.floor(Math.log10(largest)))) : 0;
  const digits = known.power ? four : KNOWN[key] && !known.score && key !== 'score' ? known.digits : sharedDigits ?? (whole ? 0 : 3);
  return { key, label: known.label ?? capital(key.replaceAll('_', ' ')), unit: known.power ? powerUnit(length, known.power) : known.unit,
           about: known.about ?? key.replaceAll('_', ' '), good: known.good, classes: known.classes, digits, values: numbers, low, high };
}

/** Reads the run out of the page. */
export async function loadRun() {
  const holder = document.getElementById('data');
  const run = await unpack(holder.textContent.trim());
  holder.remove();  // one copy of many megabytes is enough
  run.count = run.poses.count;
  run.rotation = Float64Array.from(run.poses.rotation);
  run.translation = Float64Array.from(run.poses.translation);
  delete run.poses;
  const ranks = Float64Array.from({ length: run.count }, (_, i) => i + 1);
  const largest = run.columns.filter((c) => c.group === 'score').reduce((most, c) => c.values.reduce((a, v) => Math.max(a, Math.abs(v ?? 0)), most), 0);
  const scoreDigits = largest >= 1000 ? 0 : largest >= 100 ? 1 : largest >= 10 ? 2 : 3;
  run.columns = [column('rank', ranks), ...run.columns.map((c) => ({
    ...column(c.key, c.values, c.group === 'score' ? scoreDigits : undefined, lengthUnit(run)), group: c.group }))];
  // The way out of a mated part is one direction, not three columns; the exploded view follows it.
  const pull = ['pull_x', 'pull_y', 'pull_z'].map((key) => run.columns.find((c) => c.key === key)?.values);
  if (pull.every(Boolean)) {
    run.pull = Array.from({ length: run.count }, (_, i) => {
      const way = pull.map((values) => values[i]);
      return Math.hypot(...way) > 0.5 ? way : undefined;  // NaN and the zero vector: none
    });
    run.columns = run.columns.filter((c) => !c.key.startsWith('pull_') || c.key === 'pull_blocked');
  }
  run.column = Object.fromEntries(run.columns.map((c) => [c.key, c]));
  for (const body of run.bodies) {
    if (!body.mesh) continue;
    body.mesh.vertices = new Float32Array(fromBase64(body.mesh.vertices).buffer);
    body.mesh.triangles = new Uint32Array(fromBase64(body.mesh.triangles).buffer);
  }
  return run;
}

/** One value of a column as text. */
export function valueText(c, index) {
  const value = c.values[index];
  if (Number.isNaN(value)) return '\u2013';
  if (c.classes) return c.classes[value] ?? String(value);
  if (c.key === 'cluster') return value < 0 ? '\u2013' : String(value + 1);
  return numberText(value, c.digits);
}

export function numberText(value, digits) {
  if (!Number.isFinite(value)) return String(value);
  if (value !== 0 && Math.abs(value) >= 1e7) return value.toExponential(2);
  return value.toFixed(digits).replace('-', '\u2212');
}

/** A measured number of unknown size, to so many significant digits. */
export const shortText = (value, digits = 4) => (Number.isInteger(value) ? value.toLocaleString('en')
  : Math.abs(value) >= 1e6 || (value !== 0 && Math.abs(value) < 1e-3) ? value.toExponential(2) : String(Number(value.toPrecision(digits))));

export const countText = (count, one, many = `${one}s`) => `${count.toLocaleString('en')} ${count === 1 ? one : many}`;
