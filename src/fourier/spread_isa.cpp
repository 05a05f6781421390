// SPDX-License-Identifier: GPL-3.0-or-later
// The spreading loops; compiled once per instruction set (see cmake/MortiseIsa.cmake for what that
// forbids here).
#include "fourier/spread_isa.hpp"

#include "core/isa_vector.hpp"

namespace mortise::MORTISE_ISA {
extern const SpreadTables kSpreadTables;

namespace {

template <class Real, int Lanes>
struct VectorOf {
  using Type __attribute__((vector_size(sizeof(Real) * Lanes))) = Real;
};

constexpr int power_of_two_at_least(int n) {
  return n <= 1 ? 1 : 2 * power_of_two_at_least((n + 1) / 2);
}

// How `W` kernel values are laid out in vectors: the narrowest vector that holds them all, else
// several of the widest.
template <class Real, int W>
struct Layout {
  static constexpr int kWidest = kVectorBytes / static_cast<int>(sizeof(Real));
  static constexpr int kNarrowest = 16 / static_cast<int>(sizeof(Real));
  static constexpr int kWanted = power_of_two_at_least(W);
  static constexpr int kLanes = kWanted > kWidest      ? kWidest
                                : kWanted < kNarrowest ? kNarrowest
                                                       : kWanted;
  static constexpr int kBlocks = (W + kLanes - 1) / kLanes;
  static constexpr int kPadded = kLanes * kBlocks;
};

// Kernel values of one axis: piece j at `z` for all j at once.
template <class Real, int W>
[[gnu::always_inline]] inline void evaluate(const SpreadJob<Real>& job, Real z, Real* values) {
  using L = Layout<Real, W>;
  using V = typename VectorOf<Real, L::kLanes>::Type;
  for (int b = 0; b < L::kBlocks; ++b) {
    const Real* c = job.coefficients + b * L::kLanes;
    V v = load<V>(c);
    for (int d = 0; d < job.degree; ++d) {
      c += L::kPadded;
      v = v * z + load<V>(c);
    }
    store(values + b * L::kLanes, v);
  }
}

template <class Real, int D, int W, bool Complex>
void spread_width(const SpreadJob<Real>& job, const SpreadPoints<Real>& points) {
  using L = Layout<Real, W>;
  using V = typename VectorOf<Real, L::kLanes>::Type;
  constexpr int kParts = Complex ? 2 : 1;
  constexpr int kVectors = L::kBlocks * kParts;
  alignas(64) Real values[D][L::kPadded];
  alignas(64) Real line[L::kPadded * kParts];  // last axis times the weight
  const SpreadJob<Real> j = job;               // a local copy cannot alias the grid
  for (std::ptrdiff_t n = 0; n < points.count; ++n) {
    const std::ptrdiff_t i = points.order ? points.order[n] : n;
    const std::int32_t* start = points.start + D * i;
    for (int d = 0; d < D; ++d) evaluate<Real, W>(j, points.fraction[D * i + d], values[d]);
    const Real* last = values[D - 1];
    if constexpr (Complex) {
      const Real re = points.weights[2 * i], im = points.weights[2 * i + 1];
      for (int q = 0; q < L::kPadded; ++q) {
        line[2 * q] = last[q] * re;
        line[2 * q + 1] = last[q] * im;
      }
    } else {
      const Real re = points.weights[i];
      for (int q = 0; q < L::kPadded; ++q) line[q] = last[q] * re;
    }
    V base[kVectors];
    for (int q = 0; q < kVectors; ++q) base[q] = load<V>(line + q * L::kLanes);
    Real* const origin = j.grid + kParts * start[D - 1];
    const std::ptrdiff_t* const offset0 = j.offsets[0] + start[0];
    const std::ptrdiff_t* const offset1 = j.offsets[1] + start[1];
    for (int a = 0; a < W; ++a) {
      Real* const block = origin + offset0[a];
      for (int b = 0; b < W; ++b) {
        const Real ab = values[0][a] * values[1][b];
        V scaled[kVectors];
        for (int q = 0; q < kVectors; ++q) scaled[q] = base[q] * ab;
        if constexpr (D == 3) {
          Real* const row = block + offset1[b];
          for (int q = 0; q < kVectors; ++q)
            store(row + q * L::kLanes, load<V>(row + q * L::kLanes) + scaled[q]);
        } else {
          Real* const plane = block + offset1[b];
          const std::ptrdiff_t* const offset2 = j.offsets[2] + start[2];
          for (int c = 0; c < W; ++c) {
            Real* const row = plane + offset2[c];
            const Real weight = values[2][c];
            for (int q = 0; q < kVectors; ++q)
              store(row + q * L::kLanes, load<V>(row + q * L::kLanes) + scaled[q] * weight);
          }
        }
      }
    }
  }
}

template <class Real, int D, bool Complex>
void spread_any(const SpreadJob<Real>& job, const SpreadPoints<Real>& points) {
  switch (job.width) {
    case 2:
      return spread_width<Real, D, 2, Complex>(job, points);
    case 3:
      return spread_width<Real, D, 3, Complex>(job, points);
    case 4:
      return spread_width<Real, D, 4, Complex>(job, points);
    case 5:
      return spread_width<Real, D, 5, Complex>(job, points);
    case 6:
      return spread_width<Real, D, 6, Complex>(job, points);
    case 7:
      return spread_width<Real, D, 7, Complex>(job, points);
    case 8:
      return spread_width<Real, D, 8, Complex>(job, points);
    case 9:
      return spread_width<Real, D, 9, Complex>(job, points);
    case 10:
      return spread_width<Real, D, 10, Complex>(job, points);
    case 11:
      return spread_width<Real, D, 11, Complex>(job, points);
    case 12:
      return spread_width<Real, D, 12, Complex>(job, points);
    case 13:
      return spread_width<Real, D, 13, Complex>(job, points);
    case 14:
      return spread_width<Real, D, 14, Complex>(job, points);
    case 15:
      return spread_width<Real, D, 15, Complex>(job, points);
    default:
      return spread_width<Real, D, 16, Complex>(job, points);
  }
}

template <class Real>
int padded_width(int width) {
  switch (width) {
    case 2:
      return Layout<Real, 2>::kPadded;
    case 3:
      return Layout<Real, 3>::kPadded;
    case 4:
      return Layout<Real, 4>::kPadded;
    case 5:
      return Layout<Real, 5>::kPadded;
    case 6:
      return Layout<Real, 6>::kPadded;
    case 7:
      return Layout<Real, 7>::kPadded;
    case 8:
      return Layout<Real, 8>::kPadded;
    case 9:
      return Layout<Real, 9>::kPadded;
    case 10:
      return Layout<Real, 10>::kPadded;
    case 11:
      return Layout<Real, 11>::kPadded;
    case 12:
      return Layout<Real, 12>::kPadded;
    case 13:
      return Layout<Real, 13>::kPadded;
    case 14:
      return Layout<Real, 14>::kPadded;
    case 15:
      return Layout<Real, 15>::kPadded;
    default:
      return Layout<Real, 16>::kPadded;
  }
}

// Smallest whole number >= x for |x| < 2^31, without a call into the maths library.
[[gnu::always_inline]] inline std::int32_t ceiling(double x) {
  const auto t = static_cast<std::int32_t>(x);
  return t + (static_cast<double>(t) < x ? 1 : 0);
}

template <class Real>
bool prepare(int dim, const double* points, std::ptrdiff_t stride, std::ptrdiff_t count,
             const double* inverse_box, const std::int32_t* size, int width, std::int32_t* start,
             Real* fraction) {
  bool finite = true;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    for (int d = 0; d < dim; ++d) {
      double t = points[stride * i + d] * inverse_box[d];
      t -= __builtin_floor(t);
      const bool good = t >= 0.0 && t <= 1.0;  // false for NaN, which infinity has become
      finite = finite && good;
      const double g = (good ? t : 0.0) * size[d];
      const std::int32_t first = ceiling(g - 0.5 * width);
      start[dim * i + d] = first < 0 ? first + size[d] : first;
      fraction[dim * i + d] = static_cast<Real>(2.0 * (first - g + 0.5 * width) - 1.0);
    }
  }
  return finite;
}

template <class Real>
constexpr SpreadTable<Real> table() {
  return {padded_width<Real>,
          prepare<Real>,
          {{spread_any<Real, 3, false>, spread_any<Real, 3, true>},
           {spread_any<Real, 4, false>, spread_any<Real, 4, true>}}};
}

}  // namespace

const SpreadTables kSpreadTables = {table<float>(), table<double>()};

}  // namespace mortise::MORTISE_ISA
