// SPDX-License-Identifier: GPL-3.0-or-later
// Colours of numbers and of the two bodies.

/** From nothing to most, dark ends readable on both themes: stops of a single-hue ramp through warm tones. */
const STOPS = {
  light: [[232, 236, 241], [250, 214, 165], [240, 155, 80], [200, 80, 40], [122, 22, 40]],
  dark: [[38, 46, 57], [92, 58, 48], [176, 86, 44], [240, 150, 70], [255, 232, 170]],
};

export const isDark = () => document.documentElement.dataset.theme === 'dark';

/** Colour of a share in [0, 1] as [r, g, b]. */
export function ramp(share, dark = isDark()) {
  const stops = STOPS[dark ? 'dark' : 'light'];
  const at = Math.max(0, Math.min(1, share)) * (stops.length - 1);
  const k = Math.min(stops.length - 2, Math.floor(at));
  return stops[k].map((low, c) => Math.round(low + (at - k) * (stops[k + 1][c] - low)));
}

const lerp = (a, b, share) => a.map((low, c) => Math.round(low + share * (b[c] - low)));

/** Surfaces in contact, from little to most, and in the 3D view from near to touching: teal, told from magenta by all. */
export const CONTACT_RAMP = () => (isDark() ? [[38, 62, 66], [72, 209, 204]] : [[214, 236, 236], [11, 114, 133]]);
export const CONTACT_3D = [[157, 187, 224], [0, 168, 160]];
export const OVERLAP = [226, 60, 142];

export const mix = ([low, high], share) => lerp(low, high, Math.max(0, Math.min(1, share)));

export const css = ([r, g, b]) => `rgb(${r} ${g} ${b})`;
export const hex = ([r, g, b]) => (r << 16) | (g << 8) | b;

export const rampCss = (dark) => `linear-gradient(90deg, ${[0, 0.25, 0.5, 0.75, 1].map((s) => css(ramp(s, dark))).join(', ')})`;

/** The bodies in the 3D view; the same in both themes, so that pictures match. Meshes are lit less than cartoons. */
export const BODY = { fixed: 0x7f9fc4, moving: 0xe08a3f, fixedDeep: 0x47688f, movingDeep: 0xb85c12, fixedPart: 0x9dbbe0, movingPart: 0xf29a4a, wayOut: 0x2b8a3e };
