// SPDX-License-Identifier: GPL-3.0-or-later
// Spreader: grid layout, tiles for threads, and the choice of the loops this processor runs
// fastest.
#include "mortise/fourier/spreader.hpp"

#include <algorithm>
#include <atomic>
#include <functional>
#include <string>
#include <type_traits>

#include "core/isa.hpp"
#include "fourier/spread_isa.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"

namespace mortise {
namespace isa_baseline {
extern const SpreadTables kSpreadTables;
}
namespace isa_avx2 {
extern const SpreadTables kSpreadTables;
}
namespace isa_avx512 {
extern const SpreadTables kSpreadTables;
}

namespace {

template <class Real>
const SpreadTable<Real>& loops() {
  const SpreadTables& tables = pick_isa(best_isa(), isa_baseline::kSpreadTables,
                                        isa_avx2::kSpreadTables, isa_avx512::kSpreadTables);
  if constexpr (std::is_same_v<Real, float>)
    return tables.single_precision;
  else
    return tables.double_precision;
}

// Above either, points are sorted into tiles, which pays for one thread too (cache) and lets many
// work at once. The rule must not look at the number of threads: the order of additions, so the
// result's last bits, depends on it.
constexpr std::size_t kTiledGridBytes = std::size_t{4} << 20;
constexpr double kTiledCellUpdates = 4e6;
constexpr std::ptrdiff_t kChunk = 4096;

[[noreturn]] void throw_not_finite() {
  throw InputError("Spreader: expected finite coordinates, a point has NaN or infinity");
}

}  // namespace

template <int D, class Real>
Spreader<D, Real>::Spreader(const Size& size, const std::array<double, D>& box,
                            const SpreadKernel& kernel, WeightKind kind, int threads)
    : size_(size), kernel_(kernel), kind_(kind), threads_(resolve_threads(threads)) {
  if (kernel.width < kMinSpreadWidth || kernel.width > kMaxSpreadWidth)
    throw InputError("Spreader: kernel width must be 2 to 16, got " + std::to_string(kernel.width));
  for (int d = 0; d < D; ++d) {
    if (size[d] < kernel.width)
      throw InputError("Spreader: grid size must be >= the kernel's width " +
                       std::to_string(kernel.width) + ", got " + std::to_string(size[d]));
    if (!(box[d] > 0.0) || !(1.0 / box[d] > 0.0))
      throw InputError("Spreader: box sides must be > 0 and finite, got " + std::to_string(box[d]));
    inverse_box_[d] = 1.0 / box[d];
  }
  padded_width_ = loops<Real>().padded_width(kernel.width);
  const KernelPieces pieces = fit_pieces(kernel, padded_width_);
  degree_ = pieces.degree;
  coefficients_.assign(pieces.coefficients.begin(), pieces.coefficients.end());

  const std::ptrdiff_t parts = kind == WeightKind::kComplex ? 2 : 1, line = 64 / sizeof(Real);
  std::ptrdiff_t row =
      std::max((size[D - 1] + padded_width_) * parts, std::ptrdiff_t{2} * (size[D - 1] / 2 + 1));
  row = (row + line - 1) / line * line;
  stride_[D - 1] = parts;
  stride_[D - 2] = row;
  for (int d = D - 3; d >= 0; --d) {
    stride_[d] = stride_[d + 1] * size[d + 1];
    // Columns that lie a multiple of 4 KiB apart share cache sets: one line more avoids that.
    if (stride_[d] * sizeof(Real) % 4096 == 0) stride_[d] += line;
  }
  for (int d = 0; d < D - 1; ++d) {
    offsets_[d].resize(size[d] + kernel.width);
    for (int i = 0; i < size[d] + kernel.width; ++i) offsets_[d][i] = i % size[d] * stride_[d];
  }
  // An even number of tiles, each at least as thick as the kernel is wide, so that tiles of one
  // colour do not meet.
  for (int d = 0; d < 2; ++d)
    tiles_[d] = std::max(1, size[d] / (2 * std::max(kernel.width, 8)) * 2);
  tiles_[2] = D == 3 ? 1 : std::max(1, size[2] / 16);
  first_of_tile_.resize(static_cast<std::size_t>(tiles_[0]) * tiles_[1] * tiles_[2] + 1);
}

template <int D, class Real>
void Spreader<D, Real>::spread(const PointsRef<D>& points,
                               const Eigen::Ref<const Eigen::VectorX<Real>>& weights, Real* grid) {
  spread_unfolded(points, weights.data(), weights.size(), WeightKind::kReal, grid);
  for (int i = 0; i < size_[0]; ++i)
    fold_rows(grid + i * stride_[0], D == 3 ? size_[1] : size_[1] * size_[2]);
}

template <int D, class Real>
void Spreader<D, Real>::spread(const PointsRef<D>& points,
                               const Eigen::Ref<const Eigen::VectorX<std::complex<Real>>>& weights,
                               Real* grid) {
  spread_unfolded(points, reinterpret_cast<const Real*>(weights.data()), weights.size(),
                  WeightKind::kComplex, grid);
  for (int i = 0; i < size_[0]; ++i)
    fold_rows(grid + i * stride_[0], D == 3 ? size_[1] : size_[1] * size_[2]);
}

template <int D, class Real>
void Spreader<D, Real>::spread_unfolded(const PointsRef<D>& points, const Real* weights,
                                        std::ptrdiff_t count, WeightKind kind, Real* grid) {
  if (kind != kind_)
    throw InputError("Spreader: real weights where complex ones were planned, or the reverse");
  if (count != points.cols())
    throw InputError("Spreader: expected one weight per point, got " + std::to_string(count) +
                     " weights for " + std::to_string(points.cols()) + " points");
  double updates = static_cast<double>(count);
  for (int d = 0; d < D; ++d) updates *= kernel_.width;
  if (grid_size() * sizeof(Real) > kTiledGridBytes || updates > kTiledCellUpdates)
    spread_in_tiles(points, weights, grid);
  else
    spread_in_order(points, weights, grid);
}

template <int D, class Real>
void Spreader<D, Real>::spread_in_order(const PointsRef<D>& points, const Real* weights,
                                        Real* grid) {
  std::fill_n(grid, grid_size(), Real{0});
  const SpreadTable<Real>& table = loops<Real>();
  SpreadJob<Real> job{kernel_.width, degree_, coefficients_.data(), {}, grid};
  for (int d = 0; d < D - 1; ++d) job.offsets[d] = offsets_[d].data();
  constexpr std::ptrdiff_t kBatch = 128;
  std::int32_t start[kBatch * D];
  Real fraction[kBatch * D];
  const std::ptrdiff_t parts = stride_[D - 1];
  for (std::ptrdiff_t first = 0; first < points.cols(); first += kBatch) {
    const std::ptrdiff_t count = std::min<std::ptrdiff_t>(kBatch, points.cols() - first);
    if (!table.prepare(D, points.data() + first * points.outerStride(), points.outerStride(), count,
                       inverse_box_.data(), size_.data(), kernel_.width, start, fraction))
      throw_not_finite();
    table.spread[D - 3][parts - 1](job, {start, fraction, weights + parts * first, nullptr, count});
  }
}

template <int D, class Real>
void Spreader<D, Real>::spread_in_tiles(const PointsRef<D>& points, const Real* weights,
                                        Real* grid) {
  const SpreadTable<Real>& table = loops<Real>();
  const std::ptrdiff_t count = points.cols(), parts = stride_[D - 1];
  if (order_.size() < static_cast<std::size_t>(count)) {
    start_.resize(count * D);
    fraction_.resize(count * D);
    tile_of_.resize(count);
    order_.resize(count);
  }
  // Cells cleared and points prepared in independent chunks.
  std::atomic<bool> finite = true;
  const auto prepare = [&](std::size_t chunk, int) {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(chunk) * kChunk;
    const std::ptrdiff_t here = std::min(kChunk, count - first);
    if (!table.prepare(D, points.data() + first * points.outerStride(), points.outerStride(), here,
                       inverse_box_.data(), size_.data(), kernel_.width, start_.data() + D * first,
                       fraction_.data() + D * first))
      finite = false;
    for (std::ptrdiff_t i = first; i < first + here; ++i) {
      std::int32_t tile = 0;
      for (int d = 0; d < 3; ++d)
        tile = tile * tiles_[d] +
               static_cast<std::int32_t>(static_cast<std::int64_t>(start_[D * i + d]) * tiles_[d] /
                                         size_[d]);
      tile_of_[i] = tile;
    }
  };
  parallel_for(static_cast<std::size_t>((count + kChunk - 1) / kChunk), threads_,
               std::ref(prepare));
  if (!finite) throw_not_finite();
  const auto clear = [&](std::size_t i, int) {
    std::fill_n(grid + static_cast<std::ptrdiff_t>(i) * stride_[0], stride_[0], Real{0});
  };
  parallel_for(static_cast<std::size_t>(size_[0]), threads_, std::ref(clear));

  // Counting sort; stable, so the order within a tile is the caller's.
  std::fill(first_of_tile_.begin(), first_of_tile_.end(), 0);
  for (std::ptrdiff_t i = 0; i < count; ++i) ++first_of_tile_[tile_of_[i] + 1];
  for (std::size_t t = 1; t < first_of_tile_.size(); ++t)
    first_of_tile_[t] += first_of_tile_[t - 1];
  for (std::ptrdiff_t i = 0; i < count; ++i)
    order_[first_of_tile_[tile_of_[i]]++] = static_cast<std::int32_t>(i);
  // Each entry has moved on to its tile's end, which is the next tile's beginning.

  SpreadJob<Real> job{kernel_.width, degree_, coefficients_.data(), {}, grid};
  for (int d = 0; d < D - 1; ++d) job.offsets[d] = offsets_[d].data();
  const int step0 = tiles_[0] > 1 ? 2 : 1, step1 = tiles_[1] > 1 ? 2 : 1;
  for (int colour = 0; colour < step0 * step1; ++colour) {
    const auto spread_tile = [&](std::size_t index, int) {
      const int row = static_cast<int>(index) / (tiles_[1] / step1),
                column = static_cast<int>(index) % (tiles_[1] / step1);
      const std::ptrdiff_t tile = (std::ptrdiff_t{row} * step0 + colour / step1) * tiles_[1] +
                                  column * step1 + colour % step1;
      const std::ptrdiff_t first = tile == 0 ? 0 : first_of_tile_[tile * tiles_[2] - 1];
      const std::ptrdiff_t last = first_of_tile_[(tile + 1) * tiles_[2] - 1];
      table.spread[D - 3][parts - 1](
          job, {start_.data(), fraction_.data(), weights, order_.data() + first, last - first});
    };
    parallel_for(static_cast<std::size_t>(tiles_[0] / step0) * (tiles_[1] / step1), threads_,
                 std::ref(spread_tile));
  }
}

template <int D, class Real>
void Spreader<D, Real>::fold_rows(Real* first_row, std::ptrdiff_t count) const {
  const std::ptrdiff_t parts = stride_[D - 1], row = parts * size_[D - 1],
                       extra = parts * (kernel_.width - 1);
  for (std::ptrdiff_t r = 0; r < count; ++r) {
    Real* const cells = first_row + r * stride_[D - 2];
    for (std::ptrdiff_t j = 0; j < extra; ++j) cells[j] += cells[row + j];
  }
}

template class Spreader<3, float>;
template class Spreader<3, double>;
template class Spreader<4, float>;
template class Spreader<4, double>;

}  // namespace mortise
