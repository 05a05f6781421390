// SPDX-License-Identifier: GPL-3.0-or-later
// Which faces of two parts touch in a pose, and where they overlap.
import { motion } from './geometry.js';
import { TriangleTree } from './triangle_tree.js';

const CREASE = Math.cos((30 * Math.PI) / 180);  // a face ends where the surface bends more
const SLIVER = 5e-4;  // of a part's area
const FACING = -0.5;  // cosine between the outward normals of surfaces in contact

/** What a face is: all normals alike, across one axis, or at one angle to it. */
function kindOf(tree, faces) {
  const normal = (t) => [0, 1, 2].map((k) => tree.normals[3 * t + k]);
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const first = normal(faces[0]);
  const farthest = faces.reduce((far, t) => (dot(normal(t), first) < dot(normal(far), first) ? t : far), faces[0]);
  if (dot(normal(farthest), first) > 0.9995) return 'flat';
  // Normals of a cylinder or cone end on one circle; three of them give its plane.
  const second = normal(farthest);
  const apart = (n) => Math.min(1 - dot(n, first), 1 - dot(n, second));
  const third = normal(faces.reduce((far, t) => (apart(normal(t)) > apart(normal(far)) ? t : far), faces[0]));
  const u = first.map((x, k) => second[k] - x);
  const v = first.map((x, k) => third[k] - x);
  let axis = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
  const length = Math.hypot(...axis);
  if (length < 1e-6) return 'curved';
  axis = axis.map((x) => x / length);
  const lift = dot(axis, first);
  if (!faces.every((t) => Math.abs(dot(axis, normal(t)) - lift) < 0.02)) return 'curved';
  return Math.abs(lift) < 0.02 ? 'cylinder' : 'cone';
}

/** A part's faces, split where its surface bends sharply: the face of each triangle, names and areas by size. */
function facesOf(tree) {
  const { triangles } = tree;
  const count = triangles.length / 3;
  const sides = new Map();
  const vertices = tree.vertices.length / 3;
  for (let c = 0; c < triangles.length; ++c) {
    const t = Math.floor(c / 3);
    const a = triangles[c];
    const b = triangles[3 * t + ((c + 1) % 3)];
    const key = Math.min(a, b) * vertices + Math.max(a, b);
    const list = sides.get(key);
    if (list) list.push(t);
    else sides.set(key, [t]);
  }
  const root = Int32Array.from({ length: count }, (_, t) => t);
  const find = (t) => {
    while (root[t] !== t) t = root[t] = root[root[t]];
    return t;
  };
  for (const list of sides.values()) {
    if (list.length !== 2) continue;
    const [a, b] = list;
    const bend = tree.normals[3 * a] * tree.normals[3 * b] + tree.normals[3 * a + 1] * tree.normals[3 * b + 1] + tree.normals[3 * a + 2] * tree.normals[3 * b + 2];
    if (bend > CREASE) root[find(a)] = find(b);
  }
  // Slivers, such as simplifying leaves, belong to the largest face beside them.
  const total = tree.areas.reduce((a, b) => a + b, 0);
  const size = new Float64Array(count);
  for (let t = 0; t < count; ++t) size[find(t)] += tree.areas[t];
  const beside = new Map();
  for (const list of sides.values())
    for (const [a, b] of list.length === 2 ? [list, [list[1], list[0]]] : []) {
      const [r, other] = [find(a), find(b)];
      if (r !== other && size[r] < SLIVER * total && size[other] > (size[beside.get(r)] ?? size[r])) beside.set(r, other);
    }
  for (const [r, other] of beside) root[r] = other;
  const members = new Map();
  for (let t = 0; t < count; ++t) {
    const r = find(t);
    if (!members.has(r)) members.set(r, []);
    members.get(r).push(t);
  }
  const list = [...members.values()].map((faces) => ({ faces, area: faces.reduce((sum, t) => sum + tree.areas[t], 0) }));
  list.sort((a, b) => b.area - a.area);
  const numbers = {};
  const of = new Int32Array(count);
  const names = list.map(({ faces }, k) => {
    const kind = kindOf(tree, faces);
    numbers[kind] = (numbers[kind] ?? 0) + 1;
    for (const t of faces) of[t] = k;
    return `${kind} ${numbers[kind]}`;
  });
  return { of, names, areas: list.map((f) => f.area) };
}

export function makePartContact(run) {
  const [fixedBody, movingBody] = run.bodies;
  const fixed = new TriangleTree(fixedBody.mesh);
  const moving = new TriangleTree(movingBody.mesh);
  const faces = [facesOf(fixed), facesOf(moving)];
  const smaller = 2 * Math.min(fixedBody.radius, movingBody.radius);
  // As the run's own contact check, and no less than what simplifying has moved.
  const tolerance = Math.max((run.options.tolerance ?? 0.005) * smaller, (fixedBody.deviation ?? 0) + (movingBody.deviation ?? 0));
  const reach = Math.max(4 * tolerance, 0.06 * movingBody.radius);

  /** Per triangle of the fixed part: gap > 0, NaN = nothing near; depth as a gap < 0. Per pair of faces: areas. */
  function measure(pose) {
    const m = motion(run, pose);
    const gaps = new Float32Array(fixed.areas.length).fill(NaN);
    const touching = new Uint8Array(fixed.areas.length);  // 1 = in contact, 2 = overlapping
    const partner = new Int32Array(fixed.areas.length);   // face of the moving part
    const pairs = new Map();
    const [cx, cy, cz] = movingBody.center;
    const far = (movingBody.radius + reach) ** 2;
    let contact = 0;
    let overlap = 0;
    for (let t = 0; t < fixed.areas.length; ++t) {
      const d = [fixed.centres[3 * t] - m[9], fixed.centres[3 * t + 1] - m[10], fixed.centres[3 * t + 2] - m[11]];
      const x = m[0] * d[0] + m[3] * d[1] + m[6] * d[2];
      const y = m[1] * d[0] + m[4] * d[1] + m[7] * d[2];
      const z = m[2] * d[0] + m[5] * d[1] + m[8] * d[2];
      if ((x - cx) ** 2 + (y - cy) ** 2 + (z - cz) ** 2 > far) continue;
      const near = moving.nearest(x, y, z, reach);
      if (!near) continue;
      const n = [fixed.normals[3 * t], fixed.normals[3 * t + 1], fixed.normals[3 * t + 2]];
      const turned = [0, 1, 2].map((k) => m[k] * n[0] + m[3 + k] * n[1] + m[6 + k] * n[2]);
      const o = 3 * near.triangle;
      const facing = turned[0] * moving.normals[o] + turned[1] * moving.normals[o + 1] + turned[2] * moving.normals[o + 2] < FACING;
      const inside = near.side < 0;
      const touches = facing && near.distance <= tolerance;
      const deep = inside && near.distance > tolerance;
      if (!facing && !deep) continue;
      gaps[t] = inside ? -near.distance : near.distance;
      if (!touches && !deep) continue;
      touching[t] = touches ? 1 : 2;
      partner[t] = faces[1].of[near.triangle];
      const key = faces[0].of[t] * 1e6 + faces[1].of[near.triangle];
      const pair = pairs.get(key) ?? { fixed: faces[0].of[t], moving: faces[1].of[near.triangle], contact: 0, overlap: 0, depth: 0 };
      if (touches) pair.contact += fixed.areas[t];
      else pair.overlap += fixed.areas[t];
      if (inside) pair.depth = Math.max(pair.depth, near.distance);
      pairs.set(key, pair);
      if (touches) contact += fixed.areas[t];
      else overlap += fixed.areas[t];
    }
    return { gaps, touching, partner, contact, overlap, pairs: [...pairs.values()].sort((a, b) => b.contact + b.overlap - a.contact - a.overlap) };
  }

  return { measure, faces, tolerance, reach };
}
