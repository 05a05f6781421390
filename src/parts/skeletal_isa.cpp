// SPDX-License-Identifier: GPL-3.0-or-later
// The skeletal density's surface integral; compiled once per instruction set (see
// cmake/MortiseIsa.cmake for what that forbids here).
//
// All lengths are in units of the point's distance to the mesh, so that the surface lies at t >= 1.
// Far clusters count by their moments, small triangles by a three-point rule, large ones by
// integrals along their edges (docs/math.md).
#include "parts/skeletal_isa.hpp"

#include "parts/lanes_isa.hpp"

namespace mortise::MORTISE_ISA {
extern const SkeletalTable kSkeletalTable;

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kTwoPi = 2.0 * kPi;
constexpr double kRootTwoPi = 2.5066282746310005;

struct Complex {
  Lanes re, im;
};

[[gnu::always_inline]] inline Complex times(const Complex& a, const Complex& b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

// exp(x) for -20 <= x <= 0, relative error below 1e-5.
[[gnu::always_inline]] inline Lanes exponential(const Lanes& x) {
  const Lanes y = x * 0.03125;
  Lanes e = all(1.0 / 5040);
  e = e * y + 1.0 / 720;
  e = e * y + 1.0 / 120;
  e = e * y + 1.0 / 24;
  e = e * y + 1.0 / 6;
  e = e * y + 0.5;
  e = e * y + 1.0;
  e = e * y + 1.0;
  e *= e;
  e *= e;
  e *= e;
  e *= e;
  return e * e;
}

struct Query {
  const SkeletalKernel& kernel;
  double point[3];
  double scale;  // 1 / distance
  double inverse_sigma;
  double height;  // of the Gaussian
};

// (1 + it)^-2 g(t - 1)
[[gnu::always_inline]] inline Complex kernel_at(const Query& query, const Lanes& t) {
  const Lanes x = (t - 1.0) * query.inverse_sigma;
  const Lanes u = 1.0 / (1.0 + t * t);
  const Lanes g = query.height * exponential(larger(-0.5 * x * x, all(-20.0))) * u * u;
  return {(1.0 - t * t) * g, -2.0 * t * g};
}

// What a cluster or triangle needs: nothing, as it is too far; second order in its size, as the
// kernel hardly changes over it; or a closer look.
struct Verdict {
  LaneMask far;
  Lanes error;  // of second order, in units of the kernel's peak
};

// A cluster with its centre at t, within a ball of this radius about it, and with this mean square
// extent along the line of sight.
[[gnu::always_inline]] inline Verdict judge(const Query& query, const Lanes& t, const Lanes& radius,
                                            const Lanes& depth_sq) {
  const Lanes nearest = t - radius;
  const Lanes x = (larger(nearest, all(1.0)) - 1.0) * query.inverse_sigma;
  // Where the Gaussian is small the same share of the peak allows wider clusters: exp(x^2 / 6),
  // whose cube is 1 / g, from below.
  Lanes growth = 1.0 + x * x * (1.0 / 24);
  growth *= growth;
  growth *= growth;
  const Lanes change = smaller(query.kernel.sigma * growth, 0.4 * t);
  // t changes over the cluster by a along the line of sight and by b across it; a^2 and b are kept.
  const Lanes a = root(depth_sq) / change, b = 0.25 * radius * radius / (t * change);
  const Lanes error = a * b + 0.5 * b * b + a * a * a * (1.0 / 6);
  return {nearest > query.kernel.longest, radius < 0.7 * t ? error : all(1e30)};
}

// Int_t^longest of the kernel.
[[gnu::always_inline]] inline Complex tail(const SkeletalKernel& kernel, const Lanes& t) {
  const Lanes y = larger(smaller((1.0 / t - kernel.middle) / kernel.half, all(1.0)), all(-1.0));
  const Lanes twice = y + y;
  Lanes re1 = {}, re2 = {}, im1 = {}, im2 = {};
  for (int k = kSkeletalTerms - 1; k > 0; --k) {
    const Lanes re = kernel.tail_real[k] + twice * re1 - re2,
                im = kernel.tail_imag[k] + twice * im1 - im2;
    re2 = re1;
    re1 = re;
    im2 = im1;
    im1 = im;
  }
  return {kernel.tail_real[0] + y * re1 - re2, kernel.tail_imag[0] + y * im1 - im2};
}

struct Plain {
  double re, im;
};

Plain tail_at(const SkeletalKernel& kernel, double t) {
  const Complex value = tail(kernel, all(t));
  return {value.re[0], value.im[0]};
}

// Int over s in [from, to] of (tail(sqrt(near_sq + s^2)) - least) d / (d^2 + s^2).
Plain along(const SkeletalKernel& kernel, double near_sq, double d, const Plain& least, double from,
            double to) {
  Lanes re = {}, im = {};
  const double length = to - from;
  for (int k = 0; k < kSkeletalNodes; k += kLanes) {
    const Lanes s = from + length * load<Lanes>(kernel.nodes + k);
    const Complex value = tail(kernel, root(near_sq + s * s));
    const Lanes w = load<Lanes>(kernel.weights + k) / (d * d + s * s);
    re += w * (value.re - least.re);
    im += w * (value.im - least.im);
  }
  return {sum(re) * length * d, sum(im) * length * d};
}

// The integral over one triangle of any size: in polar coordinates about the point's foot on its
// plane only integrals along the edges are left.
Plain whole_triangle(const Query& query, const TrianglePacket& packet, int l) {
  const SkeletalKernel& kernel = query.kernel;
  double corner[3][3], n[3];
  for (int a = 0; a < 3; ++a) {
    corner[0][a] = (packet.corner[a][l] - query.point[a]) * query.scale;
    corner[1][a] = corner[0][a] + packet.edge1[a][l] * query.scale;
    corner[2][a] = corner[0][a] + packet.edge2[a][l] * query.scale;
    n[a] = packet.normal[a][l];
  }
  const double h = corner[0][0] * n[0] + corner[0][1] * n[1] + corner[0][2] * n[2];
  if (h == 0.0) return {0.0, 0.0};
  const double longest_sq = kernel.longest * kernel.longest;
  if (h * h >= longest_sq) return {0.0, 0.0};
  Plain edges = {0.0, 0.0};
  bool inside = true;
  for (int e = 0; e < 3; ++e) {
    const double* a = corner[e];
    const double* b = corner[(e + 1) % 3];
    double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double length_sq = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
    if (!(length_sq > 0.0)) continue;
    const double inverse = 1.0 / __builtin_sqrt(length_sq);
    for (double& component : u) component *= inverse;
    // Signed distance of the edge from the foot, > 0 where the foot is on the triangle's side.
    const double m[3] = {u[1] * n[2] - u[2] * n[1], u[2] * n[0] - u[0] * n[2],
                         u[0] * n[1] - u[1] * n[0]};
    double d = a[0] * m[0] + a[1] * m[1] + a[2] * m[2];
    if (d >= 0.0) d += 1e-30;  // a foot on the edge is on the triangle's side
    inside = inside && d > 0.0;
    const double near_sq = h * h + d * d;
    if (near_sq >= longest_sq) continue;
    const double furthest = __builtin_sqrt(longest_sq - near_sq);
    double from = a[0] * u[0] + a[1] * u[1] + a[2] * u[2], to = from + length_sq * inverse;
    if (from < -furthest) from = -furthest;
    if (to > furthest) to = furthest;
    if (!(from < to)) continue;
    const double swept =
        __builtin_atan2(to, d < 0.0 ? -d : d) - __builtin_atan2(from, d < 0.0 ? -d : d);
    // The kernel's tail changes fast in the angle where the foot is near the edge: its value at the
    // edge's nearest point times the angle, and the smooth rest by Gauss's rule.
    const Plain least = tail_at(kernel, __builtin_sqrt(near_sq));
    const double angle = d < 0.0 ? -swept : swept;
    edges.re += least.re * angle;
    edges.im += least.im * angle;
    if (from < 0.0 && to > 0.0) {
      const Plain left = along(kernel, near_sq, d, least, from, 0.0);
      const Plain right = along(kernel, near_sq, d, least, 0.0, to);
      edges.re += left.re + right.re;
      edges.im += left.im + right.im;
    } else {
      const Plain rest = along(kernel, near_sq, d, least, from, to);
      edges.re += rest.re;
      edges.im += rest.im;
    }
  }
  Plain result = {-edges.re, -edges.im};
  if (inside) {
    const Plain foot = tail_at(kernel, h < 0.0 ? -h : h);
    result.re += kTwoPi * foot.re;
    result.im += kTwoPi * foot.im;
  }
  return {h * result.re, h * result.im};
}

// Rules for triangles: degree 2 by the middles of the edges, degree 5 by Radon's seven points.
// Weights of the second and third corner, share of the area.
struct RulePoint {
  double second, third, share;
};
constexpr RulePoint kDegreeTwo[] = {{0.5, 0.0, 1.0 / 3}, {0.5, 0.5, 1.0 / 3}, {0.0, 0.5, 1.0 / 3}};
constexpr double kNear = 0.10128650732345634, kNearShare = 0.12593918054482715;
constexpr double kWide = 0.47014206410511509, kWideShare = 0.13239415278850618;
constexpr RulePoint kDegreeFive[] = {{1.0 / 3, 1.0 / 3, 0.225},
                                     {kNear, kNear, kNearShare},
                                     {1.0 - 2 * kNear, kNear, kNearShare},
                                     {kNear, 1.0 - 2 * kNear, kNearShare},
                                     {kWide, kWide, kWideShare},
                                     {1.0 - 2 * kWide, kWide, kWideShare},
                                     {kWide, 1.0 - 2 * kWide, kWideShare}};

template <int N>
[[gnu::always_inline]] inline void add_rule(const Query& query, const RulePoint (&rule)[N],
                                            const Lanes3& a, const Lanes3& e1, const Lanes3& e2,
                                            const LaneMask& counted, Complex& total) {
  const Lanes3 area = cross(e1, e2);  // normal times twice the area
  Complex value = {};
  for (const RulePoint& p : rule) {
    const Lanes3 x = {a.x + p.second * e1.x + p.third * e2.x,
                      a.y + p.second * e1.y + p.third * e2.y,
                      a.z + p.second * e1.z + p.third * e2.z};
    const Lanes t = root(dot(x, x));
    const Complex k = kernel_at(query, t);
    const Lanes w = 0.5 * p.share * dot(x, area) / t;
    value.re += k.re * w;
    value.im += k.im * w;
  }
  total.re += counted ? value.re : all(0.0);
  total.im += counted ? value.im : all(0.0);
}

void add_packet(const Query& query, const TrianglePacket& packet, Complex& total, Plain& large) {
  for (int l = 0; l < kTreeWidth; l += kLanes) {
    const Lanes3 q = {all(query.point[0]), all(query.point[1]), all(query.point[2])};
    Lanes3 a = minus(load3(packet.corner, l), q), e1 = load3(packet.edge1, l),
           e2 = load3(packet.edge2, l);
    Lanes3* const vectors[] = {&a, &e1, &e2};
    for (Lanes3* v : vectors) {
      v->x *= query.scale;
      v->y *= query.scale;
      v->z *= query.scale;
    }
    const Lanes3 to_a = {(e1.x + e2.x) * (-1.0 / 3), (e1.y + e2.y) * (-1.0 / 3),
                         (e1.z + e2.z) * (-1.0 / 3)};  // from the centre
    const Lanes3 centre = minus(a, to_a);
    const Lanes3 to_b = {to_a.x + e1.x, to_a.y + e1.y, to_a.z + e1.z};
    const Lanes3 to_c = {to_a.x + e2.x, to_a.y + e2.y, to_a.z + e2.z};
    const Lanes radius = root(larger(larger(dot(to_a, to_a), dot(to_b, to_b)), dot(to_c, to_c)));
    const Lanes t_sq = dot(centre, centre);
    const Lanes depth_a = dot(to_a, centre), depth_b = dot(to_b, centre),
                depth_c = dot(to_c, centre);
    const Lanes depth_sq =
        (depth_a * depth_a + depth_b * depth_b + depth_c * depth_c) / (12.0 * t_sq);
    const Verdict verdict = judge(query, root(t_sq), radius, depth_sq);
    Lanes number;
    for (int k = 0; k < kLanes; ++k) number[k] = l + k;
    const LaneMask wanted = ~verdict.far & (number < static_cast<double>(packet.count));
    const LaneMask small = wanted & (verdict.error <= query.kernel.allowed);
    const LaneMask middling = wanted & ~small & (verdict.error <= query.kernel.allowed_degree_five);
    if (bits(small) != 0) add_rule(query, kDegreeTwo, a, e1, e2, small, total);
    if (bits(middling) != 0) add_rule(query, kDegreeFive, a, e1, e2, middling, total);
    for (unsigned rest = bits(wanted & ~small & ~middling); rest != 0; rest &= rest - 1) {
      const Plain value = whole_triangle(query, packet, l + __builtin_ctz(rest));
      large.re += value.re;
      large.im += value.im;
    }
  }
}

// The moments' part of the integral for lanes l on (see TreeNode).
[[gnu::always_inline]] inline Complex by_moments(const Query& query, const TreeNode& node, int l,
                                                 const Lanes3& r, const Lanes& t) {
  Lanes m[kTreeMoments];
  const double scale_sq = query.scale * query.scale;
  for (int k = 0; k < kTreeMoments; ++k) m[k] = load<Lanes>(node.moments[k] + l);
  const Lanes xx = r.x * r.x, yy = r.y * r.y, zz = r.z * r.z;
  const Lanes first = (m[0] * r.x + m[1] * r.y + m[2] * r.z) * scale_sq;
  const Lanes trace = (m[3] + m[4] + m[5]) * (scale_sq * query.scale);
  const Lanes square =
      (m[3] * xx + m[4] * yy + m[5] * zz + m[6] * r.x * r.y + m[7] * r.x * r.z + m[8] * r.y * r.z) *
      (scale_sq * query.scale);
  const Lanes slope = ((3.0 * m[9] + m[14] + m[16]) * r.x + (3.0 * m[10] + m[12] + m[17]) * r.y +
                       (3.0 * m[11] + m[13] + m[15]) * r.z) *
                      (scale_sq * scale_sq);
  const Lanes cubic = (xx * (m[9] * r.x + m[12] * r.y + m[13] * r.z) +
                       yy * (m[10] * r.y + m[14] * r.x + m[15] * r.z) +
                       zz * (m[11] * r.z + m[16] * r.x + m[17] * r.y) + m[18] * r.x * r.y * r.z) *
                      (scale_sq * scale_sq);
  // psi = kernel / t; psi' = psi L; psi1 = psi' / t; psi2 = psi1' / t.
  const Complex kernel = kernel_at(query, t);
  const Lanes inverse = 1.0 / t, u = 1.0 / (1.0 + t * t);
  const double steep = query.inverse_sigma * query.inverse_sigma;
  const Complex L = {-2.0 * t * u - (t - 1.0) * steep - inverse, -2.0 * u};
  const Lanes uu = u * u;
  const Complex slope_of_l = {-2.0 * (1.0 - t * t) * uu - steep + inverse * inverse, 4.0 * t * uu};
  Complex bend = times(L, L);  // psi2 / psi t^2
  bend.re += slope_of_l.re - L.re * inverse;
  bend.im += slope_of_l.im - L.im * inverse;
  const Lanes by_psi1 = (square + slope) * inverse, by_psi2 = cubic * inverse * inverse;
  const Complex factor = {first + trace + by_psi1 * L.re + by_psi2 * bend.re,
                          by_psi1 * L.im + by_psi2 * bend.im};
  Complex value = times(kernel, factor);
  value.re *= inverse;
  value.im *= inverse;
  return value;
}

void integrate_at(const TreeView& tree, const Query& query, double* result) {
  int stack[kTreeStack];
  int depth = 0;
  stack[depth++] = 0;
  Complex total = {};
  Plain large = {0.0, 0.0};
  while (depth > 0) {
    const int child = stack[--depth];
    if (child < 0) {
      add_packet(query, tree.packets[-1 - child], total, large);
      continue;
    }
    const TreeNode& node = tree.nodes[child];
    unsigned open = 0;
    for (int l = 0; l < kTreeWidth; l += kLanes) {
      const Lanes3 q = {all(query.point[0]), all(query.point[1]), all(query.point[2])};
      Lanes3 r = minus(load3(node.centre, l), q);
      r.x *= query.scale;
      r.y *= query.scale;
      r.z *= query.scale;
      const Lanes t = root(dot(r, r));
      Lanes c[6];
      for (int k = 0; k < 6; ++k) c[k] = load<Lanes>(node.spread[k] + l);
      const Lanes along_sq = r.x * (c[0] * r.x + c[3] * r.y + c[4] * r.z) +
                             r.y * (c[1] * r.y + c[5] * r.z) + c[2] * r.z * r.z;
      const double scale_sq = query.scale * query.scale;
      const Lanes depth_sq = larger(along_sq * scale_sq / dot(r, r), all(0.0));
      const Verdict verdict = judge(query, t, load<Lanes>(node.radius + l) * query.scale, depth_sq);
      const LaneMask smooth_lanes = verdict.error <= query.kernel.allowed;
      const unsigned there = ((1u << node.count) - 1) >> l & ((1u << kLanes) - 1);
      const unsigned wanted = ~bits(verdict.far) & there;
      const unsigned smooth = wanted & bits(smooth_lanes);
      open |= (wanted & ~smooth) << l;
      if (smooth == 0) continue;
      const Complex value = by_moments(query, node, l, r, t);
      const LaneMask counted = ~verdict.far & smooth_lanes;
      total.re += counted ? value.re : all(0.0);
      total.im += counted ? value.im : all(0.0);
    }
    for (; open != 0; open &= open - 1) stack[depth++] = node.child[__builtin_ctz(open)];
  }
  result[0] = sum(total.re) + large.re;
  result[1] = sum(total.im) + large.im;
}

void integrate(const TreeView& tree, const SkeletalKernel& kernel, const double* points,
               const double* distances, std::ptrdiff_t count, double* real_imag) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double inverse_sigma = 1.0 / kernel.sigma;
    const Query query = {kernel,
                         {points[3 * i], points[3 * i + 1], points[3 * i + 2]},
                         1.0 / distances[i],
                         inverse_sigma,
                         inverse_sigma / kRootTwoPi};
    integrate_at(tree, query, real_imag + 2 * i);
  }
}

}  // namespace

const SkeletalTable kSkeletalTable = {integrate};

}  // namespace mortise::MORTISE_ISA
