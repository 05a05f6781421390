// SPDX-License-Identifier: GPL-3.0-or-later
// Parts in the 3D view: flat faces, sharp edges drawn as lines.
import { BODY } from './colors.js';
import { moved } from './geometry.js';

const CREASE = Math.cos((30 * Math.PI) / 180);  // edges that bend more are drawn
const LIFT = 6e-3;  // of the part's radius
const PATCH_LIFT = 1.5e-3;  // of the part's radius
const EDGES_PER_SHAPE = 400;  // the viewer goes through all lines of a shape for each line added

/** Corners with normals of their own where the surface bends, and the lines along such edges; in simplified parts those between faces. */
function prepare({ mesh: { vertices, triangles }, radius, deviation }, faceOf) {
  const faces = triangles.length / 3;
  const normals = new Float32Array(3 * faces);
  const areas = new Float32Array(3 * faces);  // normals by twice the area
  for (let f = 0; f < faces; ++f) {
    const [a, b, c] = [0, 1, 2].map((k) => triangles[3 * f + k] * 3);
    const u = [0, 1, 2].map((k) => vertices[b + k] - vertices[a + k]);
    const v = [0, 1, 2].map((k) => vertices[c + k] - vertices[a + k]);
    const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    const length = Math.hypot(...n) || 1;
    areas.set(n, 3 * f);
    normals.set(n.map((x) => x / length), 3 * f);
  }
  const around = Array.from({ length: vertices.length / 3 }, () => []);
  for (let c = 0; c < triangles.length; ++c) around[triangles[c]].push(Math.floor(c / 3));

  const points = new Float32Array(9 * faces);
  const cornerNormals = new Float32Array(9 * faces);
  const dot = (f, g) => normals[3 * f] * normals[3 * g] + normals[3 * f + 1] * normals[3 * g + 1] + normals[3 * f + 2] * normals[3 * g + 2];
  for (let c = 0; c < triangles.length; ++c) {
    const face = Math.floor(c / 3);
    const sum = [0, 0, 0];
    for (const g of around[triangles[c]])
      if (dot(face, g) > CREASE) for (let k = 0; k < 3; ++k) sum[k] += areas[3 * g + k];
    const length = Math.hypot(...sum) || 1;
    for (let k = 0; k < 3; ++k) {
      points[3 * c + k] = vertices[3 * triangles[c] + k];
      cornerNormals[3 * c + k] = sum[k] / length;
    }
  }

  const sides = new Map();
  const count = vertices.length / 3;
  for (let f = 0; f < faces; ++f)
    for (let k = 0; k < 3; ++k) {
      const a = triangles[3 * f + k];
      const b = triangles[3 * f + ((k + 1) % 3)];
      const key = Math.min(a, b) * count + Math.max(a, b);
      const other = sides.get(key);
      if (other) other.push(f);
      else sides.set(key, [f]);
    }
  const ends = [];
  for (const [key, shared] of sides) {
    if (shared.length === 2 && (dot(shared[0], shared[1]) >= CREASE || (deviation && faceOf[shared[0]] === faceOf[shared[1]]))) continue;
    // A hair outside of the surface, or the faces would hide half of the line.
    const lift = [0, 1, 2].map((k) => LIFT * radius * shared.reduce((sum, f) => sum + normals[3 * f + k], 0) / shared.length);
    for (const v of [Math.floor(key / count), key % count]) for (let k = 0; k < 3; ++k) ends.push(vertices[3 * v + k] + lift[k]);
  }
  return { points, normals: cornerNormals, ends: Float32Array.from(ends), corners: triangles };
}

const xyz = (numbers) => {
  const list = new Array(numbers.length / 3);
  for (let i = 0; i < list.length; ++i) list[i] = { x: numbers[3 * i], y: numbers[3 * i + 1], z: numbers[3 * i + 2] };
  return list;
};

export function showMesh(viewer, fixedBody, movingBody, faces) {
  const fixed = prepare(fixedBody, faces[0].of);
  const moving = prepare(movingBody, faces[1].of);
  const still = [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0];
  let shapes = [];
  let drawnFixed = '';
  let fixedShapes = [];

  /** Some of the fixed part's triangles in colours of their own, a hair outside of its surface on both sides. */
  function addPatch({ triangles, colour }) {
    const { points, normals } = fixed;
    const lift = PATCH_LIFT * fixedBody.radius;
    const vertexArr = [];
    const normalArr = [];
    const color = [];
    for (const t of triangles) {
      const [r, g, b] = colour(t);
      for (const side of [1, -1])
        for (const k of side > 0 ? [0, 1, 2] : [0, 2, 1]) {
          const c = 9 * t + 3 * k;
          vertexArr.push({ x: points[c] + side * lift * normals[c], y: points[c + 1] + side * lift * normals[c + 1], z: points[c + 2] + side * lift * normals[c + 2] });
          normalArr.push({ x: side * normals[c], y: side * normals[c + 1], z: side * normals[c + 2] });
          color.push({ r: r / 255, g: g / 255, b: b / 255 });
        }
    }
    return viewer.addCustom({ vertexArr, normalArr, faceArr: Array.from(vertexArr, (_, i) => i), color, opacity: 1 });
  }

  function add(part, m, color, edgeColor, opacity, colours) {
    const turned = moved([...m.slice(0, 9), 0, 0, 0], part.normals);
    const count = part.points.length / 3;
    const spec = { vertexArr: xyz(moved(m, part.points)), normalArr: xyz(turned), faceArr: Array.from({ length: count }, (_, i) => i), opacity };
    if (colours) spec.color = Array.from(part.corners, (v) => {
      const [r, g, b] = colours(v);
      return { r: r / 255, g: g / 255, b: b / 255 };
    });
    else spec.color = color;
    const made = [viewer.addCustom(spec)];
    const ends = moved(m, part.ends);
    for (let from = 0; from < ends.length; from += 6 * EDGES_PER_SHAPE) {
      const lines = viewer.addShape({ color: edgeColor, wireframe: true, linewidth: 1 });
      for (let i = from; i < Math.min(ends.length, from + 6 * EDGES_PER_SHAPE); i += 6)
        lines.addLine({ start: { x: ends[i], y: ends[i + 1], z: ends[i + 2] }, end: { x: ends[i + 3], y: ends[i + 4], z: ends[i + 5] } });
      made.push(lines);
    }
    return made;
  }

  return {
    /**
     * colours(vertex) of the fixed part, null = plain; patch: { triangles, colour(triangle) } of it in front of the
     * see-through parts; way: an arrow's { from, to }; the last three may be null.
     */
    draw(m, { opacity, colours, patch, way }) {
      for (const shape of shapes) viewer.removeShape(shape);
      shapes = m ? add(moving, m, BODY.movingPart, 0x301603, patch ? 0.3 : 1, null) : [];
      if (patch?.triangles.length) shapes.push(addPatch(patch));
      if (way) shapes.push(viewer.addArrow({ start: xyz(way.from)[0], end: xyz(way.to)[0], radius: 0.035 * movingBody.radius, radiusRatio: 2.2, mid: 0.72, color: BODY.wayOut }));
      const state = `${opacity} ${colours ? 'coloured' : 'plain'}`;
      if (state === drawnFixed) return;
      drawnFixed = state;
      for (const shape of fixedShapes) viewer.removeShape(shape);
      fixedShapes = add(fixed, still, BODY.fixedPart, 0x15263c, opacity, colours);
    },
    zoom() {
      viewer.zoomTo();
    },
  };
}
