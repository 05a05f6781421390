// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Fast Fourier sums over scattered points (NFFT of type 1) in three and four dimensions.
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "mortise/fourier/aligned.hpp"
#include "mortise/fourier/fft_plan.hpp"
#include "mortise/fourier/spreader.hpp"

namespace mortise {

struct NfftOptions {
  double tolerance = 1e-6;  ///< relative l2 error over all modes (points in step with the grid: up
                            ///< to 1.5 times); 1e-12 to 1e-1, float: 1e-6 to 1e-1
  WeightKind weights = WeightKind::kComplex;
  double upsampling = 0.0;  ///< fine grid cells per mode and axis, > 1; 0 = the one of 1.25, 1.5, 2
                            ///< that should cost least
  std::ptrdiff_t expected_points =
      0;  ///< only helps to choose the upsampling; 0 = a quarter of the number of modes
  PlanRigor rigor = PlanRigor::kEstimate;
  int threads = 0;  ///< 0 = all cores; never changes the result
};

/// f^(k) = sum_i c_i exp(-2 pi i k.x_i / L) for all modes k of a box with sides L.
///
/// Axis d has modes[d] = n frequencies k = -floor(n / 2) .. ceil(n / 2) - 1, in this order, axis 0
/// slowest. Real weights give only k = 0 .. floor(n / 2) on the last axis; the rest is f^(-k) =
/// conj f^(k). Points may lie anywhere: they are taken modulo the box. D is 3 or 4, Real float or
/// double. One object serves one thread at a time.
template <int D, class Real>
class Nfft {
 public:
  using Complex = std::complex<Real>;

  /// @throws InputError if a mode count < 1, a side is not > 0, or tolerance and upsampling cannot
  /// be had
  Nfft(const std::array<int, D>& modes, const std::array<double, D>& box,
       const NfftOptions& options = {});

  /// The modes, valid until the next call. Allocates nothing once it has seen as many points.
  /// Time O(N w^D + n log n), n cells of the fine grid, w the kernel's width.
  /// @throws InputError if counts differ, a coordinate is not finite, or options.weights says the
  /// other kind
  std::span<const Complex> transform(const PointsRef<D>& points,
                                     const Eigen::Ref<const Eigen::VectorX<Complex>>& weights);
  std::span<const Complex> transform(const PointsRef<D>& points,
                                     const Eigen::Ref<const Eigen::VectorX<Real>>& weights);

  [[nodiscard]] const std::array<int, D>& modes() const noexcept { return modes_; }
  /// Shape of the result: modes(), with floor(n / 2) + 1 on the last axis for real weights.
  [[nodiscard]] const std::array<int, D>& shape() const noexcept { return shape_; }
  [[nodiscard]] const std::array<int, D>& fine_size() const noexcept { return spreader_.size(); }
  [[nodiscard]] const SpreadKernel& kernel() const noexcept { return spreader_.kernel(); }

 private:
  struct Range {
    int first, count;
  };
  std::span<const Complex> run(const PointsRef<D>& points, const Real* weights,
                               std::ptrdiff_t count, WeightKind kind);
  void transform_block(int index);
  void transform_first_axis(std::size_t index);

  std::array<int, D> modes_, shape_;
  NfftOptions options_;
  Spreader<D, Real> spreader_;
  std::array<std::vector<int>, D - 1> kept_;     // fine-grid index of each mode of axes 0 .. D-2
  std::vector<Range> ranges_;                    // of the last axis, that hold all its modes
  std::array<std::vector<Real>, D> correction_;  // 1 / phi^(k / N) per mode
  FftPlan<Real> rows_;                           // last axis, all rows of one plane (axes D-2, D-1)
  std::array<std::vector<FftPlan<Real>>, D - 1> columns_;  // one plan per range
  AlignedVector<Real> grid_;
  AlignedVector<Complex> result_;
};

extern template class Nfft<3, float>;
extern template class Nfft<3, double>;
extern template class Nfft<4, float>;
extern template class Nfft<4, double>;

using Nfft3 = Nfft<3, double>;
using Nfft3f = Nfft<3, float>;
using Nfft4 = Nfft<4, double>;
using Nfft4f = Nfft<4, float>;

/// One-shot forms: plan, transform, copy. options.weights is taken from the weights' type.
[[nodiscard]] Eigen::VectorXcd nfft(const Eigen::Matrix3Xd& points, const Eigen::VectorXcd& weights,
                                    const std::array<int, 3>& modes,
                                    const std::array<double, 3>& box, NfftOptions options = {});
[[nodiscard]] Eigen::VectorXcd nfft(const Eigen::Matrix4Xd& points, const Eigen::VectorXcd& weights,
                                    const std::array<int, 4>& modes,
                                    const std::array<double, 4>& box, NfftOptions options = {});

}  // namespace mortise
