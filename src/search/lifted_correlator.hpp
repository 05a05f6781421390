// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// All translations at one rotation by 4D sums: the exact form, some twenty times the cost of the
/// compressed one.
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <vector>

#include "mortise/fourier/aligned.hpp"
#include "mortise/fourier/fft_plan.hpp"
#include "mortise/fourier/nfft.hpp"
#include "search/frequencies.hpp"
#include "search/lifted_parts.hpp"
#include "search/score_box.hpp"

namespace mortise {

/// One 4D NFFT of the moving knots a rotation and channel; every offset is a slice of it:
/// M^o(w) = sum_m g_m(|w|) exp(-2 pi i m o / period) F(w, m)  [SD, Eq. 24-25 and Sec. 4.2].
class LiftedCorrelator {
 public:
  /// @param origin_cell  score cell (i, j, k) is the placement with the moving origin at (i, j, k)
  /// + origin_cell, in grid steps, modulo the box
  LiftedCorrelator(const std::array<int, 3>& size, double spacing,
                   const std::array<double, 3>& origin_cell, LiftedParts parts,
                   const std::vector<double>& offsets);

  /// Everything one thread needs.
  struct Workspace {
    explicit Workspace(const LiftedCorrelator& plan);
    std::vector<Nfft4f> sums;                                 // per part
    Eigen::Matrix4Xd points;                                  // rotated, radius first
    std::vector<AlignedVector<std::complex<float>>> product;  // per offset: nx x ny x (nz / 2 + 1)
    AlignedVector<std::complex<float>> slice;
    ScoreBox box;  // of the offset last finished
  };

  /// Sums and products of all offsets; finish() follows, offset by offset.
  void correlate(const Eigen::Matrix3d& rotation, Workspace& workspace) const;
  /// The scores of one offset into workspace.box.
  void finish(int offset, Workspace& workspace) const;

 private:
  struct Part {
    Eigen::Matrix4Xd points;
    Eigen::VectorXf weights;
    int modes;
    double period;
    std::vector<Eigen::MatrixXcf> series;      // per offset: lengths x modes
    AlignedVector<std::complex<float>> fixed;  // in the order of `product`
  };

  std::array<int, 3> size_;
  double spacing_, tolerance_;
  Eigen::Vector3d origin_;  // length unit
  std::vector<Part> parts_;
  std::size_t offsets_;
  std::vector<std::uint32_t> length_of_;  // per mode of the sums: column of its series
  std::vector<std::uint32_t> place_of_;   // per mode of the sums: its place in `product`
  FftPlan<float> backward_;
};

}  // namespace mortise
