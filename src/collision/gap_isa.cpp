// SPDX-License-Identifier: GPL-3.0-or-later
// The truncated sum of the gap function with its gradient; compiled once per instruction set (see
// cmake/MortiseIsa.cmake for what that forbids here).
//
// Per mode 64 complex samples are contracted, axis by axis, with the kernel's values and
// derivatives. Sums stay in vector lanes, (re, im) of two neighbours in y and four in z, until the
// very end: a product with (P_re, P_im, P_re, ...) leaves Re(P conj G), one with (P_im, -P_re, ...)
// leaves Im(P conj G), spread over lanes that only have to be added.
#include "collision/gap_isa.hpp"

#include "core/isa_vector.hpp"

namespace mortise::MORTISE_ISA {
extern const GapTable kGapTable;

namespace {

constexpr int kLanes = kVectorBytes / 4;
constexpr int kParts = 16 / kLanes;
using Vector __attribute__((vector_size(kVectorBytes))) = float;
using Eight __attribute__((vector_size(8 * sizeof(float)))) = float;
using Sixteen __attribute__((vector_size(16 * sizeof(float)))) = float;

// Vectors wider than the processor's go by reference: they have no place in its calling convention.
template <class V>
[[gnu::always_inline]] inline void load(const float* p, V& v) {
  __builtin_memcpy(&v, p, sizeof v);
}

// 16 lanes as one to four registers.
struct Lanes {
  Vector part[kParts];
};

[[gnu::always_inline]] inline Lanes zero() {
  Lanes r;
  for (Vector& part : r.part) part = Vector{};
  return r;
}

// The kernel's four values and four derivatives along y and along z at one mode.
struct Weights {
#if defined(__AVX512F__)
  Sixteen yz;
#else
  Eight y, z;
#endif
};

// Kernel values w[0..3] over the four z, each on four lanes.
[[gnu::always_inline]] inline Lanes along_z(const Weights& w, bool derivative) {
  Lanes r;
#if defined(__AVX512F__)
  r.part[0] = derivative ? __builtin_shufflevector(w.yz, w.yz, 12, 12, 12, 12, 13, 13, 13, 13, 14,
                                                   14, 14, 14, 15, 15, 15, 15)
                         : __builtin_shufflevector(w.yz, w.yz, 8, 8, 8, 8, 9, 9, 9, 9, 10, 10, 10,
                                                   10, 11, 11, 11, 11);
#elif defined(__AVX2__)
  r.part[0] = derivative ? __builtin_shufflevector(w.z, w.z, 4, 4, 4, 4, 5, 5, 5, 5)
                         : __builtin_shufflevector(w.z, w.z, 0, 0, 0, 0, 1, 1, 1, 1);
  r.part[1] = derivative ? __builtin_shufflevector(w.z, w.z, 6, 6, 6, 6, 7, 7, 7, 7)
                         : __builtin_shufflevector(w.z, w.z, 2, 2, 2, 2, 3, 3, 3, 3);
#else
  for (int p = 0; p < kParts; ++p) {
    const float x = w.z[(derivative ? 4 : 0) + p];
    r.part[p] = Vector{x, x, x, x};
  }
#endif
  return r;
}

// Kernel values w[first], w[first + 1] over a pair in y, (re, im) each.
template <int First>
[[gnu::always_inline]] inline Vector along_y(const Weights& w) {
  constexpr int a = First, b = First + 1;
#if defined(__AVX512F__)
  return __builtin_shufflevector(w.yz, w.yz, a, a, b, b, a, a, b, b, a, a, b, b, a, a, b, b);
#elif defined(__AVX2__)
  return __builtin_shufflevector(w.y, w.y, a, a, b, b, a, a, b, b);
#else
  return Vector{w.y[a], w.y[a], w.y[b], w.y[b]};
#endif
}

// (p[0], p[1]) repeated.
[[gnu::always_inline]] inline Vector pair(const float* p) {
  using Longs __attribute__((vector_size(kVectorBytes))) = long long;
  long long both;
  __builtin_memcpy(&both, p, sizeof both);
  const Longs repeated = both | Longs{};
  return reinterpret_cast<Vector>(repeated);
}

// One block's frequencies, cells, coefficients.
struct Block {
  alignas(64) float u[3][kModeBlock];  // samples, from the table's centre
  alignas(64) float z[3][kModeBlock];  // place in the cell, in [-1, 1]
  alignas(64) int cell[3][kModeBlock];
  alignas(64) float cosine[2 * kModeBlock];             // (re, im) of P
  alignas(64) float sine[2 * kModeBlock];               // (im, -re) of P
  alignas(64) float along_x[2 * kStencil][kModeBlock];  // kernel: values, then derivatives
};

[[gnu::always_inline]] inline void prepare(const GapJob& job, std::ptrdiff_t first, Block& block) {
  const float* kx = job.kx + first;
  const float* ky = job.ky + first;
  const float* kz = job.kz + first;
  for (int d = 0; d < 3; ++d) {
    const float a = job.turn[3 * d], b = job.turn[3 * d + 1], c = job.turn[3 * d + 2];
    for (int i = 0; i < kModeBlock; ++i) {
      const float u = a * kx[i] + b * ky[i] + c * kz[i];
      const float place = u + job.centre;  // > 0
      const int cell = static_cast<int>(place);
      block.u[d][i] = u;
      block.cell[d][i] = cell - 1;
      block.z[d][i] = 1.0F - 2.0F * (place - static_cast<float>(cell));
    }
  }
  float re[kModeBlock], im[kModeBlock];
  const float tx = job.translation[0], ty = job.translation[1], tz = job.translation[2];
  for (int i = 0; i < kModeBlock; ++i) {
    const float turns = kx[i] * tx + ky[i] * ty + kz[i] * tz;
    const float nearest = (turns + 12582912.0F) - 12582912.0F;         // 1.5 * 2^23: rounds
    const float x = 3.14159265358979F * (turns - nearest), y = x * x;  // |x| <= pi / 2
    const float s =
        x * (1.0F + y * (-1.66666667e-1F +
                         y * (8.33333333e-3F +
                              y * (-1.98412698e-4F + y * (2.75573192e-6F + y * -2.50521084e-8F)))));
    const float c =
        1.0F +
        y * (-0.5F + y * (4.16666667e-2F +
                          y * (-1.38888889e-3F +
                               y * (2.48015873e-5F + y * (-2.75573192e-7F + y * 2.08767570e-9F)))));
    const float cosine = 1.0F - 2.0F * s * s, sine = 2.0F * s * c;
    const float a = job.real[first + i], b = job.imag[first + i];
    re[i] = a * cosine - b * sine;
    im[i] = a * sine + b * cosine;
  }
  for (int i = 0; i < kModeBlock; ++i) {
    block.cosine[2 * i] = re[i];
    block.cosine[2 * i + 1] = im[i];
  }
  for (int i = 0; i < kModeBlock; ++i) {
    block.sine[2 * i] = im[i];
    block.sine[2 * i + 1] = -re[i];
  }
}

// The kernel along x, mode beside mode: its values are wanted as scalars, one per x.
[[gnu::always_inline]] inline void weigh_x(const float* pieces, Block& block) {
  for (int tap = 0; tap < 2 * kStencil; ++tap)
    for (int i = 0; i < kModeBlock; ++i) {
      const float z = block.z[0][i];
      float w = pieces[tap];
      for (int term = 1; term < kPieceTerms; ++term) w = w * z + pieces[8 * term + tap];
      block.along_x[tap][i] = w;
    }
}

// The kernel along y and z. `pieces`: twice side by side for AVX-512.
[[gnu::always_inline]] inline void weigh_yz(const float* pieces, float y, float z, Weights& w) {
#if defined(__AVX512F__)
  using Mask __attribute__((vector_size(64))) = int;
  constexpr Mask kLow = {-1, -1, -1, -1, -1, -1, -1, -1, 0, 0, 0, 0, 0, 0, 0, 0};
  const Sixteen place = kLow ? y - Sixteen{} : z - Sixteen{};  // plus zero would be an addition
  load(pieces, w.yz);
  for (int term = 1; term < kPieceTerms; ++term) {
    Sixteen next;
    load(pieces + 16 * term, next);
    w.yz = w.yz * place + next;
  }
#else
  load(pieces, w.y);
  load(pieces, w.z);
  for (int term = 1; term < kPieceTerms; ++term) {
    Eight next;
    load(pieces + 8 * term, next);
    w.y = w.y * y + next;
    w.z = w.z * z + next;
  }
#endif
}

// The pieces as weigh_yz wants them.
struct PiecesYz {
#if defined(__AVX512F__)
  alignas(64) float twice[16 * kPieceTerms];
  explicit PiecesYz(const float* pieces) {
    for (int i = 0; i < 16 * kPieceTerms; ++i) twice[i] = pieces[i / 16 * 8 + i % 8];
  }
#else
  const float* twice;
  explicit PiecesYz(const float* pieces) : twice(pieces) {}
#endif
};

// Keeps the compiler from reading the same memory again at each use: most of these reads cross two
// cache lines.
[[gnu::always_inline]] inline void load_once(const float* p, Vector& v) {
  load(p, v);
#if defined(__x86_64__)
  __asm__("" : "+v"(v));
#endif
}

double total(const Lanes& lanes) {
  float values[16];
  __builtin_memcpy(values, &lanes, sizeof values);
  double sum = 0.0;
  for (const float v : values) sum += static_cast<double>(v);
  return sum;
}

void sum(const GapJob& job, GapSums* sums) {
  const PiecesYz pieces(job.pieces);
  double value = 0.0, translation[3] = {}, rotation[3] = {};
  Lanes v = zero(), t[3] = {zero(), zero(), zero()}, r[3] = {zero(), zero(), zero()};
  for (std::ptrdiff_t first = 0; first < job.count; first += kModeBlock) {
    Block block;
    prepare(job, first, block);
    weigh_x(job.pieces, block);
    for (int i = 0; i < kModeBlock; ++i) {
      Weights w;
      weigh_yz(pieces.twice, block.z[1][i], block.z[2][i], w);
      const Lanes z0 = along_z(w, false), z1 = along_z(w, true);
      const Vector ya[2] = {along_y<0>(w), along_y<2>(w)}, yb[2] = {along_y<4>(w), along_y<6>(w)};
      const float* corner = job.table + block.cell[0][i] * job.stride_x +
                            block.cell[1][i] * job.stride_y +
                            static_cast<std::ptrdiff_t>(4) * block.cell[2][i];
      const Vector cosine = pair(block.cosine + 2 * i), sine = pair(block.sine + 2 * i);
      const float ux = block.u[0][i], uy = block.u[1][i], uz = block.u[2][i];
      const float kx = job.kx[first + i], ky = job.ky[first + i], kz = job.kz[first + i];
      for (int p = 0; p < kParts; ++p) {
        Vector g = {}, gx = {}, gy = {};
        for (int y = 0; y < 2; ++y) {
          const float* row = corner + 2 * y * job.stride_y + p * kLanes;
          Vector a = {}, ax = {};
          for (int x = 0; x < kStencil; ++x) {
            Vector sample;
            load_once(row + x * job.stride_x, sample);
            a += sample * block.along_x[x][i];
            ax += sample * block.along_x[kStencil + x][i];
          }
          g += a * ya[y];
          gx += ax * ya[y];
          gy += a * yb[y];
        }
        const Vector along = g * z1.part[p];
        g *= z0.part[p];
        v.part[p] += g * cosine;
        const Vector s = g * sine;
        t[0].part[p] += s * kx;
        t[1].part[p] += s * ky;
        t[2].part[p] += s * kz;
        const Vector zc = z0.part[p] * cosine;
        gx *= zc;
        gy *= zc;
        const Vector gz = along * cosine;
        r[0].part[p] += gz * uy;
        r[1].part[p] += gx * uz;
        r[2].part[p] += gy * ux;
        r[0].part[p] -= gy * uz;
        r[1].part[p] -= gz * ux;
        r[2].part[p] -= gx * uy;
      }
    }
    // Now and then the lanes are emptied, so that single precision adds up no more than some
    // hundred.
    if ((first / kModeBlock) % 16 == 15 || first + kModeBlock >= job.count) {
      value += total(v);
      v = zero();
      for (int d = 0; d < 3; ++d) {
        translation[d] += total(t[d]);
        rotation[d] += total(r[d]);
        t[d] = r[d] = zero();
      }
    }
  }
  sums->value = value;
  for (int d = 0; d < 3; ++d) sums->translation[d] = translation[d];
  for (int d = 0; d < 3; ++d) sums->rotation[d] = rotation[d];
}

void probe(const GapJob& job, double* value, double* energy) {
  const PiecesYz pieces(job.pieces);
  double v = 0.0, e = 0.0;
  for (std::ptrdiff_t first = 0; first < job.count; first += kModeBlock) {
    Block block;
    prepare(job, first, block);
    weigh_x(job.pieces, block);
    float re[kModeBlock], im[kModeBlock];
    for (int i = 0; i < kModeBlock; ++i) {
      Weights w;
      weigh_yz(pieces.twice, block.z[1][i], block.z[2][i], w);
      const Lanes z0 = along_z(w, false);
      const Vector ya[2] = {along_y<0>(w), along_y<2>(w)};
      const float* corner = job.table + block.cell[0][i] * job.stride_x +
                            block.cell[1][i] * job.stride_y +
                            static_cast<std::ptrdiff_t>(4) * block.cell[2][i];
      Lanes g = zero();
      for (int p = 0; p < kParts; ++p) {
        for (int y = 0; y < 2; ++y) {
          const float* row = corner + 2 * y * job.stride_y + p * kLanes;
          Vector a = {};
          for (int x = 0; x < kStencil; ++x) {
            Vector sample;
            load(row + x * job.stride_x, sample);
            a += sample * block.along_x[x][i];
          }
          g.part[p] += a * ya[y];
        }
        g.part[p] *= z0.part[p];
      }
      float lanes[16];
      __builtin_memcpy(lanes, &g, sizeof lanes);
      float even = 0.0F, odd = 0.0F;
      for (int l = 0; l < 16; l += 2) {
        even += lanes[l];
        odd += lanes[l + 1];
      }
      re[i] = even, im[i] = odd;
    }
    float block_value = 0.0F, block_energy = 0.0F;
    for (int i = 0; i < kModeBlock; ++i) {
      block_value += block.cosine[2 * i] * re[i] + block.cosine[2 * i + 1] * im[i];
      block_energy += re[i] * re[i] + im[i] * im[i];
    }
    v += static_cast<double>(block_value);
    e += static_cast<double>(block_energy);
  }
  *value = v;
  *energy = e;
}

}  // namespace

const GapTable kGapTable = {sum, probe};

}  // namespace mortise::MORTISE_ISA
