// SPDX-License-Identifier: GPL-3.0-or-later
// All translations at one rotation.
#include "search/correlator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/isa.hpp"

namespace mortise {

namespace isa_baseline {
extern const SearchTable kSearchTable;
}
namespace isa_avx2 {
extern const SearchTable kSearchTable;
}
namespace isa_avx512 {
extern const SearchTable kSearchTable;
}

namespace {

constexpr float kLowest = -std::numeric_limits<float>::infinity();

// The window's tail near the Nyquist frequency is what suffers from spreading on an unenlarged
// grid; this shape favours the modes below 80% of it. Widths 4 to 6 and shapes for 60% to 100% rank
// alike (docs/ranking.md).
SpreadKernel search_kernel(int width) {
  SpreadKernel kernel;
  kernel.width = width;
  kernel.beta = std::numbers::pi * width * (1.0 - 0.5 / 1.25);
  kernel.fit_error = 1e-4;
  return kernel;
}

int round_up(int n, int multiple) { return (n + multiple - 1) / multiple * multiple; }

std::array<double, 3> corner_box(const std::array<int, 3>& corner, double spacing) {
  return {corner[0] * spacing, corner[1] * spacing, corner[2] * spacing};
}

}  // namespace

Correlator::Correlator(const std::array<int, 3>& size, double spacing, double moving_reach,
                       int components, int spread_width)
    : size_(size),
      spacing_(spacing),
      components_(components),
      kernel_(search_kernel(spread_width)) {
  const double reach = moving_reach / spacing;
  for (int d = 0; d < 3; ++d) {
    // Cells that a knot within reach of the corner's middle can touch.
    corner_[d] = std::min(size[d], static_cast<int>(std::ceil(2.0 * reach)) + spread_width + 1);
    origin_[d] = 0.5 * (corner_[d] - 1);
  }
  corner_[2] = size[2];  // rows are transformed whole
  const int nx = size[0], ny = size[1], nz = size[2], nc = nz / 2 + 1;
  columns_ = round_up(nc, 8);
  row_ = round_up(nz, 16);
  table_ = &pick_isa(best_isa(), isa_baseline::kSearchTable, isa_avx2::kSearchTable,
                     isa_avx512::kSearchTable);
  const Spreader<3, float> spreader(corner_, corner_box(corner_, spacing), kernel_,
                                    WeightKind::real);
  using Fft = FftPlan<float>;
  const std::ptrdiff_t c = columns_, plane = c * ny;
  forward_z_ = Fft::real_to_complex({{{nz, 1, 1}}, {{corner_[1], spreader.stride(1), c}}}, false);
  forward_y_ = Fft::complex_to_complex({{{ny, c, c}}, {{nc, 1, 1}}}, true, false);
  forward_x_ = Fft::complex_to_complex({{{nx, plane, c}}, {{nc, 1, 1}}}, true, false);
  backward_x_ = Fft::complex_to_complex({{{nx, c, plane}}, {{nc, 1, 1}}}, false, false);
  backward_y_ = Fft::complex_to_complex({{{ny, c, c}}, {{nc, 1, 1}}}, false, true);
  backward_z_ = Fft::complex_to_real({{{nz, 1, 1}}, {{ny, c, row_}}}, false);
  fixed_.resize(static_cast<std::size_t>(components) * ny * nx * columns_);
}

Correlator::Workspace::Workspace(const Correlator& plan)
    : spreader(plan.corner_, corner_box(plan.corner_, plan.spacing_), plan.kernel_,
               WeightKind::real) {
  const auto [nx, ny, nz] = plan.size_;
  const std::size_t plane = static_cast<std::size_t>(ny) * plan.columns_;
  corner.resize(spreader.grid_size());
  lines.resize(plane);
  planes.resize(plan.components_ * nx * plane);
  tile.resize(static_cast<std::size_t>(nx) * plan.columns_);
  sum.resize(tile.size());
  product.resize(nx * plane);
  scores.resize(static_cast<std::size_t>(nx) * ny * plan.row_, kLowest);
  maxima.resize(static_cast<std::size_t>(nx) * ny);
}

void Correlator::set_fixed(
    int component, const std::function<std::complex<double>(int kx, int ky, int kz)>& value) {
  const auto [nx, ny, nz] = size_;
  const auto fold = [](int i, int n) { return i < (n + 1) / 2 ? i : i - n; };
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      for (int k = 0; k <= nz / 2; ++k) {
        const int kx = fold(i, nx), ky = fold(j, ny);
        const double deconvolution = kernel_.transform(static_cast<double>(kx) / nx) *
                                     kernel_.transform(static_cast<double>(ky) / ny) *
                                     kernel_.transform(static_cast<double>(k) / nz);
        fixed_[((static_cast<std::size_t>(component) * ny + j) * nx + i) * columns_ + k] =
            std::complex<float>(value(kx, ky, k) / deconvolution);
      }
}

void Correlator::correlate(const Eigen::Matrix3Xd& points,
                           const std::vector<Eigen::VectorXf>& weights,
                           const Eigen::Matrix3d& rotation, Workspace& w) const {
  const auto [nx, ny, nz] = size_;
  const std::ptrdiff_t c = columns_, plane = c * ny, tile = c * nx;
  const Eigen::Vector3d middle(origin_[0] * spacing_, origin_[1] * spacing_, origin_[2] * spacing_);
  w.points.noalias() = rotation * points;
  w.points.colwise() += middle;
  for (int p = 0; p < components_; ++p) {
    w.spreader.spread(w.points, weights[p], w.corner.data());
    std::complex<float>* planes = w.planes.data() + p * nx * plane;
    for (int i = 0; i < corner_[0]; ++i) {
      forward_z_.run(w.corner.data() + i * w.spreader.stride(0), w.lines.data());
      forward_y_.run(w.lines.data(), planes + i * plane);
    }
  }
  for (int j = 0; j < ny; ++j) {
    for (int p = 0; p < components_; ++p) {
      forward_x_.run(w.planes.data() + p * nx * plane + j * c, w.tile.data());
      table_->multiply_conjugate(
          reinterpret_cast<const float*>(fixed_.data() + (p * ny + j) * tile),
          reinterpret_cast<const float*>(w.tile.data()), tile, p == 0,
          reinterpret_cast<float*>(w.sum.data()));
    }
    backward_x_.run(w.sum.data(), w.product.data() + j * c);
  }
  for (int i = 0; i < nx; ++i) {
    std::complex<float>* slab = w.product.data() + i * plane;
    backward_y_.run(slab, slab);
    float* scores = w.scores.data() + static_cast<std::ptrdiff_t>(i) * ny * row_;
    backward_z_.run(slab, scores);
    table_->row_maxima(scores, ny, row_, w.maxima.data() + static_cast<std::ptrdiff_t>(i) * ny);
  }
}

std::vector<GridPeak> Correlator::take_peaks(Workspace& w, int count, double separation) const {
  const auto [nx, ny, nz] = size_;
  const auto wrap = [](int i, int n) { return i < 0 ? i + n : i >= n ? i - n : i; };
  const auto row_at = [&](int i, int j) {
    return w.scores.data() + (static_cast<std::ptrdiff_t>(wrap(i, nx)) * ny + wrap(j, ny)) * row_;
  };
  // Cells nearer than this are cleared around a peak; at most half the box, so that wrap()
  // suffices.
  const int radius = std::min({static_cast<int>(separation), nx / 2, ny / 2, nz / 2});
  const double separation_sq = separation * separation;
  std::vector<GridPeak> peaks;
  while (static_cast<int>(peaks.size()) < count) {
    const auto best =
        static_cast<int>(std::max_element(w.maxima.begin(), w.maxima.end()) - w.maxima.begin());
    const int i = best / ny, j = best % ny;
    float* const row = row_at(i, j);
    const int k = static_cast<int>(std::max_element(row, row + nz) - row);
    const float top = row[k];
    if (!(top > kLowest)) break;  // everything has been taken
    GridPeak peak{top, {i, j, k}, {}};
    for (int d = 0; d < 3; ++d) {  // a parabola through the three points of each axis
      const int di = d == 0, dj = d == 1, dk = d == 2;
      const float below = row_at(i - di, j - dj)[wrap(k - dk, nz)];
      const float above = row_at(i + di, j + dj)[wrap(k + dk, nz)];
      const float curvature = 2.0F * top - below - above;
      if (!(below > kLowest) || !(above > kLowest) || below > top || above > top ||
          !(curvature > 0.0F))
        continue;  // not a maximum along this axis: a neighbour belongs to a better peak
      peak.offset[d] = 0.5F * (above - below) / curvature;
      peak.score += 0.25F * (above - below) * peak.offset[d];
    }
    peaks.push_back(peak);
    for (int a = -radius; a <= radius; ++a)
      for (int b = -radius; b <= radius; ++b) {
        if (a * a + b * b > separation_sq) continue;
        float* const near = row_at(i + a, j + b);
        for (int e = -radius; e <= radius; ++e)
          if (a * a + b * b + e * e <= separation_sq) near[wrap(k + e, nz)] = kLowest;
        w.maxima[static_cast<std::size_t>(wrap(i + a, nx)) * ny + wrap(j + b, ny)] =
            *std::max_element(near, near + nz);
      }
  }
  return peaks;
}

}  // namespace mortise
