// SPDX-License-Identifier: GPL-3.0-or-later
// Faces of one part against faces of the other, those that touch or overlap: what residues are to molecules.
import { CONTACT_RAMP, OVERLAP, css, mix } from './colors.js';
import { countText, lengthUnit, powerUnit, shortText } from './data.js';
import { byId, element, fitting, themeColor } from './dom.js';
import { makeCard } from './plots.js';

const swatch = (colour, text) => {
  const dot = element('i', { class: 'swatch' });
  dot.style.background = colour;
  return element('span', { class: 'key' }, dot, text);
};

export function faceCard(run, state, viewer) {
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
