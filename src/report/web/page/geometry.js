// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid motions, contacts between the bodies and the equal-area map of the sphere.

/** The motion x' = R x + t of one pose: nine entries of R by row, then t. */
export function motion(run, pose, shift = [0, 0, 0]) {
  const [w, x, y, z] = run.rotation.subarray(4 * pose, 4 * pose + 4);
  const [tx, ty, tz] = run.translation.subarray(3 * pose, 3 * pose + 3);
  return [
    1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
    2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
    2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y),
    tx + shift[0], ty + shift[1], tz + shift[2],
  ];
}

/** Moves `count` points, three numbers each. */
export function moved(m, points, out = new Float32Array(points.length)) {
  for (let i = 0; i < points.length; i += 3) {
    const x = points[i];
    const y = points[i + 1];
    const z = points[i + 2];
    out[i] = m[0] * x + m[1] * y + m[2] * z + m[9];
    out[i + 1] = m[3] * x + m[4] * y + m[5] * z + m[10];
    out[i + 2] = m[6] * x + m[7] * y + m[8] * z + m[11];
  }
  return out;
}

/** Points in cubic cells: near(x, y, z, visit) calls visit(index, squared distance) for those within the cutoff. */
export class Cells {
  constructor(points, cutoff) {
    this.points = points;
    this.cutoff = cutoff;
    this.cells = new Map();
    for (let i = 0; i < points.length; i += 3) {
      const key = this.key(Math.floor(points[i] / cutoff), Math.floor(points[i + 1] / cutoff), Math.floor(points[i + 2] / cutoff));
      const cell = this.cells.get(key);
      if (cell) cell.push(i / 3);
      else this.cells.set(key, [i / 3]);
    }
  }

  key(i, j, k) { return ((i + 4096) * 8192 + (j + 4096)) * 8192 + (k + 4096); }

  near(x, y, z, visit) {
    const { points, cutoff } = this;
    const [i, j, k] = [Math.floor(x / cutoff), Math.floor(y / cutoff), Math.floor(z / cutoff)];
    for (let a = i - 1; a <= i + 1; ++a)
      for (let b = j - 1; b <= j + 1; ++b)
        for (let c = k - 1; c <= k + 1; ++c)
          for (const n of this.cells.get(this.key(a, b, c)) ?? []) {
            const d = (points[3 * n] - x) ** 2 + (points[3 * n + 1] - y) ** 2 + (points[3 * n + 2] - z) ** 2;
            if (d <= cutoff * cutoff) visit(n, d);
          }
  }
}

/** Hammer's equal-area map: a direction to the plane, |x| <= 2 sqrt 2, |y| <= sqrt 2. */
export function hammer([x, y, z]) {
  const longitude = Math.atan2(y, x);
  const latitude = Math.asin(Math.max(-1, Math.min(1, z)));
  const d = Math.sqrt(1 + Math.cos(latitude) * Math.cos(longitude / 2));
  return [(2 * Math.SQRT2 * Math.cos(latitude) * Math.sin(longitude / 2)) / d, (Math.SQRT2 * Math.sin(latitude)) / d];
}

/** Back from the plane; null outside of the ellipse. */
export function fromHammer(u, v) {
  if (u * u / 8 + v * v / 2 > 1) return null;
  const s = Math.sqrt(1 - (u / 4) ** 2 - (v / 2) ** 2);
  const longitude = 2 * Math.atan2(s * u, 2 * (2 * s * s - 1));
  const latitude = Math.asin(Math.max(-1, Math.min(1, s * v)));
  return [Math.cos(latitude) * Math.cos(longitude), Math.cos(latitude) * Math.sin(longitude), Math.sin(latitude)];
}

/** Unit vectors from the fixed body's centre to the moving one's, for every pose. */
export function directions(run) {
  const [fixed, moving] = run.bodies;
  const out = new Float32Array(3 * run.count);
  for (let p = 0; p < run.count; ++p) {
    const at = moved(motion(run, p), moving.center);
    const d = [at[0] - fixed.center[0], at[1] - fixed.center[1], at[2] - fixed.center[2]];
    const length = Math.hypot(...d) || 1;
    for (let k = 0; k < 3; ++k) out[3 * p + k] = d[k] / length;
  }
  return out;
}
