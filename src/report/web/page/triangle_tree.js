// SPDX-License-Identifier: GPL-3.0-or-later
// Nearest points of a mesh: a tree of boxes over its triangles, halved along their longest side.

const LEAF = 6;  // triangles

export class TriangleTree {
  constructor({ vertices, triangles }) {
    this.vertices = vertices;
    this.triangles = triangles;
    const count = triangles.length / 3;
    this.order = Uint32Array.from({ length: count }, (_, t) => t);
    this.centres = new Float32Array(3 * count);
    this.normals = new Float32Array(3 * count);
    this.areas = new Float32Array(count);
    for (let t = 0; t < count; ++t) {
      const [a, b, c] = [0, 1, 2].map((k) => 3 * triangles[3 * t + k]);
      const u = [0, 1, 2].map((k) => vertices[b + k] - vertices[a + k]);
      const v = [0, 1, 2].map((k) => vertices[c + k] - vertices[a + k]);
      const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
      const length = Math.hypot(...n) || 1;
      this.areas[t] = length / 2;
      for (let k = 0; k < 3; ++k) {
        this.centres[3 * t + k] = (vertices[a + k] + vertices[b + k] + vertices[c + k]) / 3;
        this.normals[3 * t + k] = n[k] / length;
      }
    }
    this.nodes = [];  // box (6), then the children's indices, or -1 and the range of triangles
    this.build(0, count);
  }

  build(first, last) {
    const box = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
    const middle = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
    for (let i = first; i < last; ++i) {
      const t = this.order[i];
      for (let k = 0; k < 3; ++k) {
        for (let c = 0; c < 3; ++c) {
          const x = this.vertices[3 * this.triangles[3 * t + c] + k];
          if (x < box[k]) box[k] = x;
          if (x > box[3 + k]) box[3 + k] = x;
        }
        const x = this.centres[3 * t + k];
        if (x < middle[k]) middle[k] = x;
        if (x > middle[3 + k]) middle[3 + k] = x;
      }
    }
    const node = { box, left: -1, right: -1, first, last };
    this.nodes.push(node);
    const index = this.nodes.length - 1;
    if (last - first > LEAF) {
      const size = [0, 1, 2].map((k) => middle[3 + k] - middle[k]);
      const axis = size.indexOf(Math.max(...size));
      this.order.subarray(first, last).sort((a, b) => this.centres[3 * a + axis] - this.centres[3 * b + axis]);
      const half = (first + last) >> 1;
      node.left = this.build(first, half);
      node.right = this.build(half, last);
    }
    return index;
  }

  boxDistance(index, x, y, z) {
    const { box } = this.nodes[index];
    const dx = Math.max(box[0] - x, 0, x - box[3]);
    const dy = Math.max(box[1] - y, 0, y - box[4]);
    const dz = Math.max(box[2] - z, 0, z - box[5]);
    return dx * dx + dy * dy + dz * dz;
  }

  /** Within `limit`: triangle, its nearest point's distance and which side it is seen from; else null. */
  nearest(x, y, z, limit) {
    let best = limit * limit;
    let found = null;
    const stack = [0];
    const at = [0, 0, 0];
    while (stack.length) {
      const index = stack.pop();
      if (this.boxDistance(index, x, y, z) > best) continue;
      const node = this.nodes[index];
      if (node.left >= 0) {
        const near = this.boxDistance(node.left, x, y, z) <= this.boxDistance(node.right, x, y, z);
        stack.push(near ? node.right : node.left, near ? node.left : node.right);
        continue;
      }
      for (let i = node.first; i < node.last; ++i) {
        const t = this.order[i];
        const d = this.toTriangle(t, x, y, z, at);
        const side = (x - at[0]) * this.normals[3 * t] + (y - at[1]) * this.normals[3 * t + 1] + (z - at[2]) * this.normals[3 * t + 2];
        // On an edge both triangles are as near; the one seen more squarely has the right side.
        if (d < best * (1 - 1e-9) || (found && d <= best * (1 + 1e-6) && Math.abs(side) > Math.abs(found.side))) {
          best = Math.min(best, d);
          found = { triangle: t, distance: Math.sqrt(d), side };
        }
      }
    }
    return found;
  }

  /** Squared distance to triangle t and the nearest point [Ericson, Real-Time Collision Detection, 5.1.5]. */
  toTriangle(t, x, y, z, at) {
    const v = this.vertices;
    const [a, b, c] = [3 * this.triangles[3 * t], 3 * this.triangles[3 * t + 1], 3 * this.triangles[3 * t + 2]];
    const p = [x, y, z];
    let d1 = 0; let d2 = 0; let d3 = 0; let d4 = 0; let d5 = 0; let d6 = 0;
    for (let k = 0; k < 3; ++k) {
      const ab = v[b + k] - v[a + k];
      const ac = v[c + k] - v[a + k];
      d1 += ab * (p[k] - v[a + k]);
      d2 += ac * (p[k] - v[a + k]);
      d3 += ab * (p[k] - v[b + k]);
      d4 += ac * (p[k] - v[b + k]);
      d5 += ab * (p[k] - v[c + k]);
      d6 += ac * (p[k] - v[c + k]);
    }
    const va = d3 * d6 - d5 * d4;
    const vb = d5 * d2 - d1 * d6;
    const vc = d1 * d4 - d3 * d2;
    let s; let r;  // weights of b and c
    if (d1 <= 0 && d2 <= 0) [s, r] = [0, 0];
    else if (d3 >= 0 && d4 <= d3) [s, r] = [1, 0];
    else if (vc <= 0 && d1 >= 0 && d3 <= 0) [s, r] = [d1 / (d1 - d3), 0];
    else if (d6 >= 0 && d5 <= d6) [s, r] = [0, 1];
    else if (vb <= 0 && d2 >= 0 && d6 <= 0) [s, r] = [0, d2 / (d2 - d6)];
    else if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
      r = (d4 - d3) / (d4 - d3 + (d5 - d6));
      s = 1 - r;
    } else [s, r] = [vb / (va + vb + vc), vc / (va + vb + vc)];
    let sum = 0;
    for (let k = 0; k < 3; ++k) {
      at[k] = v[a + k] + s * (v[b + k] - v[a + k]) + r * (v[c + k] - v[a + k]);
      sum += (p[k] - at[k]) ** 2;
    }
    return sum;
  }
}
