// SPDX-License-Identifier: GPL-3.0-or-later
// Making elements. Text goes in as text nodes only, so names from files cannot become markup.

/** element('p', {class: 'note', onclick: f}, 'text', child, ...) */
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith('on')) made.addEventListener(name.slice(2), value);
    else made.setAttribute(name, value === true ? '' : String(value));
  }
  made.append(...children.filter((child) => child !== undefined && child !== null));
  return made;
}

export const fitting = (text, most) => (text.length > most ? `${text.slice(0, most - 1)}\u2026` : text);

export const byId = (id) => document.getElementById(id);

/** A colour of the theme in force, as a CSS text. */
export const themeColor = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

/** Shows a tip beside the pointer; no text hides it. */
export function showTip(event, text) {
  const tip = byId('tip');
  tip.hidden = !text;
  if (!text) return;
  tip.textContent = text;
  const { width, height } = tip.getBoundingClientRect();
  tip.style.left = `${Math.max(4, Math.min(event.clientX + 12, innerWidth - width - 4))}px`;
  tip.style.top = `${event.clientY + 16 + height > innerHeight ? event.clientY - height - 8 : event.clientY + 16}px`;
}

/** A labelled check box, range or choice whose change calls `change` with its value. */
export function checkbox(label, checked, change, attributes = {}) {
  const input = element('input', { type: 'checkbox', ...attributes, onchange: () => change(input.checked) });
  input.checked = checked;
  return element('label', { class: 'field' }, input, element('span', {}, label));
}

export function slider(label, value, text, change, attributes = {}) {
  const output = element('output', {}, text(value));
  const input = element('input', { type: 'range', min: 0, max: 100, value, 'aria-label': label, ...attributes, oninput: () => {
    output.textContent = text(Number(input.value));
    change(Number(input.value));
  } });
  return element('label', { class: 'field' }, element('span', {}, label), input, output);
}

export function choice(label, options, selected, change, attributes = {}) {
  const select = element('select', { 'aria-label': label, ...attributes, onchange: () => change(select.value) },
    ...options.map(([value, text]) => element('option', { value }, text)));
  select.value = selected;
  return select;
}
