// SPDX-License-Identifier: GPL-3.0-or-later
// Walks through the triangle tree; compiled once per instruction set (see cmake/MortiseIsa.cmake
// for what that forbids here).
#include "parts/tree_isa.hpp"

#include "parts/lanes_isa.hpp"

namespace mortise::MORTISE_ISA {
extern const TreeTable kTreeTable;

namespace {

constexpr double kPi = 3.14159265358979323846;

struct Best {
  double distance_sq;
  int triangle;
  int packet;
};

// Squared distances to the segments from a corner along an edge, p = point - corner.
[[gnu::always_inline]] inline Lanes to_edge(const Lanes3& p, const Lanes3& edge,
                                            const Lanes& inverse_sq) {
  const Lanes t = smaller(larger(dot(p, edge) * inverse_sq, all(0.0)), all(1.0));
  const Lanes3 rest = step(p, t, edge);
  return dot(rest, rest);
}

void look_into_packet(const TrianglePacket& packet, int index, const double* point, Best& best) {
  double distances[kTreeWidth];
  unsigned better = 0;
  for (int l = 0; l < kTreeWidth; l += kLanes) {
    const Lanes3 q = {all(point[0]), all(point[1]), all(point[2])};
    const Lanes3 p = minus(q, load3(packet.corner, l));
    const Lanes3 e1 = load3(packet.edge1, l), e2 = load3(packet.edge2, l);
    const Lanes3 n = load3(packet.normal, l);
    Lanes d = to_edge(p, e1, load<Lanes>(packet.inverse_edge1_sq + l));
    d = smaller(d, to_edge(p, e2, load<Lanes>(packet.inverse_edge2_sq + l)));
    d = smaller(d, to_edge(minus(p, e1), minus(e2, e1), load<Lanes>(packet.inverse_edge3_sq + l)));
    // The foot on the plane by its two oblique coordinates, times twice the area.
    const Lanes s = dot(cross(p, e2), n), t = dot(cross(e1, p), n);
    const Lanes twice_area = dot(cross(e1, e2), n);
    const Lanes height = dot(p, n);
    const LaneMask inside = (s >= 0.0) & (t >= 0.0) & (s + t <= twice_area) & (twice_area > 0.0);
    d = inside ? height * height : d;
    store(distances + l, d);
    better |= bits(d < best.distance_sq) << l;
  }
  for (; better != 0; better &= better - 1) {
    const int l = __builtin_ctz(better);
    if (distances[l] < best.distance_sq) best = {distances[l], packet.triangle[l], index};
  }
}

struct Waiting {
  double distance_sq;
  int child;
};

void search(const TreeView& tree, const double* point, Best& best) {
  Waiting stack[kTreeStack];
  int depth = 0;
  stack[depth++] = {0.0, 0};
  while (depth > 0) {
    const Waiting top = stack[--depth];
    if (top.distance_sq >= best.distance_sq) continue;
    if (top.child < 0) {
      look_into_packet(tree.packets[-1 - top.child], -1 - top.child, point, best);
      continue;
    }
    const TreeNode& node = tree.nodes[top.child];
    double distances[kTreeWidth];
    unsigned near = 0;
    for (int l = 0; l < kTreeWidth; l += kLanes) {
      const Lanes3 q = {all(point[0]), all(point[1]), all(point[2])};
      const Lanes3 r = minus(q, load3(node.middle, l));
      Lanes d = {};
      for (int axis = 0; axis < 3; ++axis) {
        const Lanes along = dot(r, load3(node.axis[axis], l));
        const Lanes gap =
            larger((along < 0.0 ? -along : along) - load<Lanes>(node.half[axis] + l), all(0.0));
        d += gap * gap;
      }
      store(distances + l, d);
      near |= bits(d < best.distance_sq) << l;
    }
    const int bottom = depth;  // the nearest child on top
    for (; near != 0; near &= near - 1) {
      const int l = __builtin_ctz(near);
      int place = depth++;
      for (; place > bottom && stack[place - 1].distance_sq < distances[l]; --place)
        stack[place] = stack[place - 1];
      stack[place] = {distances[l], node.child[l]};
    }
  }
}

void nearest(const TreeView& tree, const double* points, std::ptrdiff_t count, double bound_sq,
             double* distance_sq, int* triangle) {
  int packet = -1;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    Best best = {bound_sq, -1, packet};
    // The last point's nearest triangle bounds the distance from the start.
    if (packet >= 0) look_into_packet(tree.packets[packet], packet, points + 3 * i, best);
    search(tree, points + 3 * i, best);
    distance_sq[i] = best.distance_sq;
    triangle[i] = best.triangle;
    packet = best.packet;
  }
}

// atan2, error below 1e-9.
[[gnu::always_inline]] inline Lanes angle(const Lanes& y, const Lanes& x) {
  const Lanes size_x = x < 0.0 ? -x : x, size_y = y < 0.0 ? -y : y;
  const LaneMask steep = size_y > size_x;
  const Lanes large = steep ? size_y : size_x, small = steep ? size_x : size_y;
  // atan(u) = pi/4 + atan((u - 1) / (u + 1)) above tan(pi/8)
  const LaneMask upper = small > 0.41421356237309503 * large;
  const Lanes above = upper ? small - large : small, below = upper ? small + large : large;
  const Lanes u = above / (below > 0.0 ? below : all(1.0)), w = u * u;
  Lanes series = all(1.0 / 21);
  for (int k = 19; k > 0; k -= 2) series = 1.0 / k - w * series;
  Lanes a = u * series + (upper ? all(kPi / 4) : all(0.0));
  a = steep ? kPi / 2 - a : a;
  a = x < 0.0 ? kPi - a : a;
  return y < 0.0 ? -a : a;
}

// Solid angles of the packet's triangles [Van Oosterom and Strackee 1983]; positive from inside.
double solid_angles(const TrianglePacket& packet, const double* point) {
  Lanes total = {};
  for (int l = 0; l < kTreeWidth; l += kLanes) {
    const Lanes3 q = {all(point[0]), all(point[1]), all(point[2])};
    const Lanes3 a = minus(load3(packet.corner, l), q);
    const Lanes3 e1 = load3(packet.edge1, l), e2 = load3(packet.edge2, l);
    const Lanes3 b = {a.x + e1.x, a.y + e1.y, a.z + e1.z}, c = {a.x + e2.x, a.y + e2.y, a.z + e2.z};
    const Lanes size_a = root(dot(a, a)), size_b = root(dot(b, b)), size_c = root(dot(c, c));
    const Lanes above = dot(a, cross(e1, e2));
    const Lanes below =
        size_a * size_b * size_c + dot(a, b) * size_c + dot(b, c) * size_a + dot(c, a) * size_b;
    Lanes half = angle(above, below);
    for (int k = 0; k < kLanes; ++k) half[k] = l + k < packet.count ? half[k] : 0.0;
    total += half;
  }
  return 2.0 * sum(total);
}

double winding_at(const TreeView& tree, const double* point, double beta) {
  int stack[kTreeStack];
  int depth = 0;
  stack[depth++] = 0;
  Lanes far_sum = {};
  double near_sum = 0.0;
  while (depth > 0) {
    const int child = stack[--depth];
    if (child < 0) {
      near_sum += solid_angles(tree.packets[-1 - child], point);
      continue;
    }
    const TreeNode& node = tree.nodes[child];
    unsigned near = 0;
    for (int l = 0; l < kTreeWidth; l += kLanes) {
      const Lanes3 q = {all(point[0]), all(point[1]), all(point[2])};
      const Lanes3 r = minus(load3(node.centre, l), q);
      const Lanes distance_sq = dot(r, r);
      const Lanes reach = beta * load<Lanes>(node.radius + l);
      const LaneMask far = distance_sq > reach * reach + 1e-60;  // no overflow below
      near |= (~bits(far) & ((1u << kLanes) - 1)) << l;
      const Lanes f = 1.0 / (far ? distance_sq : all(1.0));  // 1 / r^2
      const Lanes psi = f * root(f), psi1 = -3.0 * psi * f, psi2 = -5.0 * psi1 * f;
      Lanes m[kTreeMoments];
      for (int k = 0; k < kTreeMoments; ++k) m[k] = load<Lanes>(node.moments[k] + l);
      const Lanes xx = r.x * r.x, yy = r.y * r.y, zz = r.z * r.z;
      const Lanes linear = m[0] * r.x + m[1] * r.y + m[2] * r.z + m[3] + m[4] + m[5];
      const Lanes quadratic =
          m[3] * xx + m[4] * yy + m[5] * zz + m[6] * r.x * r.y + m[7] * r.x * r.z +
          m[8] * r.y * r.z + (3.0 * m[9] + m[14] + m[16]) * r.x +
          (3.0 * m[10] + m[12] + m[17]) * r.y + (3.0 * m[11] + m[13] + m[15]) * r.z;
      const Lanes cubic = xx * (m[9] * r.x + m[12] * r.y + m[13] * r.z) +
                          yy * (m[10] * r.y + m[14] * r.x + m[15] * r.z) +
                          zz * (m[11] * r.z + m[16] * r.x + m[17] * r.y) + m[18] * r.x * r.y * r.z;
      const Lanes value = linear * psi + quadratic * psi1 + cubic * psi2;
      far_sum += far ? value : all(0.0);
    }
    near &= (1u << node.count) - 1;
    for (; near != 0; near &= near - 1) stack[depth++] = node.child[__builtin_ctz(near)];
  }
  return (near_sum + sum(far_sum)) / (4.0 * kPi);
}

void winding(const TreeView& tree, const double* points, std::ptrdiff_t count, double beta,
             double* result) {
  for (std::ptrdiff_t i = 0; i < count; ++i) result[i] = winding_at(tree, points + 3 * i, beta);
}

}  // namespace

const TreeTable kTreeTable = {nearest, winding};

}  // namespace mortise::MORTISE_ISA
