// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Spreading of scattered weights onto a periodic grid: the first half of an NFFT, usable alone.
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mortise/fourier/aligned.hpp"
#include "mortise/fourier/spread_kernel.hpp"

namespace mortise {

enum class WeightKind { kComplex, kReal };

/// Points in D dimensions, one per column; any block of columns of equal height will do, e.g.
/// knots.points.topRows<3>().
template <int D>
using PointsRef =
    Eigen::Ref<const Eigen::Matrix<double, D, Eigen::Dynamic>, 0, Eigen::OuterStride<>>;

/// Adds sum_i c_i phi(l - g_i) to the cells l of a periodic grid, g_i = N x_i / L the point in
/// cells.
///
/// The grid is row-major with the last axis fastest and its rows padded: cell (i, j, k) of a real
/// grid is at i stride(0) + j stride(1) + k, of a complex one at the same place plus k, as (real,
/// imaginary) pairs. Rows have room for an in-place real-to-complex transform. D is 3 or 4, Real
/// float or double. One object serves one thread at a time.
template <int D, class Real>
class Spreader {
 public:
  using Size = std::array<int, D>;

  /// @throws InputError unless every size >= the kernel's width and every box side > 0
  Spreader(const Size& size, const std::array<double, D>& box, const SpreadKernel& kernel,
           WeightKind kind, int threads = 1);

  /// Clears the grid of grid_size() Reals, aligned to 64 bytes, and spreads the points into it;
  /// same bytes for any number of threads. No allocation, except when tiled (large grids) with more
  /// points than ever before.
  /// @throws InputError if counts differ, a coordinate is not finite, or the weights are of the
  /// other kind
  void spread(const PointsRef<D>& points, const Eigen::Ref<const Eigen::VectorX<Real>>& weights,
              Real* grid);
  void spread(const PointsRef<D>& points,
              const Eigen::Ref<const Eigen::VectorX<std::complex<Real>>>& weights, Real* grid);

  /// As spread() but leaves the cells that stick out of a row's end where they are, for fold_rows()
  /// to bring back.
  void spread_unfolded(const PointsRef<D>& points, const Real* weights, std::ptrdiff_t count,
                       WeightKind kind, Real* grid);
  /// Adds the cells past the end of `count` rows to their beginnings.
  void fold_rows(Real* first_row, std::ptrdiff_t count) const;

  [[nodiscard]] const Size& size() const noexcept { return size_; }
  [[nodiscard]] std::ptrdiff_t stride(int axis) const noexcept {
    return stride_[axis];
  }  ///< in Reals
  [[nodiscard]] std::size_t grid_size() const noexcept {
    return static_cast<std::size_t>(stride_[0]) * size_[0];
  }
  [[nodiscard]] const SpreadKernel& kernel() const noexcept { return kernel_; }

 private:
  void spread_in_order(const PointsRef<D>& points, const Real* weights, Real* grid);
  void spread_in_tiles(const PointsRef<D>& points, const Real* weights, Real* grid);

  Size size_;
  std::array<double, D> inverse_box_;
  SpreadKernel kernel_;
  WeightKind kind_;
  int threads_ = 1;
  int degree_ = 0;
  int padded_width_ = 0;
  std::array<std::ptrdiff_t, D> stride_;
  AlignedVector<Real> coefficients_;
  std::array<std::vector<std::ptrdiff_t>, D - 1>
      offsets_;               // of cell i, wrapped, for i < size + width
  std::array<int, 3> tiles_;  // per axis 0, 1 (even or one), 2 (for order only)
  std::vector<std::int32_t> start_, tile_of_, order_, first_of_tile_;
  std::vector<Real> fraction_;
};

extern template class Spreader<3, float>;
extern template class Spreader<3, double>;
extern template class Spreader<4, float>;
extern template class Spreader<4, double>;

}  // namespace mortise
