// SPDX-License-Identifier: GPL-3.0-or-later
// Cubic interpolation of maps at many points; compiled once per instruction set (see
// cmake/MortiseIsa.cmake for what that forbids here).
#include "scoring/field_isa.hpp"

namespace mortise::MORTISE_ISA {
extern const FieldTable kFieldTable;

namespace {

using Quad __attribute__((vector_size(32))) = double;
using QuadFloat __attribute__((vector_size(16))) = float;

[[gnu::always_inline]] inline void load(const float* p, Quad& v) {
  QuadFloat f;
  __builtin_memcpy(&f, p, sizeof f);
  v = __builtin_convertvector(f, Quad);
}

// Keys' cubic weights (a = -1/2) of grid points -1, 0, 1, 2 at 0 <= t < 1, and their slopes.
[[gnu::always_inline]] inline void weights_at(double t, Quad& w, Quad& slope) {
  constexpr Quad c0 = {0.0, 1.0, 0.0, 0.0}, c1 = {-0.5, 0.0, 0.5, 0.0};
  constexpr Quad c2 = {1.0, -2.5, 2.0, -0.5}, c3 = {-0.5, 1.5, -1.5, 0.5};
  w = c0 + t * (c1 + t * (c2 + t * c3));
  slope = c1 + t * (2.0 * c2 + t * (3.0 * c3));
}

[[gnu::always_inline]] inline double sum_of(const Quad& v) { return (v[0] + v[2]) + (v[1] + v[3]); }

void evaluate(const FieldMaps& maps, const FieldPoints& points, const double* rotation,
              const double* centre, double* out) {
  const FieldMaps m = maps;  // local copies cannot alias `out`
  const FieldPoints p = points;
  double r[9];
  for (int i = 0; i < 9; ++i) r[i] = rotation[i];
  const double c[3] = {centre[0], centre[1], centre[2]};
  const std::ptrdiff_t row = m.size[2], plane = row * m.size[1], map = plane * m.size[0];
  const double top[3] = {static_cast<double>(m.size[0] - 2), static_cast<double>(m.size[1] - 2),
                         static_cast<double>(m.size[2] - 2)};
  double value = 0.0, force[3] = {0.0, 0.0, 0.0}, torque[3] = {0.0, 0.0, 0.0};
  for (std::ptrdiff_t n = 0; n < p.count; ++n) {
    const double x = p.x[n], y = p.y[n], z = p.z[n];
    const double a = r[0] * x + r[1] * y + r[2] * z, u = a + c[0];
    const double b = r[3] * x + r[4] * y + r[5] * z, v = b + c[1];
    const double d = r[6] * x + r[7] * y + r[8] * z, w = d + c[2];
    if (!(u >= 1.0 && u < top[0] && v >= 1.0 && v < top[1] && w >= 1.0 && w < top[2])) continue;
    const auto i = static_cast<std::ptrdiff_t>(u), j = static_cast<std::ptrdiff_t>(v),
               k = static_cast<std::ptrdiff_t>(w);
    const std::ptrdiff_t cell = i * plane + j * row + k;
    if (m.nearby[cell] == 0) continue;
    Quad wx, wy, wz, sx, sy, sz;
    weights_at(u - static_cast<double>(i), wx, sx);
    weights_at(v - static_cast<double>(j), wy, sy);
    weights_at(w - static_cast<double>(k), wz, sz);
    const std::ptrdiff_t corner = cell - plane - row - 1;
    const bool typed = p.types[n] >= 0;
    const float* one = m.values + (typed ? p.types[n] : m.shape) * map + corner;
    const float* two = m.values + m.shape * map + corner;
    const double first = typed ? m.contact_factor : 0.0, second = m.shape_factor * p.weights[n];
    // Along z in lanes; x, then y summed up.
    Quad plain = {}, along_x = {}, along_y = {};
    for (int s = 0; s < 4; ++s) {
      Quad line = {}, slope = {};
      for (int q = 0; q < 4; ++q) {
        Quad f, g;
        load(one + q * plane + s * row, f);
        load(two + q * plane + s * row, g);
        f = first * f + second * g;
        line += wx[q] * f;
        slope += sx[q] * f;
      }
      plain += wy[s] * line;
      along_y += sy[s] * line;
      along_x += wy[s] * slope;
    }
    const double fx = sum_of(along_x * wz), fy = sum_of(along_y * wz), fz = sum_of(plain * sz);
    value += sum_of(plain * wz);
    force[0] += fx;
    force[1] += fy;
    force[2] += fz;
    torque[0] += b * fz - d * fy;
    torque[1] += d * fx - a * fz;
    torque[2] += a * fy - b * fx;
  }
  out[0] = value;
  for (int i = 0; i < 3; ++i) {
    out[1 + i] = force[i];
    out[4 + i] = torque[i];
  }
}

}  // namespace

const FieldTable kFieldTable = {evaluate};

}  // namespace mortise::MORTISE_ISA
