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
constexpr std::size_t kMostVisits = 50000;  // cells looked at for summits

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
  plane_row_ = round_up(ny, 16);
  table_ = &pick_isa(best_isa(), isa_baseline::kSearchTable, isa_avx2::kSearchTable,
                     isa_avx512::kSearchTable);
  const Spreader<3, float> spreader(corner_, corner_box(corner_, spacing), kernel_,
                                    WeightKind::kReal);
  using Fft = FftPlan<float>;
  const std::ptrdiff_t c = columns_;
  // An odd number of cache lines, so that a line across all planes does not fall into few cache
  // sets.
  plane_ = (c * ny / 8 | 1) * 8;
  const std::ptrdiff_t plane = plane_;
  forward_z_ = Fft::real_to_complex({{{nz, 1, 1}}, {{corner_[1], spreader.stride(1), c}}}, false);
  forward_y_ = Fft::complex_to_complex({{{ny, c, c}}, {{nc, 1, 1}}}, true, false);
  forward_x_ = Fft::complex_to_complex({{{nx, plane, c}}, {{nc, 1, 1}}}, true, false);
  backward_x_ = Fft::complex_to_complex({{{nx, c, plane}}, {{nc, 1, 1}}}, false, false);
  // Out of place: in place, the plan that ESTIMATE finds is up to 4 times slower (40 x 40 x 40).
  backward_y_ = Fft::complex_to_complex({{{ny, c, c}}, {{nc, 1, 1}}}, false, false);
  backward_z_ = Fft::complex_to_real({{{nz, 1, 1}}, {{ny, c, row_}}}, false);
  fixed_.resize(static_cast<std::size_t>(components) * ny * nx * columns_);
}

Correlator::Workspace::Workspace(const Correlator& plan)
    : spreader(plan.corner_, corner_box(plan.corner_, plan.spacing_), plan.kernel_,
               WeightKind::kReal) {
  const auto [nx, ny, nz] = plan.size_;
  const auto plane = static_cast<std::size_t>(plan.plane_);
  corner.resize(spreader.grid_size());
  lines.resize(plane);
  planes.resize(plan.components_ * nx * plane);
  tile.resize(static_cast<std::size_t>(nx) * plan.columns_);
  sum.resize(tile.size());
  product.resize(nx * plane);
  slab.resize(plane);
  scores.resize(static_cast<std::size_t>(nx) * ny * plan.row_, kLowest);
  maxima.resize(static_cast<std::size_t>(nx) * plan.plane_row_, kLowest);
  plane_maxima.resize(nx);
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
  rotate(points, rotation, w);
  for (int p = 0; p < components_; ++p) {
    spread(weights[p], w);
    forward_zy(p, w);
  }
  multiply(w);
  backward_yz(w);
}

void Correlator::rotate(const Eigen::Matrix3Xd& points, const Eigen::Matrix3d& rotation,
                        Workspace& w) const {
  const Eigen::Vector3d middle(origin_[0] * spacing_, origin_[1] * spacing_, origin_[2] * spacing_);
  w.points.noalias() = rotation * points;
  w.points.colwise() += middle;
}

void Correlator::spread(const Eigen::VectorXf& weights, Workspace& w) const {
  w.spreader.spread(w.points, weights, w.corner.data());
}

void Correlator::forward_zy(int component, Workspace& w) const {
  std::complex<float>* const planes = w.planes.data() + component * size_[0] * plane_;
  for (int i = 0; i < corner_[0]; ++i) {
    forward_z_.run(w.corner.data() + i * w.spreader.stride(0), w.lines.data());
    forward_y_.run(w.lines.data(), planes + i * plane_);
  }
}

void Correlator::multiply(Workspace& w) const {
  const auto [nx, ny, nz] = size_;
  const std::ptrdiff_t c = columns_, tile = c * nx;
  for (int j = 0; j < ny; ++j) {
    for (int p = 0; p < components_; ++p) {
      forward_x_.run(w.planes.data() + p * nx * plane_ + j * c, w.tile.data());
      table_->multiply_conjugate(
          reinterpret_cast<const float*>(fixed_.data() + (p * ny + j) * tile),
          reinterpret_cast<const float*>(w.tile.data()), tile, p == 0,
          reinterpret_cast<float*>(w.sum.data()));
    }
    backward_x_.run(w.sum.data(), w.product.data() + j * c);
  }
}

void Correlator::backward_yz(Workspace& w) const {
  const std::ptrdiff_t ny = size_[1];
  for (int i = 0; i < size_[0]; ++i) {
    backward_y_.run(w.product.data() + i * plane_, w.slab.data());
    float* const scores = w.scores.data() + i * ny * row_;
    backward_z_.run(w.slab.data(), scores);
    float* const maxima = w.maxima.data() + static_cast<std::ptrdiff_t>(i) * plane_row_;
    table_->row_maxima(scores, ny, row_, maxima);
    table_->row_maxima(maxima, 1, plane_row_, w.plane_maxima.data() + i);
  }
}

GridPeak Correlator::peak_at(const Workspace& w, const std::array<int, 3>& cell) const {
  const auto score = [&](std::array<int, 3> at, int axis, int step) {
    const int n = size_[axis];
    at[axis] = (at[axis] + step + n) % n;
    return w.scores[(static_cast<std::size_t>(at[0]) * size_[1] + at[1]) * row_ + at[2]];
  };
  const float top = score(cell, 0, 0);
  GridPeak peak{top, cell, {}};
  for (int d = 0; d < 3; ++d) {  // a parabola through the three points of each axis
    const float below = score(cell, d, -1), above = score(cell, d, 1);
    const float curvature = 2.0F * top - below - above;
    if (!(below > kLowest) || !(above > kLowest) || below > top || above > top ||
        !(curvature > 0.0F))
      continue;  // not a maximum along this axis: a neighbour belongs to a better peak
    peak.offset[d] = 0.5F * (above - below) / curvature;
    peak.score += 0.25F * (above - below) * peak.offset[d];
  }
  return peak;
}

void Correlator::clear_ball(Workspace& w, const GridPeak& peak, double separation) const {
  const auto [nx, ny, nz] = size_;
  // At most half the box, so that one wrap suffices.
  std::array<int, 3> radius;
  for (int d = 0; d < 3; ++d)
    radius[d] = static_cast<int>(std::min(std::ceil(separation + 0.5), 0.5 * size_[d]));
  const auto wrap = [](int i, int n) { return i < 0 ? i + n : i >= n ? i - n : i; };
  const auto off_sq = [&](int d, int step) {
    return std::pow(step - static_cast<double>(peak.offset[d]), 2);
  };
  const double separation_sq = separation * separation;
  for (int a = -radius[0]; a <= radius[0]; ++a) {
    if (a != 0 && off_sq(0, a) >= separation_sq) continue;
    const int i = wrap(peak.cell[0] + a, nx);
    float* const plane = w.maxima.data() + static_cast<std::ptrdiff_t>(i) * plane_row_;
    for (int b = -radius[1]; b <= radius[1]; ++b) {
      const double ab = off_sq(0, a) + off_sq(1, b);
      if ((a != 0 || b != 0) && ab >= separation_sq) continue;
      const int j = wrap(peak.cell[1] + b, ny);
      float* const near = w.scores.data() + (static_cast<std::ptrdiff_t>(i) * ny + j) * row_;
      for (int c = -radius[2]; c <= radius[2]; ++c)
        if ((a == 0 && b == 0 && c == 0) || ab + off_sq(2, c) < separation_sq)
          near[wrap(peak.cell[2] + c, nz)] = kLowest;
      table_->row_maxima(near, 1, row_, plane + j);
    }
    table_->row_maxima(plane, 1, plane_row_, w.plane_maxima.data() + i);
  }
}

bool Correlator::touches_cleared(const Workspace& w, const std::array<int, 3>& cell) const {
  for (int a = -1; a <= 1; ++a)
    for (int b = -1; b <= 1; ++b) {
      const int i = (cell[0] + a + size_[0]) % size_[0];
      const int j = (cell[1] + b + size_[1]) % size_[1];
      const float* const near =
          w.scores.data() + (static_cast<std::ptrdiff_t>(i) * size_[1] + j) * row_;
      for (int c = -1; c <= 1; ++c)
        if ((a != 0 || b != 0 || c != 0) && !(near[(cell[2] + c + size_[2]) % size_[2]] > kLowest))
          return true;
    }
  return false;
}

std::vector<GridPeak> Correlator::take_peaks(Workspace& w, int count, double separation,
                                             bool summits) const {
  const auto [nx, ny, nz] = size_;
  const auto first_largest = [](const float* values, int n) {
    return static_cast<int>(std::max_element(values, values + n) - values);
  };
  std::vector<GridPeak> peaks;
  const auto too_near = [&](const GridPeak& a, const GridPeak& b) {
    double distance_sq = 0.0;
    for (int d = 0; d < 3; ++d) {
      const double step = a.cell[d] - b.cell[d] + static_cast<double>(a.offset[d] - b.offset[d]);
      distance_sq += std::pow(step - size_[d] * std::round(step / size_[d]), 2);
    }
    return distance_sq < separation * separation;
  };
  std::size_t visits = 0;
  while (static_cast<int>(peaks.size()) < count && (!summits || visits++ < kMostVisits)) {
    const int i = first_largest(w.plane_maxima.data(), nx);
    const int j = first_largest(w.maxima.data() + static_cast<std::ptrdiff_t>(i) * plane_row_, ny);
    const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(i) * ny + j;
    const int k = first_largest(w.scores.data() + row * row_, nz);
    if (!(w.scores[row * row_ + k] > kLowest)) break;  // everything has been taken
    const GridPeak peak = peak_at(w, {i, j, k});
    // A cell outside the cleared ball may have its maximum inside; then only the cell is cleared.
    // Of summits no more than the cell ever is: cells fall from the highest down, so one that
    // touches a cleared one is on its slope.
    const bool taken = (summits && touches_cleared(w, peak.cell)) ||
                       std::any_of(peaks.begin(), peaks.end(),
                                   [&](const GridPeak& other) { return too_near(peak, other); });
    clear_ball(w, peak, taken || summits ? 0.0 : separation);
    if (!taken) peaks.push_back(peak);
  }
  // The sub-grid maximum of a lower cell may be the higher one.
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const GridPeak& a, const GridPeak& b) { return a.score > b.score; });
  return peaks;
}

}  // namespace mortise
