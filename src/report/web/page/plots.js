// SPDX-License-Identifier: GPL-3.0-or-later
// Drawing on canvases: axes, and a card that holds one plot.
import { element, showTip, themeColor } from './dom.js';

/** Round numbers that span [low, high], about `wanted` of them. */
export function ticks(low, high, wanted = 5) {
  if (!(high > low)) return [low];
  const raw = (high - low) / wanted;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw * 0.999);
  const list = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) list.push(k * step);
  return list;
}

const tickText = (value, list) => {
  const step = list.length > 1 ? list[1] - list[0] : 1;
  if (Math.abs(value) >= 1e5) return value.toExponential(0).replace('e+', 'e');
  return value.toFixed(Math.max(0, Math.min(6, -Math.floor(Math.log10(step) + 1e-9)))).replace('-', '\u2212');
};

/**
 * A card with a canvas. draw(context, width, height) paints it in CSS pixels; hover(x, y) gives a text or nothing;
 * pick(x, y) acts on a click.
 */
export function makeCard(parent, title, { controls = [], note = '', draw, hover, pick, describe }) {
  const canvas = element('canvas', { role: 'img', 'aria-label': title });  // describe() says more once it is painted
  const noteLine = element('p', { class: 'note' }, note);
  const card = element('figure', { class: 'card' }, element('div', { class: 'card-head' }, element('h2', {}, title), element('span', { class: 'grow' }), ...controls), canvas, noteLine);
  parent.append(card);

  function paint() {
    const { width, height } = canvas.getBoundingClientRect();
    if (width < 10) return;
    const scale = window.devicePixelRatio || 1;
    canvas.width = Math.round(width * scale);
    canvas.height = Math.round(height * scale);
    const context = canvas.getContext('2d');
    context.setTransform(scale, 0, 0, scale, 0, 0);
    context.clearRect(0, 0, width, height);
    context.font = `11px ${getComputedStyle(document.body).fontFamily}`;
    draw(context, width, height);
    if (describe) canvas.setAttribute('aria-label', describe());
  }
  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  if (hover) {
    canvas.addEventListener('pointermove', (event) => showTip(event, hover(...place(event))));
    canvas.addEventListener('pointerleave', (event) => showTip(event, ''));
  }
  if (pick) canvas.addEventListener('click', (event) => pick(...place(event)));
  let waiting = false;
  const repaint = () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      paint();
    });
  };
  new ResizeObserver(repaint).observe(canvas);
  return { repaint, note: (...parts) => noteLine.replaceChildren(...parts) };
}

/** Axes in the left and lower margin; gives the scales of the plot's inside. */
export function axes(context, width, height, { x, y, xLabel, yLabel, logY = false, yTicks = true, xText, yText }) {
  const left = yTicks ? 46 : 12;
  const bottom = 34;
  const top = 8;
  const right = 10;
  const inner = { left, top, right: width - right, bottom: height - bottom };
  const lift = logY ? (v) => Math.log10(Math.max(v, 0.5)) : (v) => v;
  const [y0, y1] = y.map(lift);
  const toX = (v) => inner.left + ((v - x[0]) / (x[1] - x[0] || 1)) * (inner.right - inner.left);
  const toY = (v) => inner.bottom - ((lift(v) - y0) / (y1 - y0 || 1)) * (inner.bottom - inner.top);
  const fromX = (p) => x[0] + ((p - inner.left) / (inner.right - inner.left)) * (x[1] - x[0]);
  context.strokeStyle = themeColor('line');
  context.fillStyle = themeColor('ink-3');
  context.lineWidth = 1;
  context.textBaseline = 'middle';
  context.textAlign = 'right';
  if (yTicks) {
    const list = logY ? [1, 10, 100, 1e3, 1e4, 1e5].filter((v) => v >= y[0] && v <= y[1]) : ticks(y[0], y[1], 4);
    for (const v of list) {
      const at = Math.round(toY(v)) + 0.5;
      context.beginPath();
      context.moveTo(inner.left, at);
      context.lineTo(inner.right, at);
      context.stroke();
      context.fillText(yText ? yText(v) : logY ? v.toLocaleString('en') : tickText(v, list), inner.left - 6, at);
    }
  }
  context.textAlign = 'center';
  context.textBaseline = 'top';
  const list = ticks(x[0], x[1], Math.max(2, Math.round((inner.right - inner.left) / 60)));
  for (const v of list) {
    const at = Math.round(toX(v)) + 0.5;
    context.beginPath();
    context.moveTo(at, inner.bottom);
    context.lineTo(at, inner.bottom + 4);
    context.stroke();
    context.fillText(xText ? xText(v) : tickText(v, list), at, inner.bottom + 6);
  }
  context.strokeStyle = themeColor('line-strong');
  context.beginPath();
  context.moveTo(inner.left, inner.bottom + 0.5);
  context.lineTo(inner.right, inner.bottom + 0.5);
  context.stroke();
  context.fillStyle = themeColor('ink-2');
  context.textBaseline = 'bottom';
  context.fillText(xLabel, (inner.left + inner.right) / 2, height);
  if (yLabel) {
    context.save();
    context.translate(9, (inner.top + inner.bottom) / 2);
    context.rotate(-Math.PI / 2);
    context.textBaseline = 'middle';
    context.fillText(yLabel, 0, 0);
    context.restore();
  }
  return { ...inner, toX, toY, fromX };
}

/** [low, high] with a little room on both sides. */
export function padded(low, high, share = 0.04) {
  if (!(high > low)) return [low - 0.5, low + 0.5];
  return [low - share * (high - low), high + share * (high - low)];
}
