// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// All translations at one rotation: spread, transform, multiply, transform back; for several
/// offsets of the radii at once.
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <cstddef>
#include <functional>
#include <vector>

#include "fourier/lane_fft.hpp"
#include "mortise/fourier/aligned.hpp"
#include "mortise/fourier/spreader.hpp"
#include "search/score_box.hpp"

namespace mortise {

/// The placement that score cell (0, 0, 0) stands for, in grid steps: the middle of the corner of
/// the grid that holds the moving body.
[[nodiscard]] std::array<double, 3> corner_middle(const std::array<int, 3>& size, double spacing,
                                                  double moving_reach, int spread_width);

/// Correlates P real fields of a moving body with P fixed spectra and sums them into one score per
/// translation of a periodic box; with O sets of fixed spectra into O scores, for which the moving
/// body is spread and transformed once. The moving body occupies only a corner of the box; its
/// forward transforms skip the rest (Markel's pruning: axis by axis, lines that are all zero are
/// left out).
class Correlator {
 public:
  /// @param size          grid points per axis; @param spacing grid step
  /// @param moving_reach  largest distance of a moving point from the origin
  /// @param components    P >= 1; @param offsets  O >= 1
  Correlator(const std::array<int, 3>& size, double spacing, double moving_reach, int components,
             int spread_width, int offsets = 1);

  /// Everything one thread needs; made once.
  struct Workspace {
    explicit Workspace(const Correlator& plan);
    Spreader<3, float> spreader;
    Eigen::Matrix3Xd points;      // rotated, in the corner's coordinates
    AlignedVector<float> corner;  // moving body, real space
    AlignedVector<std::complex<float>>
        lines;  // one x-plane after the z transform; rows past the corner are not read
    AlignedVector<std::complex<float>>
        planes;  // P x nx x ny x nc: after z and y; planes past the corner are not read
    AlignedVector<std::complex<float>> tile, sum,
        product;                              // nx x nc, O x nx x nc, O x nx x ny x nc
    AlignedVector<std::complex<float>> slab;  // ny x nc: one x-plane between the y and z transforms
    ScoreBox box;                             // of the offset last finished
    LaneFft::Work fft_work_x, fft_work_y, fft_work_z;
  };

  /// Sets component p's spectrum for one offset: value(kx, ky, kz) at integer frequencies, kz = 0
  /// .. nz / 2, such that the scores are the sum over p of sum_k value_p(k) conj(m_p^(k)) exp(2 pi
  /// i k.t / L), m_p^ the moving knots' Fourier sum.
  void set_fixed(int component, int offset,
                 const std::function<std::complex<double>(int kx, int ky, int kz)>& value);

  /// Everything but the last transforms back; backward_yz() follows, offset by offset.
  /// @param points   3 x N moving points, unrotated, |y| <= moving_reach; rotated by `rotation`
  /// @param weights  P vectors, component p's weight of each of the N points
  void correlate(const Eigen::Matrix3Xd& points, const std::vector<Eigen::VectorXf>& weights,
                 const Eigen::Matrix3d& rotation, Workspace& workspace) const;

  /// The steps of correlate(), one by one for the benchmark. For each component: the rotated
  /// points' weights onto the corner's grid, then its z and y transforms; for all together: x
  /// transforms, products, x transforms back.
  void rotate(const Eigen::Matrix3Xd& points, const Eigen::Matrix3d& rotation,
              Workspace& workspace) const;
  void spread(const Eigen::VectorXf& weights, Workspace& workspace) const;
  void forward_zy(int component, Workspace& workspace) const;
  void multiply(Workspace& workspace) const;
  /// y and z back: the scores of one offset into workspace.box.
  void backward_yz(int offset, Workspace& workspace) const;

 private:
  std::array<int, 3> size_, corner_;
  std::array<double, 3> origin_;
  double spacing_;
  int components_, offsets_, columns_;  // columns_: complex numbers per padded row
  std::ptrdiff_t plane_;                // complex numbers per padded plane of y and z
  SpreadKernel kernel_;
  LaneFft fft_x_, fft_y_, fft_z_;
  AlignedVector<std::complex<float>> fixed_;  // P x O x ny x nx x columns_
};

}  // namespace mortise
