// SPDX-License-Identifier: GPL-3.0-or-later
// The four plots: scores, funnel, where the moving body sits, contacts of the chosen pose.
import { css, ramp } from './colors.js';
import { REFERENCE_COLUMNS, numberText, valueText } from './data.js';
import { byId, choice, element, fitting, themeColor } from './dom.js';
import { faceCard } from './face_card.js';
import { directions, fromHammer, hammer } from './geometry.js';
import { axes, makeCard, padded } from './plots.js';

const columnLabel = (c) => (c.unit ? `${c.label} (${c.unit})` : c.label);

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

const STAMP = 14;  // CSS pixels

/** A point of the funnel; quality classes differ in shape as well as in colour. */
function stamp(level, size, colour, scale) {
  const canvas = new OffscreenCanvas(Math.ceil(STAMP * scale), Math.ceil(STAMP * scale));
  const context = canvas.getContext('2d', { willReadFrequently: true });
  context.scale(canvas.width / STAMP, canvas.height / STAMP);
  context.translate(STAMP / 2, STAMP / 2);
  context.fillStyle = colour;
  context.beginPath();
  if (level === 1) {
    context.moveTo(0, -size - 1);
    context.lineTo(size + 0.6, size);
    context.lineTo(-size - 0.6, size);
  } else if (level === 2) {
    context.rect(-size, -size, 2 * size, 2 * size);
  } else if (level === 3) {
    context.moveTo(0, -size - 1.6);
    context.lineTo(size + 1.6, 0);
    context.lineTo(0, size + 1.6);
    context.lineTo(-size - 1.6, 0);
  } else {
    context.arc(0, 0, size, 0, 2 * Math.PI);
  }
  context.fill();
  return canvas;
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
    const context = layer.getContext('2d', { willReadFrequently: true });  // painted by the processor: many small marks
    context.scale(scale, scale);
    context.font = font;
    plot = axes(context, width, height, { x: usable.includes(column.key) ? [0, column.high * 1.03 || 1] : padded(column.low, column.high), y: padded(score.low, score.high), xLabel: columnLabel(column), yLabel: 'Score' });
    const classes = capri ? ['incorrect', 'acceptable', 'medium', 'high'] : [null];
    const size = run.count > 20000 ? 1.5 : run.count > 2000 ? 2.2 : 2.8;
    context.globalAlpha = run.count > 5000 ? 0.55 : 0.75;
    classes.forEach((name, level) => {
      const larger = level > 0 ? size + 0.8 : size;
      // Stamped one by one: a single path of thousands that overlap takes browsers seconds.
      const plain = level === 0 && size < 2;
      context.fillStyle = name ? themeColor(name) : themeColor('fixed');
      const mark = stamp(level, larger, name ? themeColor(name) : themeColor('fixed'), scale);
      for (let i = run.count - 1; i >= 0; --i) {
        if (capri && (capri.values[i] || 0) !== level) continue;
        const x = plot.toX(column.values[i]);
        const y = plot.toY(score.values[i]);
        if (!Number.isFinite(x)) continue;
        if (plain) context.fillRect(x - 0.8, y - 0.8, 1.6, 1.6);
        else context.drawImage(mark, x - STAMP / 2, y - STAMP / 2, STAMP, STAMP);
      }
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
