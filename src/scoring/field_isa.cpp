// SPDX-License-Identifier: GPL-3.0-or-later
// Maps in bricks: filled, and read at many points; compiled once per instruction set (see
// cmake/MortiseIsa.cmake for what that forbids here).
#include "scoring/field_isa.hpp"

#include "core/isa_vector.hpp"
#include "scoring/contact_steps.hpp"

#if defined(__AVX2__)
#include <immintrin.h>  // nothing but always-inlined wrappers
#endif

namespace mortise::MORTISE_ISA {
extern const FieldTable kFieldTable;

namespace {

constexpr int kLanes = kVectorBytes / 4;
static_assert(kPointGroup % kLanes == 0);

using Floats __attribute__((vector_size(kVectorBytes))) = float;
using Ints __attribute__((vector_size(kVectorBytes))) = std::int32_t;

[[gnu::always_inline]] inline Floats all(float x) { return Floats{} + x; }
// NaN becomes `low`.
[[gnu::always_inline]] inline Floats clamped(const Floats& v, float low, float high) {
  const Floats above = v > low ? v : all(low);
  return above < high ? above : all(high);
}
[[gnu::always_inline]] inline Ints truncated(const Floats& v) {
  return __builtin_convertvector(v, Ints);
}
[[gnu::always_inline]] inline Floats floats(const Ints& v) {
  return __builtin_convertvector(v, Floats);
}
// The floats with these bits.
[[gnu::always_inline]] inline Floats as_floats(const Ints& bits) {
  Floats v;
  __builtin_memcpy(&v, &bits, sizeof v);
  return v;
}
[[gnu::always_inline]] inline double sum_of(const Floats& v) {
  double sum = 0.0;
  for (int l = 0; l < kLanes; ++l) sum += static_cast<double>(v[l]);
  return sum;
}
[[gnu::always_inline]] inline bool any(const Ints& mask) {
#if defined(__AVX512F__)
  return _mm512_test_epi32_mask(reinterpret_cast<const __m512i&>(mask),
                                reinterpret_cast<const __m512i&>(mask)) != 0;
#elif defined(__AVX2__)
  return _mm256_movemask_ps(reinterpret_cast<const __m256&>(mask)) != 0;
#else
  std::int32_t bits = 0;
  for (int l = 0; l < kLanes; ++l) bits |= mask[l];
  return bits != 0;
#endif
}

// The 32 bits from base + Scale * at on.
template <int Scale>
[[gnu::always_inline]] inline Ints gathered(const void* base, const Ints& at) {
  Ints v;
#if defined(__AVX512F__)
  // The unmasked form makes gcc 12 warn of an uninitialised value of its own header.
  reinterpret_cast<__m512i&>(v) = _mm512_mask_i32gather_epi32(
      _mm512_setzero_si512(), 0xffff, reinterpret_cast<const __m512i&>(at), base, Scale);
#elif defined(__AVX2__)
  reinterpret_cast<__m256i&>(v) = _mm256_i32gather_epi32(
      static_cast<const int*>(base), reinterpret_cast<const __m256i&>(at), Scale);
#else
  for (int l = 0; l < kLanes; ++l) {
    int bits;
    __builtin_memcpy(
        &bits, static_cast<const char*>(base) + static_cast<std::ptrdiff_t>(Scale) * at[l], 4);
    v[l] = bits;
  }
#endif
  return v;
}

// Where points lie among the bricks.
struct Cells {
  Ints corner;  // of the cell, in values from the first map's on; 0 = in brick 0
  Ints inside;  // mask: the block has a brick
  Floats a, b, c;
};

[[gnu::always_inline]] inline Cells cells_of(const FieldMaps& m, const Floats& u, const Floats& v,
                                             const Floats& w) {
  Cells cells;
  const Floats* const place[3] = {&u, &v, &w};
  Floats* const part[3] = {&cells.a, &cells.b, &cells.c};
  Ints block = {}, local = {}, within = ~Ints{};
  for (int d = 0; d < 3; ++d) {
    const auto top = static_cast<float>(kBrickCells * m.size[d]);
    within &= (*place[d] >= 0.0F) & (*place[d] < top);
    // Held back so that cells exist for lanes that lie outside.
    const Floats at = clamped(*place[d], 0.0F, top - 0.5F);
    const Ints cell = truncated(at);
    const Floats whole = floats(cell);
    // Half a cell off, so that rounding cannot reach the next block.
    const Ints b = truncated((whole + 0.5F) * (1.0F / kBrickCells));
    *part[d] = at - whole;
    block = block * m.size[d] + b;
    local = local * kBrickSide + (cell - kBrickCells * b);
  }
  const Ints brick = gathered<4>(m.blocks, block);
  cells.inside = within & (brick > 0);
  cells.corner = cells.inside ? brick + local : Ints{};
  return cells;
}

// Corners of the cells of one map: values at [i][j][k].
struct Corners {
  Floats at[2][2][2];
};

[[gnu::always_inline]] inline Corners corners_of(const FieldMaps& m, const Ints& corner) {
  Corners corners;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      const Ints pair =
          gathered<2>(m.values + i * kBrickSide * kBrickSide + j * kBrickSide, corner);
      corners.at[i][j][0] = as_floats(pair << 16);
      corners.at[i][j][1] = as_floats(pair & static_cast<std::int32_t>(0xffff0000));
    }
  return corners;
}

[[gnu::always_inline]] inline Floats between(const Floats& low, const Floats& high,
                                             const Floats& share) {
  return low + share * (high - low);
}

// Calls use(first point) for the groups that may reach a brick.
template <class Use>
[[gnu::always_inline]] inline void for_groups(const FieldMaps& m, const FieldPoints& p,
                                              const float* r, const float* c, const Use& use) {
  const std::ptrdiff_t groups = p.count / kPointGroup;
  for (std::ptrdiff_t g = 0; g < groups; g += kLanes) {
    const Floats x = load<Floats>(p.group_x + g), y = load<Floats>(p.group_y + g),
                 z = load<Floats>(p.group_z + g);
    Ints block = {};
    for (int d = 0; d < 3; ++d) {
      const Floats u = r[3 * d] * x + r[3 * d + 1] * y + r[3 * d + 2] * z + c[d];
      // Outside everything is 0, and the nearest place inside is nearer to all that is not.
      const auto top = static_cast<float>(kBrickCells * m.size[d]);
      const Ints cell = truncated(clamped(u, 0.0F, top - 0.5F));
      block = block * m.size[d] + truncated((floats(cell) + 0.5F) * (1.0F / kBrickCells));
    }
    const Ints brick = gathered<4>(m.blocks, block);
    const Floats reach = load<Floats>(p.group_reach + g) * p.steps;
    const Ints near = (brick > 0) | (reach >= floats((-brick - 1) * kBrickCells));
    std::int32_t lanes[kLanes];
    store(lanes, near);
    const std::ptrdiff_t end = groups - g < kLanes ? groups - g : kLanes;
    for (std::ptrdiff_t l = 0; l < end; ++l)
      if (lanes[l] != 0)
        for (int part = 0; part < kPointGroup; part += kLanes) use((g + l) * kPointGroup + part);
  }
}

double value(const FieldMaps& maps, const FieldPoints& points, const float* rotation,
             const float* centre) {
  const FieldMaps m = maps;
  const FieldPoints p = points;
  float r[9];
  for (int i = 0; i < 9; ++i) r[i] = rotation[i];
  const float o[3] = {centre[0], centre[1], centre[2]};
  Floats sum = {};
  for_groups(
      m, p, r, o, [&](std::ptrdiff_t n) __attribute__((always_inline)) {
        const Floats x = load<Floats>(p.x + n), y = load<Floats>(p.y + n),
                     z = load<Floats>(p.z + n);
        const Cells cells =
            cells_of(m, r[0] * x + r[1] * y + r[2] * z + o[0],
                     r[3] * x + r[4] * y + r[5] * z + o[1], r[6] * x + r[7] * y + r[8] * z + o[2]);
        if (!any(cells.inside)) return;
        const auto of_map = [&](const Ints& map) __attribute__((always_inline)) {
          const Corners f = corners_of(m, cells.corner + (cells.inside & (map * kBrickPoints)));
          Floats line[2][2];
          for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j) line[i][j] = between(f.at[i][j][0], f.at[i][j][1], cells.c);
          return between(between(line[0][0], line[0][1], cells.b),
                         between(line[1][0], line[1][1], cells.b), cells.a);
        };
        sum += load<Floats>(p.contact_weights + n) * of_map(load<Ints>(p.types + n));
        for (std::ptrdiff_t q = 0; q < p.shapes; ++q)
          sum += load<Floats>(p.shape_weights + q * p.count + n) *
                 of_map(Ints{} + (m.types + static_cast<std::int32_t>(q)));
      });
  return sum_of(sum);
}

void slope(const FieldMaps& maps, const FieldPoints& points, const float* rotation,
           const float* centre, double* out) {
  const FieldMaps m = maps;
  const FieldPoints p = points;
  float r[9];
  for (int i = 0; i < 9; ++i) r[i] = rotation[i];
  const float o[3] = {centre[0], centre[1], centre[2]};
  Floats sum = {}, force[3] = {}, torque[3] = {};
  for_groups(
      m, p, r, o, [&](std::ptrdiff_t n) __attribute__((always_inline)) {
        const Floats x = load<Floats>(p.x + n), y = load<Floats>(p.y + n),
                     z = load<Floats>(p.z + n);
        const Floats arm[3] = {r[0] * x + r[1] * y + r[2] * z, r[3] * x + r[4] * y + r[5] * z,
                               r[6] * x + r[7] * y + r[8] * z};
        const Cells cells = cells_of(m, arm[0] + o[0], arm[1] + o[1], arm[2] + o[2]);
        if (!any(cells.inside)) return;
        Corners f =
            corners_of(m, cells.corner + (cells.inside & (load<Ints>(p.types + n) * kBrickPoints)));
        const Floats contact = load<Floats>(p.contact_weights + n);
        for (auto& plane : f.at)
          for (auto& line : plane)
            for (Floats& v : line) v *= contact;
        for (std::ptrdiff_t q = 0; q < p.shapes; ++q) {
          const Floats weight = load<Floats>(p.shape_weights + q * p.count + n);
          const Ints map = Ints{} + (m.types + static_cast<std::int32_t>(q)) * kBrickPoints;
          const Corners shape = corners_of(m, cells.corner + (cells.inside & map));
          for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j)
              for (int k = 0; k < 2; ++k) f.at[i][j][k] += weight * shape.at[i][j][k];
        }
        // Along z, then y, then x; the slopes along what has been gone through are carried on.
        Floats line[2][2], rise[2][2];
        for (int i = 0; i < 2; ++i)
          for (int j = 0; j < 2; ++j) {
            rise[i][j] = f.at[i][j][1] - f.at[i][j][0];
            line[i][j] = f.at[i][j][0] + cells.c * rise[i][j];
          }
        const Floats step_0 = line[0][1] - line[0][0], step_1 = line[1][1] - line[1][0];
        const Floats plane_0 = line[0][0] + cells.b * step_0,
                     plane_1 = line[1][0] + cells.b * step_1;
        const Floats fx = plane_1 - plane_0, fy = between(step_0, step_1, cells.a);
        const Floats fz = between(between(rise[0][0], rise[0][1], cells.b),
                                  between(rise[1][0], rise[1][1], cells.b), cells.a);
        sum += plane_0 + cells.a * fx;
        force[0] += fx;
        force[1] += fy;
        force[2] += fz;
        torque[0] += arm[1] * fz - arm[2] * fy;
        torque[1] += arm[2] * fx - arm[0] * fz;
        torque[2] += arm[0] * fy - arm[1] * fx;
      });
  out[0] = sum_of(sum);
  for (int i = 0; i < 3; ++i) {
    out[1 + i] = sum_of(force[i]);
    out[4 + i] = sum_of(torque[i]);
  }
}

[[gnu::always_inline]] inline Floats root(const Floats& v) {
  Floats result;
  for (int l = 0; l < kLanes; ++l) result[l] = __builtin_sqrtf(v[l]);
  return result;
}

// Calls use(first of kLanes grid points, their squared distances) for the block's 64.
template <class Use>
[[gnu::always_inline]] inline void for_points(float x, float y, float z, float spacing,
                                              const Use& use) {
  float dy_sq[kBrickSide], dz_sq[kBrickSide];
  for (int k = 0; k < kBrickSide; ++k) {
    const float dy = y - static_cast<float>(k) * spacing, dz = z - static_cast<float>(k) * spacing;
    dy_sq[k] = dy * dy;
    dz_sq[k] = dz * dz;
  }
  constexpr int kPlane = kBrickSide * kBrickSide;
  float across[kPlane];
  for (int n = 0; n < kPlane; ++n) across[n] = dy_sq[n / kBrickSide] + dz_sq[n % kBrickSide];
  for (int i = 0; i < kBrickSide; ++i) {
    const float dx = x - static_cast<float>(i) * spacing;
    for (int n = 0; n < kPlane; n += kLanes)
      use(i * kPlane + n, load<Floats>(across + n) + dx * dx);
  }
}

void contacts(const FieldSources& sources, const std::int32_t* chosen, std::ptrdiff_t count,
              const float* corner, float spacing, const float* near, const float* far,
              std::ptrdiff_t types, float* work, float* out) {
  // How much of each type there is near and far; then what that means to each type.
  for (std::ptrdiff_t n = 0; n < 2 * types * kBrickPoints; ++n) work[n] = 0.0F;
  constexpr int kMost = 64;  // types looked after by bits
  unsigned long long present = 0;
  for (std::ptrdiff_t s = 0; s < count; ++s) {
    const std::int32_t at = chosen[s], type = sources.types[at];
    present |= 1ULL << (type % kMost);
    float* const sums = work + 2 * kBrickPoints * type;
    for_points(
        sources.x[at] - corner[0], sources.y[at] - corner[1], sources.z[at] - corner[2],
        spacing, [&](int n, const Floats& d_sq) __attribute__((always_inline)) {
          const Floats d = root(d_sq);
          const Floats rising = (d - kFarStart) * (1.0F / kContactStep), falling = kFarEnd - d;
          store(sums + n, load<Floats>(sums + n) +
                              clamped((kNearEnd - d) * (1.0F / kContactStep), 0.0F, 1.0F));
          store(sums + kBrickPoints + n,
                load<Floats>(sums + kBrickPoints + n) +
                    clamped(rising < falling ? rising : falling, 0.0F, 1.0F));
        });
  }
  for (std::ptrdiff_t b = 0; b < types; ++b) {
    Floats total[kBrickPoints / kLanes] = {};
    for (std::ptrdiff_t a = 0; a < types; ++a) {
      if ((present >> (a % kMost) & 1U) == 0) continue;
      const float* const sums = work + 2 * kBrickPoints * a;
      const float n = near[a * types + b], f = far[a * types + b];
      for (int v = 0; v < kBrickPoints / kLanes; ++v)
        total[v] += n * load<Floats>(sums + v * kLanes) +
                    f * load<Floats>(sums + kBrickPoints + v * kLanes);
    }
    for (int v = 0; v < kBrickPoints / kLanes; ++v)
      store(out + b * kBrickPoints + v * kLanes, total[v]);
  }
}

void shape(const FieldSources& sources, const std::int32_t* chosen, std::ptrdiff_t count,
           const float* corner, float spacing, const float* tables, std::ptrdiff_t entries,
           float range_sq, float* out) {
  Floats total[kBrickPoints / kLanes] = {};
  const float scale = static_cast<float>(entries - 1) / range_sq;
  const auto last = static_cast<float>(entries - 1);  // where tables are 0
  for (std::ptrdiff_t s = 0; s < count; ++s) {
    const std::int32_t at = chosen[s];
    const float weight = sources.weights[at];
    const float* const table = tables + sources.types[at] * entries;
    for_points(
        sources.x[at] - corner[0], sources.y[at] - corner[1], sources.z[at] - corner[2],
        spacing, [&](int n, const Floats& d_sq) __attribute__((always_inline)) {
          const Floats place = d_sq * scale;
          const Floats held = place < last ? place : all(last - 1.0F);
          const Ints i = truncated(held);
          const Floats low = as_floats(gathered<4>(table, i));
          const Floats high = as_floats(gathered<4>(table + 1, i));
          const Floats value = low + (held - floats(i)) * (high - low);
          total[n / kLanes] += place < last ? weight * value : Floats{};
        });
  }
  for (int v = 0; v < kBrickPoints / kLanes; ++v) store(out + v * kLanes, total[v]);
}

// Rounded to the nearest, ties to even.
void pack(const float* from, std::ptrdiff_t plane, std::ptrdiff_t row, std::uint16_t* brick) {
  std::uint32_t bits[kBrickPoints];
  for (int n = 0; n < kBrickSide * kBrickSide; ++n)
    __builtin_memcpy(bits + n * kBrickSide, from + n / kBrickSide * plane + n % kBrickSide * row,
                     kBrickSide * sizeof(float));
  for (int n = 0; n < kBrickPoints; ++n)
    brick[n] = static_cast<std::uint16_t>((bits[n] + 0x7fffU + (bits[n] >> 16 & 1U)) >> 16);
}

}  // namespace

const FieldTable kFieldTable = {value, slope, contacts, shape, pack};

}  // namespace mortise::MORTISE_ISA
