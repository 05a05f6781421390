// SPDX-License-Identifier: GPL-3.0-or-later
// The ranked table: sorted by any column, filtered, and drawn only where it can be seen.
import { countText, lengthUnit, shortText, valueText } from './data.js';
import { byId, choice, element } from './dom.js';

const ROW_HEIGHT = 28;
const SPARE_ROWS = 8;

/** The best-ranked pose of each cluster. */
function representatives(run) {
  const first = new Map();
  run.column.cluster?.values.forEach((c, i) => {
    if (c >= 0 && !first.has(c)) first.set(c, i);
  });
  return new Set(first.values());
}

/** "44 clusters of \u2265 3, i-RMSD < 3 \u00c5". */
function clusterText(run) {
  const { measure, radius, min_size: least, count } = run.clusters;
  if (!count && least <= 1) return '';
  const what = measure === 'interface' ? 'i-RMSD' : run.kind === 'mate' ? 'RMSD' : 'L-RMSD';
  const rule = measure === 'run' ? '' : `, ${what} < ${shortText(radius, 2)} ${lengthUnit(run)}`.trimEnd();
  return `${countText(count, 'cluster')}${least > 1 ? ` of \u2265 ${least}` : ''}${rule}`;
}

/** Filters that make sense for this run: name, label, and which poses stay. */
function filters(run) {
  const list = [['all', 'all poses', () => true]];
  const { cluster, cluster_size: size, capri } = run.column;
  if (cluster && size && size.high > 1) {
    const first = new Set();
    const founders = new Uint8Array(run.count);
    cluster.values.forEach((c, i) => {
      if (c < 0 || first.has(c)) return;
      first.add(c);
      founders[i] = 1;
    });
    list.push(['founders', 'cluster representatives', (i) => founders[i] === 1]);
    list.push(['members', 'cluster of the chosen pose', (i, chosen) => i === chosen || (cluster.values[i] >= 0 && cluster.values[i] === cluster.values[chosen])]);
  }
  if (capri) {
    list.push(['acceptable', 'acceptable or better', (i) => capri.values[i] >= 1]);
    list.push(['medium', 'medium or better', (i) => capri.values[i] >= 2]);
  }
  return list;
}

export function makeTable(run, select) {
  const scroller = byId('table-scroll');
  const founders = representatives(run);
  byId('clusters').textContent = clusterText(run);
  byId('clusters').title = `${clusterText(run)}\n` + 'Clusters are numbered by the rank of their representative, their best-ranked pose, which stands in bold.';
  const choices = filters(run);
  let filter = choices[0];
  let sorted = { column: run.columns[0], descending: false };
  let order = new Uint32Array(0);      // pose indices in the table's order
  let place = new Int32Array(run.count);  // of each pose in the table; -1 = filtered away
  let selected = -1;

  if (run.count === 0) {
    const why = run.complete ? 'The search found no poses.' : 'No poses yet: the search is not finished.';
    scroller.append(element('p', { class: 'empty' }, why));
    byId('filter').closest('.field').hidden = true;
    return { show() {}, step() {}, order: () => order };
  }

  const body = element('tbody');
  const heads = run.columns.map((c) => element('th', { scope: 'col', 'aria-sort': 'none' },
    element('button', { type: 'button', title: c.about, onclick: () => sortBy(c) },
      element('span', { class: 'arrow', 'aria-hidden': 'true' }), c.label, c.unit ? element('span', { class: 'unit' }, ` ${c.unit}`) : null)));
  const table = element('table', { 'aria-label': 'Ranked poses', 'aria-colcount': run.columns.length },
    element('thead', {}, element('tr', { 'aria-rowindex': 1 }, ...heads)), body);
  scroller.append(table);

  function sortBy(c) {
    const first = c.good === 'high';  // a first click puts the best on top
    sorted = sorted.column === c ? { column: c, descending: !sorted.descending } : { column: c, descending: first };
    arrange();
  }

  function arrange() {
    const { column, descending } = sorted;
    const kept = [];
    for (let i = 0; i < run.count; ++i) if (filter[2](i, selected)) kept.push(i);
    const sign = descending ? -1 : 1;
    const values = column.values;
    // Absent values come last either way; ties keep the ranking.
    kept.sort((a, b) => {
      const x = values[a];
      const y = values[b];
      if (x === y) return a - b;
      if (Number.isNaN(x)) return Number.isNaN(y) ? a - b : 1;
      if (Number.isNaN(y)) return -1;
      return sign * (x - y);
    });
    order = Uint32Array.from(kept);
    place = new Int32Array(run.count).fill(-1);
    order.forEach((pose, row) => { place[pose] = row; });
    heads.forEach((head, k) => {
      const here = run.columns[k] === column;
      head.setAttribute('aria-sort', here ? (descending ? 'descending' : 'ascending') : 'none');
      head.querySelector('.arrow').textContent = here ? (descending ? '\u25bc' : '\u25b2') : '';
    });
    table.setAttribute('aria-rowcount', order.length + 1);
    byId('count').textContent = order.length === run.count ? countText(run.count, 'pose')
      : `${order.length.toLocaleString('en')} of ${countText(run.count, 'pose')}`;
    drawn = [-1, -1];
    scroller.scrollTop = 0;
    draw();
  }

  function cell(c, pose) {
    const text = valueText(c, pose);
    if (text === '\u2013') return element('td', { class: 'absent' }, text);
    if (c.classes) return element('td', {}, element('span', { class: `class class-${text}` }, text));
    const td = element('td', {}, text);
    if (c.key === 'cluster' && founders.has(pose)) {
      td.className = 'founder';
      td.title = 'Representative: the best-ranked pose of its cluster';
    }
    if (c.key === 'score' && c.high > c.low) {
      td.className = 'bar';
      td.style.setProperty('--share', `${(100 * (c.values[pose] - Math.min(0, c.low))) / (c.high - Math.min(0, c.low))}%`);
    }
    return td;
  }

  let drawn = [-1, -1];
  function draw() {
    const first = Math.max(0, Math.floor(scroller.scrollTop / ROW_HEIGHT) - SPARE_ROWS);
    const last = Math.min(order.length, Math.ceil((scroller.scrollTop + scroller.clientHeight) / ROW_HEIGHT) + SPARE_ROWS);
    if (first === drawn[0] && last === drawn[1]) return;
    drawn = [first, last];
    const pad = (rows) => {
      const tr = element('tr', { class: 'pad', 'aria-hidden': 'true' }, element('td', { colspan: run.columns.length }));
      tr.style.height = `${rows * ROW_HEIGHT}px`;
      return tr;
    };
    const rows = [];
    for (let row = first; row < last; ++row) {
      const pose = order[row];
      rows.push(element('tr', { class: 'row', 'data-pose': pose, 'aria-rowindex': row + 2, 'aria-current': pose === selected ? 'true' : 'false' },
        ...run.columns.map((c) => cell(c, pose))));
    }
    body.replaceChildren(pad(first), ...rows, pad(order.length - last));
  }

  function show(pose) {
    selected = pose;
    for (const row of body.querySelectorAll('tr.row')) row.setAttribute('aria-current', String(Number(row.dataset.pose) === pose));
    const row = place[pose];
    if (row < 0) return;
    const head = 34;
    const top = row * ROW_HEIGHT;
    if (top < scroller.scrollTop) scroller.scrollTop = top;
    else if (top + ROW_HEIGHT > scroller.scrollTop + scroller.clientHeight - head) scroller.scrollTop = top + ROW_HEIGHT + head - scroller.clientHeight;
    draw();
  }

  /** Goes so many rows up or down in the table's order. */
  function step(rows) {
    if (order.length === 0) return;
    const from = place[selected] ?? -1;
    select(order[from < 0 ? 0 : Math.max(0, Math.min(order.length - 1, from + rows))]);
  }

  // A shade at the right edge says that there are more columns.
  const edge = () => scroller.parentElement.classList.toggle('more', scroller.scrollLeft + scroller.clientWidth < scroller.scrollWidth - 4);
  scroller.addEventListener('scroll', () => {
    draw();
    edge();
  }, { passive: true });
  new ResizeObserver(() => {
    draw();
    edge();
  }).observe(scroller);
  body.addEventListener('click', (event) => {
    const row = event.target.closest('tr.row');
    if (row) select(Number(row.dataset.pose));
  });
  const widest = choices.map(([key, label]) => [key, label]);
  byId('filter').replaceWith(choice('Which poses to show', widest, 'all', (key) => {
    filter = choices.find((c) => c[0] === key);
    arrange();
    if (selected >= 0) show(selected);
  }, { id: 'filter' }));
  byId('filter').closest('.field').hidden = choices.length < 2;
  arrange();
  return { show, step, order: () => order };
}
