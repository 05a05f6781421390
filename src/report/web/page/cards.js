// SPDX-License-Identifier: GPL-3.0-or-later
// The four plots: scores, funnel, where the moving body sits, contacts of the chosen pose.
import { CONTACT_RAMP, OVERLAP, css, mix, ramp } from './colors.js';
import { REFERENCE_COLUMNS, countText, lengthUnit, numberText, powerUnit, shortText, valueText } from './data.js';
import { byId, choice, element, themeColor } from './dom.js';
import { directions, fromHammer, hammer } from './geometry.js';
import { axes, makeCard, padded } from './plots.js';

const columnLabel = (c) => (c.unit ? `${c.label} (${c.unit})` : c.label);

const fitting = (text, most) => (text.length > most ? `${text.slice(0, most - 1)}\u2026` : text);

function marker(context, x, y) {
  context.beginPath();
  context.arc(x, y, 5.5, 0, 2 * Math.PI);
  context.fillStyle = themeColor('row-edge');
  context.fill();
  context.lineWidth = 2;
  context.strokeStyle = themeColor('panel');
  context.stroke();
}

function scoreCard(run, state) {
  let column = run.column.score;
  let plot = null;
  let bins = [];
  const numeric = run.columns.filter((c) => c.key !== 'rank' && c.key !== 'cluster' && !c.classes && c.high > c.low);
  const count = () => {
    const wanted = Math.max(8, Math.min(60, Math.round(Math.sqrt(run.count))));
    const width = (column.high - column.low) / wanted || 1;
    bins = Array.from({ length: wanted }, (_, k) => ({ from: column.low + k * width, to: column.low + (k + 1) * width, count: 0, first: -1 }));
    for (let i = 0; i < run.count; ++i) {
      const v = column.values[i];
      if (!Number.isFinite(v)) continue;
      const bin = bins[Math.min(wanted - 1, Math.floor((v - column.low) / width))];
      if (bin.count++ === 0) bin.first = i;
    }
  };
  count();
  const at = (x) => (plot ? bins.find((b) => plot.fromX(x) >= b.from && plot.fromX(x) < b.to) : undefined);
  const card = makeCard(byId('plots'), 'Distribution', {
    controls: [choice('Quantity shown', (numeric.length ? numeric : [column]).map((c) => [c.key, c.label]), column.key, (key) => {
      column = run.column[key];
      count();
      card.repaint();
    })],
    note: 'Poses by value, on a logarithmic scale; the mark is the chosen pose.',
    draw(context, width, height) {
      const most = Math.max(1, ...bins.map((b) => b.count));
      plot = axes(context, width, height, { x: [bins[0].from, bins.at(-1).to], y: [0.7, most * 1.3], logY: true, xLabel: columnLabel(column), yLabel: 'Poses' });
      context.fillStyle = themeColor('fixed');
      for (const b of bins) {
        if (!b.count) continue;
        const x = plot.toX(b.from);
        context.fillRect(x + 0.5, plot.toY(b.count), Math.max(1, plot.toX(b.to) - x - 1), plot.bottom - plot.toY(b.count));
      }
      const value = column.values[state.pose];
      if (Number.isFinite(value)) {
        context.strokeStyle = themeColor('row-edge');
        context.lineWidth = 2;
        context.beginPath();
        context.moveTo(plot.toX(value), plot.top);
        context.lineTo(plot.toX(value), plot.bottom);
        context.stroke();
        marker(context, plot.toX(value), plot.top + 6);
      }
    },
    hover: (x) => {
      const b = at(x);
      return b ? `${numberText(b.from, column.digits)} to ${numberText(b.to, column.digits)}: ${b.count.toLocaleString('en')} poses` : '';
    },
    pick: (x) => {
      const b = at(x);
      if (b && b.first >= 0) state.select(b.first);
    },
    describe: () => `Histogram of ${column.label} over ${run.count} poses, from ${numberText(column.low, column.digits)} to ${numberText(column.high, column.digits)}`,
  });
  return card;
}

function funnelCard(run, state) {
  const usable = REFERENCE_COLUMNS.filter((key) => run.column[key]);
  const others = run.columns.filter((c) => !['rank', 'score', 'cluster'].includes(c.key) && !c.classes && !usable.includes(c.key) && c.high > c.low).map((c) => c.key);
  const keys = [...usable, ...others];
  const score = run.column.score;
  const { capri } = run.column;
  if (keys.length === 0) {
    byId('plots').append(element('figure', { class: 'card' }, element('div', { class: 'card-head' }, element('h2', {}, 'Funnel')),
      element('div', { class: 'none' }, 'Nothing to set the score against. With a known complex, mortise evaluate adds RMSDs, fnat and DockQ.')));
    return { repaint() {} };
  }
  let column = run.column[keys[0]];
  let plot = null;
  const nearest = (x, y) => {
    if (!plot) return -1;
    let best = -1;
    let least = 15 * 15;
    for (let i = 0; i < run.count; ++i) {
      const d = (plot.toX(column.values[i]) - x) ** 2 + (plot.toY(score.values[i]) - y) ** 2;
      if (d < least) {
        least = d;
        best = i;
      }
    }
    return best;
  };
  let layer = null;
  let layerKey = '';
  function paintPoints(width, height, scale, font) {
    layer = new OffscreenCanvas(Math.round(width * scale), Math.round(height * scale));
    const context = layer.getContext('2d');
    context.scale(scale, scale);
    context.font = font;
    plot = axes(context, width, height, { x: usable.includes(column.key) ? [0, column.high * 1.03 || 1] : padded(column.low, column.high), y: padded(score.low, score.high), xLabel: columnLabel(column), yLabel: 'Score' });
    const classes = capri ? ['incorrect', 'acceptable', 'medium', 'high'] : [null];
    const size = run.count > 20000 ? 1.5 : run.count > 2000 ? 2.2 : 2.8;
    context.globalAlpha = run.count > 5000 ? 0.55 : 0.75;
    classes.forEach((name, level) => {
      context.fillStyle = name ? themeColor(name) : themeColor('fixed');
      const larger = level > 0 ? size + 0.8 : size;
      context.beginPath();
      for (let i = run.count - 1; i >= 0; --i) {
        if (capri && (capri.values[i] || 0) !== level) continue;
        const x = plot.toX(column.values[i]);
        const y = plot.toY(score.values[i]);
        if (!Number.isFinite(x)) continue;
        // Classes differ in shape as well as in colour.
        if (level === 1) {
          context.moveTo(x, y - larger - 1);
          context.lineTo(x + larger + 0.6, y + larger);
          context.lineTo(x - larger - 0.6, y + larger);
        } else if (level === 2) {
          context.rect(x - larger, y - larger, 2 * larger, 2 * larger);
        } else if (level === 3) {
          context.moveTo(x, y - larger - 1.6);
          context.lineTo(x + larger + 1.6, y);
          context.lineTo(x, y + larger + 1.6);
          context.lineTo(x - larger - 1.6, y);
        } else if (size < 2) {
          context.rect(x - 0.8, y - 0.8, 1.6, 1.6);
        } else {
          context.moveTo(x + larger, y);
          context.arc(x, y, larger, 0, 2 * Math.PI);
        }
      }
      context.fill();
    });
    context.globalAlpha = 1;
  }
  const title = () => (usable.includes(column.key) ? 'Funnel' : 'Score against');
  const card = makeCard(byId('plots'), title(), {
    controls: [choice('Quantity on the horizontal axis', keys.map((key) => [key, run.column[key].label]), column.key, (key) => {
      column = run.column[key];
      card.repaint();
    })],
    note: 'Click a point to see its pose.',
    draw(target, width, height) {
      // The points are painted once; stepping through the poses moves the marker only.
      const scale = window.devicePixelRatio || 1;
      const key = `${width}x${height}:${scale}:${column.key}:${document.documentElement.dataset.theme}`;
      if (key !== layerKey) paintPoints(width, height, scale, target.font);
      layerKey = key;
      target.drawImage(layer, 0, 0, width, height);
      const x = plot.toX(column.values[state.pose]);
      if (Number.isFinite(x)) marker(target, x, plot.toY(score.values[state.pose]));
    },
    hover: (x, y) => {
      const i = nearest(x, y);
      return i < 0 ? '' : `rank ${i + 1}\n${column.label} ${valueText(column, i)}, score ${valueText(score, i)}`;
    },
    pick: (x, y) => {
      const i = nearest(x, y);
      if (i >= 0) state.select(i);
    },
    describe: () => `Scatter plot of the score against ${column.label} for ${run.count} poses`,
  });
  if (capri) {
    const present = ['high', 'medium', 'acceptable', 'incorrect'].filter((name, k) => capri.values.includes(3 - k));
    card.note(...present.map((name) => {
      const dot = element('i', { class: `swatch shape-${name}` });
      dot.style.background = `var(--${name})`;
      return element('span', { class: 'key' }, dot, name);
    }), element('span', {}, 'Click a point to see its pose.'));
  }
  return card;
}

function sphereCard(run, state) {
  const unit = directions(run);
  const [fixed, moving] = run.bodies;
  let best = Math.min(run.count, 1000);
  let image = null;
  let imageKey = '';
  let frame = null;
  const options = [100, 1000, 10000, run.count].filter((n, k, all) => n <= run.count && all.indexOf(n) === k);

  // Density on the sphere: for each cell of a grid of latitude and longitude, the sum of exp(k (u.v - 1)) over poses.
  // Poses are gathered into cells first, so that 100,000 of them cost no more than a few thousand.
  const ROWS = 36;
  const COLUMNS = 72;
  const SHARPNESS = 60;  // half of the kernel's height at 8.7 degrees
  function density() {
    const bins = new Float32Array(ROWS * COLUMNS);
    for (let p = 0; p < best; ++p) {
      const row = Math.min(ROWS - 1, Math.floor(((1 + unit[3 * p + 2]) / 2) * ROWS));  // equal areas
      const col = Math.min(COLUMNS - 1, Math.floor(((Math.atan2(unit[3 * p + 1], unit[3 * p]) / Math.PI + 1) / 2) * COLUMNS));
      bins[row * COLUMNS + col] += 1;
    }
    const seeds = [];
    bins.forEach((count, k) => {
      if (!count) return;
      const z = (2 * (Math.floor(k / COLUMNS) + 0.5)) / ROWS - 1;
      const a = ((2 * ((k % COLUMNS) + 0.5)) / COLUMNS - 1) * Math.PI;
      const s = Math.sqrt(1 - z * z);
      seeds.push([s * Math.cos(a), s * Math.sin(a), z, count]);
    });
    return ([x, y, z]) => {
      let sum = 0;
      for (const [u, v, w, count] of seeds) {
        const d = u * x + v * y + w * z;
        if (d > 0.85) sum += count * Math.exp(SHARPNESS * (d - 1));
      }
      return sum;
    };
  }

  function paintImage(width, height) {
    const key = `${width}x${height}:${best}:${document.documentElement.dataset.theme}`;
    if (key === imageKey) return;
    imageKey = key;
    const at = density();
    const values = new Float32Array(width * height).fill(-1);
    let most = 0;
    for (let j = 0; j < height; ++j)
      for (let i = 0; i < width; ++i) {
        const v = fromHammer(((i + 0.5) / width - 0.5) * 2 * 2 * Math.SQRT2, (0.5 - (j + 0.5) / height) * 2 * Math.SQRT2);
        if (!v) continue;
        const value = at(v);
        values[j * width + i] = value;
        if (value > most) most = value;
      }
    image = new OffscreenCanvas(width, height);
    const context = image.getContext('2d');
    const pixels = context.createImageData(width, height);
    const table = Array.from({ length: 256 }, (_, k) => ramp(k / 255));
    values.forEach((value, k) => {
      if (value < 0) return;
      const colour = table[Math.round(255 * Math.sqrt(value / (most || 1)))];
      pixels.data.set([...colour, 255], 4 * k);
    });
    context.putImageData(pixels, 0, 0);
  }

  const spot = (p) => {
    const [u, v] = hammer(unit.subarray(3 * p, 3 * p + 3));
    return [frame.x + ((u / (2 * Math.SQRT2) + 1) / 2) * frame.width, frame.y + ((1 - v / Math.SQRT2) / 2) * frame.height];
  };
  const nearest = (x, y) => {
    if (!frame) return -1;
    let found = -1;
    let least = 12 * 12;
    for (let p = Math.min(best, 20000) - 1; p >= 0; --p) {
      const [a, b] = spot(p);
      const d = (a - x) ** 2 + (b - y) ** 2;
      if (d <= least) {
        least = d;
        found = p;
      }
    }
    return found;
  };
  const card = makeCard(byId('plots'), 'Where it sits', {
    controls: options.length > 1 ? [choice('How many poses', options.map((n) => [n, n === run.count ? 'all poses' : `best ${n.toLocaleString('en')}`]), best, (n) => {
      best = Number(n);
      card.repaint();
    })] : [],
    note: `Directions from ${fitting(fixed.name, 24)}\u2019s centre to ${fitting(moving.name, 24)}\u2019s, equal-area map in the input frame; dots: the ten best.`,
    draw(context, width, height) {
      const w = Math.min(width - 36, 2 * (height - 34));
      frame = { x: (width - w) / 2, y: (height - w / 2) / 2, width: w, height: w / 2 };
      paintImage(Math.max(40, Math.round(w / 2)), Math.max(20, Math.round(w / 4)));
      context.save();
      context.beginPath();
      context.ellipse(width / 2, height / 2, w / 2, w / 4, 0, 0, 2 * Math.PI);
      context.clip();
      context.imageSmoothingEnabled = true;
      context.drawImage(image, frame.x, frame.y, frame.width, frame.height);
      context.strokeStyle = themeColor('ink-3');
      context.globalAlpha = 0.25;
      context.lineWidth = 1;
      const line = (points) => {
        context.beginPath();
        points.forEach((v, k) => {
          const [u, t] = hammer(v);
          const at = [frame.x + ((u / (2 * Math.SQRT2) + 1) / 2) * frame.width, frame.y + ((1 - t / Math.SQRT2) / 2) * frame.height];
          if (k) context.lineTo(...at);
          else context.moveTo(...at);
        });
        context.stroke();
      };
      for (const latitude of [-60, -30, 0, 30, 60])
        line(Array.from({ length: 61 }, (_, k) => {
          const [a, b] = [((k * 6 - 180) * Math.PI * 0.9999) / 180, (latitude * Math.PI) / 180];
          return [Math.cos(b) * Math.cos(a), Math.cos(b) * Math.sin(a), Math.sin(b)];
        }));
      for (const longitude of [-120, -60, 0, 60, 120])
        line(Array.from({ length: 31 }, (_, k) => {
          const [a, b] = [(longitude * Math.PI) / 180, ((k * 6 - 90) * Math.PI) / 180];
          return [Math.cos(b) * Math.cos(a), Math.cos(b) * Math.sin(a), Math.sin(b)];
        }));
      context.restore();
      context.strokeStyle = themeColor('line-strong');
      context.lineWidth = 1;
      context.beginPath();
      context.ellipse(width / 2, height / 2, w / 2, w / 4, 0, 0, 2 * Math.PI);
      context.stroke();
      context.fillStyle = themeColor('ink-2');
      context.textAlign = 'center';
      context.textBaseline = 'bottom';
      context.fillText('+z', width / 2, frame.y - 2);
      context.textBaseline = 'top';
      context.fillText('\u2212z', width / 2, frame.y + frame.height + 2);
      context.textBaseline = 'middle';
      context.textAlign = 'right';
      context.fillText('\u2212x', frame.x - 3, height / 2);
      context.textAlign = 'left';
      context.fillText('\u2212x', frame.x + frame.width + 3, height / 2);
      for (let p = Math.min(9, run.count - 1); p >= 0; --p) {
        context.beginPath();
        context.arc(...spot(p), 2.6, 0, 2 * Math.PI);
        context.fillStyle = themeColor('ink');
        context.fill();
        context.strokeStyle = themeColor('panel');
        context.lineWidth = 1;
        context.stroke();
      }
      if (state.pose >= 0) marker(context, ...spot(state.pose));
    },
    hover: (x, y) => {
      const p = nearest(x, y);
      return p < 0 ? '' : `rank ${p + 1}, score ${valueText(run.column.score, p)}`;
    },
    pick: (x, y) => {
      const p = nearest(x, y);
      if (p >= 0) state.select(p);
    },
    describe: () => `Map of the directions in which the moving body lies, over the best ${best} poses`,
  });
  return card;
}

// Faces of one part against faces of the other, those that touch or overlap: what residues are to molecules.
function faceCard(run, state, viewer) {
  const { faces, tolerance } = viewer.partContact;
  const unit = lengthUnit(run);
  const MOST = 12;  // faces on an axis that names have room for
  let cells = [];
  const area = (value) => `${shortText(value, 3)} ${powerUnit(unit, 2)}`.trimEnd();
  const card = makeCard(byId('plots'), 'Faces in contact', {
    note: '',
    draw(context, width, height) {
      const { pairs, contact, overlap } = viewer.faceContacts();
      const shown = pairs.slice(0, 60);
      const axis = (key, names) => [...new Set(shown.map((p) => p[key]))].sort((a, b) => a - b).map((face) => ({ face, name: names[face] }));
      const rows = axis('fixed', faces[0].names);
      const columns = axis('moving', faces[1].names);
      const left = 66;
      const bottom = height - 52;
      const right = width - 8;
      const top = 6;
      const w = (right - left) / Math.max(1, columns.length);
      const h = (bottom - top) / Math.max(1, rows.length);
      const most = Math.max(...shown.map((p) => p.contact), 1e-300);
      cells = shown.map((p) => ({ ...p, x: left + w * columns.findIndex((c) => c.face === p.moving), y: top + h * rows.findIndex((r) => r.face === p.fixed), w, h }));
      context.fillStyle = themeColor('sunken');
      context.fillRect(left, top, right - left, bottom - top);
      for (const c of cells) {
        context.fillStyle = css(mix(CONTACT_RAMP(), Math.sqrt(c.contact / most)));
        context.fillRect(c.x + 0.5, c.y + 0.5, c.w - 1, c.h - 1);
        if (c.overlap > 0) {  // a corner in the colour of overlap
          const side = Math.min(10, 0.5 * c.w, 0.6 * c.h);
          context.fillStyle = css(OVERLAP);
          context.beginPath();
          context.moveTo(c.x + c.w - 1, c.y + 1);
          context.lineTo(c.x + c.w - 1 - side, c.y + 1);
          context.lineTo(c.x + c.w - 1, c.y + 1 + side);
          context.fill();
        }
      }
      context.strokeStyle = themeColor('line');
      context.strokeRect(left + 0.5, top + 0.5, right - left - 1, bottom - top - 1);
      context.fillStyle = themeColor('ink-3');
      context.textBaseline = 'middle';
      context.textAlign = 'right';
      const every = (list) => Math.ceil(list.length / MOST);
      rows.forEach((r, k) => { if (k % every(rows) === 0) context.fillText(r.name, left - 5, top + h * (k + 0.5)); });
      columns.forEach((c, k) => {
        if (k % every(columns)) return;
        const x = left + w * (k + 0.5);
        if (w > 58) {
          context.textAlign = 'center';
          context.fillText(c.name, x, bottom + 10);
          return;
        }
        context.save();
        context.translate(x, bottom + 5);
        context.rotate(-0.6);
        context.textAlign = 'right';
        context.fillText(c.name, 0, 4);
        context.restore();
      });
      context.fillStyle = themeColor('ink-2');
      context.textAlign = 'center';
      context.textBaseline = 'bottom';
      context.fillText(fitting(run.bodies[1].name, 30), (left + right) / 2, height);
      context.save();
      context.translate(7, (top + bottom) / 2);
      context.rotate(-Math.PI / 2);
      context.textBaseline = 'middle';
      context.fillText(fitting(run.bodies[0].name, 30), 0, 0);
      context.restore();
      card.note(...(pairs.length ? [
        swatch(css(mix(CONTACT_RAMP(), 1)), `in contact: ${area(contact)}`),
        ...(overlap > 0 ? [swatch(css(OVERLAP), `overlapping: ${area(overlap)}`)] : []),
        element('span', {}, `${countText(pairs.length, 'pair')} of faces within ${shortText(tolerance, 2)} ${unit}`.trimEnd() + ', numbered by size; click one to see it.'),
      ] : ['No face within reach of the other part.']));
    },
    hover: (x, y) => {
      const c = cells.find((d) => x >= d.x && x <= d.x + d.w && y >= d.y && y <= d.y + d.h);
      return c ? `${faces[0].names[c.fixed]} \u2013 ${faces[1].names[c.moving]}\n${area(c.contact)} in contact${c.overlap > 0 ? `\n${area(c.overlap)} overlapping` : ''}${c.depth > 0 ? `\nat most ${shortText(c.depth, 2)} ${unit} deep`.trimEnd() : ''}` : '';
    },
    pick: (x, y) => viewer.showPair(cells.find((d) => x >= d.x && x <= d.x + d.w && y >= d.y && y <= d.y + d.h) ?? null),
    describe: () => `Faces in contact in pose ${state.pose + 1}: ${countText(viewer.faceContacts().pairs.length, 'pair')}`,
  });
  return card;
}

const swatch = (colour, text) => {
  const dot = element('i', { class: 'swatch' });
  dot.style.background = colour;
  return element('span', { class: 'key' }, dot, text);
};

function contactCard(run, state, viewer) {
  if (!viewer) return { repaint() {} };
  if (viewer.isMesh) return faceCard(run, state, viewer);
  const { fixed, moving } = viewer;
  let plot = null;
  let hovered = [];
  // A tick: the residue's number, after its chain where there are several.
  const several = (body) => new Set(body.names.map((r) => r.chain)).size > 1;
  const many = new Map([[fixed, several(fixed)], [moving, several(moving)]]);
  const short = (body, k) => (body.names[k] ? `${many.get(body) ? `${body.names[k].chain}:` : ''}${body.names[k].number}` : '');
  const name = (body, k) => `${body.names[k].chain}:${body.names[k].text}`;
  // Chains follow each other on both axes; a line between two of them.
  const borders = (body) => body.names.flatMap((r, k) => (k > 0 && body.names[k - 1].chain !== r.chain ? [k] : []));
  const span = (list, key, total) => {
    if (!list.length) return [0, total];
    const values = list.map((c) => c[key]);
    const [low, high] = [values.reduce((a, b) => Math.min(a, b)), values.reduce((a, b) => Math.max(a, b))];
    const room = Math.max(3, 0.05 * (high - low));
    return zoomed ? [Math.max(0, low - room), Math.min(total, high + 1 + room)] : [0, total];
  };
  let zoomed = true;
  const card = makeCard(byId('plots'), 'Contacts', {
    controls: [choice('Residues shown', [['zoomed', 'interface'], ['all', 'all residues']], 'zoomed', (key) => {
      zoomed = key === 'zoomed';
      card.repaint();
    })],
    note: '',
    draw(context, width, height) {
      const contacts = viewer.contacts();
      plot = axes(context, width, height, { x: span(contacts, 'moving', moving.names.length), y: span(contacts, 'fixed', fixed.names.length), xLabel: fitting(run.bodies[1].name, 30), yLabel: fitting(run.bodies[0].name, 30), xText: (k) => short(moving, k), yText: (k) => short(fixed, k) });
      context.strokeStyle = themeColor('line-strong');
      context.setLineDash([4, 3]);
      context.beginPath();
      for (const k of borders(moving)) {
        const x = plot.toX(k);
        if (x > plot.left && x < plot.right) context.moveTo(x, plot.top), context.lineTo(x, plot.bottom);
      }
      for (const k of borders(fixed)) {
        const y = plot.toY(k);
        if (y > plot.top && y < plot.bottom) context.moveTo(plot.left, y), context.lineTo(plot.right, y);
      }
      context.stroke();
      context.setLineDash([]);
      const w = Math.max(2.5, plot.toX(1) - plot.toX(0));
      const h = Math.max(2.5, plot.toY(0) - plot.toY(1));
      hovered = contacts.map((c) => ({ ...c, x: plot.toX(c.moving), y: plot.toY(c.fixed + 1), w, h }));
      for (const c of hovered) {
        context.fillStyle = css(ramp(1.15 - (c.distance - 2.2) / 3.4));
        context.fillRect(c.x, c.y, w, h);
      }
      const pairs = contacts.length;
      card.note(pairs ? `${pairs} residue pairs within 5 \u00c5 of each other; the stronger the colour, the closer.` : 'No residues within 5 \u00c5 of each other.');
    },
    hover: (x, y) => {
      const c = hovered.find((d) => x >= d.x - 1 && x <= d.x + d.w + 1 && y >= d.y - 1 && y <= d.y + d.h + 1);
      return c ? `${name(fixed, c.fixed)} \u2013 ${name(moving, c.moving)}\n${c.distance.toFixed(1)} \u00c5` : '';
    },
    describe: () => `Contact map of pose ${state.pose + 1}: ${viewer.contacts().length} residue pairs`,
  });
  return card;
}

export function makeCards(run, state, viewer) {
  if (run.count === 0) {
    byId('plots').hidden = true;
    return { repaint() {} };
  }
  const cards = [scoreCard(run, state), funnelCard(run, state), sphereCard(run, state), contactCard(run, state, viewer)];
  return { repaint: () => cards.forEach((card) => card.repaint()) };
}
