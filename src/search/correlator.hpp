// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// All translations at one rotation: spread, transform, multiply, transform back.
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <cstddef>
#include <functional>
#include <vector>

#include "mortise/fourier/aligned.hpp"
#include "mortise/fourier/fft_plan.hpp"
#include "mortise/fourier/spreader.hpp"
#include "search/search_isa.hpp"

namespace mortise {

/// A maximum over translations, in grid cells; `cell` is its grid point.
struct GridPeak {
  float score;
  std::array<int, 3> cell;
  std::array<float, 3> offset;  ///< from the grid point to the sub-grid maximum, within [-1/2, 1/2]
};

/// Correlates P real fields of a moving body with P fixed spectra and sums them into one score per
/// translation of a periodic box. The moving body occupies only a corner of the box; its forward
/// transforms skip the rest (Markel's pruning: axis by axis, lines that are all zero are left out).
class Correlator {
 public:
  /// @param size          grid points per axis; @param spacing grid step
  /// @param moving_reach  largest distance of a moving point from the origin
  /// @param components    P >= 1
  Correlator(const std::array<int, 3>& size, double spacing, double moving_reach, int components,
             int spread_width);

  /// Everything one thread needs; made once.
  struct Workspace {
    explicit Workspace(const Correlator& plan);
    Spreader<3, float> spreader;
    Eigen::Matrix3Xd points;      // rotated, in the corner's coordinates
    AlignedVector<float> corner;  // moving body, real space
    AlignedVector<std::complex<float>>
        lines;  // one x-plane after the z transform; rows past the corner stay 0
    AlignedVector<std::complex<float>>
        planes;  // P x nx x ny x nc: after z and y; planes past the corner stay 0
    AlignedVector<std::complex<float>> tile, sum, product;  // nx x nc, nx x nc, nx x ny x nc
    AlignedVector<std::complex<float>> slab;  // ny x nc: one x-plane between the y and z transforms
    AlignedVector<float> scores;              // nx x ny x row(): last axis padded with -infinity
    std::vector<float> maxima;                // of each row; nx x ny, rows padded with -infinity
    std::vector<float> plane_maxima;          // nx
  };

  /// Sets component p's spectrum: value(kx, ky, kz) at integer frequencies, kz = 0 .. nz / 2, such
  /// that the scores are the sum over p of sum_k value_p(k) conj(m_p^(k)) exp(2 pi i k.t / L), m_p^
  /// the moving knots' Fourier sum.
  void set_fixed(int component,
                 const std::function<std::complex<double>(int kx, int ky, int kz)>& value);

  /// Scores of all translations into workspace.scores, row maxima into workspace.maxima.
  /// @param points   3 x N moving points, unrotated, |y| <= moving_reach; rotated by `rotation`
  /// @param weights  P vectors, component p's weight of each of the N points
  void correlate(const Eigen::Matrix3Xd& points, const std::vector<Eigen::VectorXf>& weights,
                 const Eigen::Matrix3d& rotation, Workspace& workspace) const;

  /// The steps of correlate(), one by one for the benchmark. For each component: the rotated
  /// points' weights onto the corner's grid, then its z and y transforms; for all together: x
  /// transforms, products, x transforms back; y and z back, with row maxima.
  void rotate(const Eigen::Matrix3Xd& points, const Eigen::Matrix3d& rotation,
              Workspace& workspace) const;
  void spread(const Eigen::VectorXf& weights, Workspace& workspace) const;
  void forward_zy(int component, Workspace& workspace) const;
  void multiply(Workspace& workspace) const;
  void backward_yz(Workspace& workspace) const;

  /// Up to `count` translations at least `separation` apart (grid steps), best first: the best
  /// cell, then the best that is not too near, and so on, each moved to its sub-grid maximum.
  /// Overwrites scores.
  /// @param summits  only cells no lower than their 26 neighbours, of at most some 10^4 cells
  [[nodiscard]] std::vector<GridPeak> take_peaks(Workspace& workspace, int count, double separation,
                                                 bool summits = false) const;

  [[nodiscard]] const std::array<int, 3>& size() const noexcept { return size_; }
  [[nodiscard]] double spacing() const noexcept { return spacing_; }
  /// Score cell (i, j, k) is the placement with the moving origin at (i, j, k) + origin_cell(), in
  /// grid steps, modulo the box.
  [[nodiscard]] std::array<double, 3> origin_cell() const noexcept { return origin_; }
  [[nodiscard]] int row() const noexcept { return row_; }  ///< floats per padded row of scores
  [[nodiscard]] const SpreadKernel& kernel() const noexcept { return kernel_; }

 private:
  [[nodiscard]] GridPeak peak_at(const Workspace& workspace, const std::array<int, 3>& cell) const;
  [[nodiscard]] bool touches_cleared(const Workspace& workspace,
                                     const std::array<int, 3>& cell) const;
  /// Takes the peak's cell and those nearer than `separation` to it out of scores and maxima.
  void clear_ball(Workspace& workspace, const GridPeak& peak, double separation) const;

  std::array<int, 3> size_, corner_;
  std::array<double, 3> origin_;
  double spacing_;
  int components_, columns_, row_;  // columns_: complex numbers per padded row
  std::ptrdiff_t plane_;            // complex numbers per padded plane of y and z
  int plane_row_;                   // floats per padded row of maxima
  SpreadKernel kernel_;
  const SearchTable* table_;
  FftPlan<float> forward_z_, forward_y_, forward_x_, backward_x_, backward_y_, backward_z_;
  AlignedVector<std::complex<float>> fixed_;  // P x ny x nx x columns_
};

}  // namespace mortise
