// SPDX-License-Identifier: GPL-3.0-or-later
// All translations at one rotation.
#include "search/correlator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace mortise {

namespace {

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

// Cells that a knot within reach of the corner's middle can touch.
std::array<int, 3> corner_cells(const std::array<int, 3>& size, double spacing, double moving_reach,
                                int spread_width) {
  const double reach = moving_reach / spacing;
  std::array<int, 3> corner;
  for (int d = 0; d < 3; ++d)
    corner[d] = std::min(size[d], static_cast<int>(std::ceil(2.0 * reach)) + spread_width + 1);
  return corner;
}

}  // namespace

std::array<double, 3> corner_middle(const std::array<int, 3>& size, double spacing,
                                    double moving_reach, int spread_width) {
  const std::array<int, 3> corner = corner_cells(size, spacing, moving_reach, spread_width);
  return {0.5 * (corner[0] - 1), 0.5 * (corner[1] - 1), 0.5 * (corner[2] - 1)};
}

Correlator::Correlator(const std::array<int, 3>& size, double spacing, double moving_reach,
                       int components, int spread_width, int offsets)
    : size_(size),
      corner_(corner_cells(size, spacing, moving_reach, spread_width)),
      origin_(corner_middle(size, spacing, moving_reach, spread_width)),
      spacing_(spacing),
      components_(components),
      offsets_(offsets),
      kernel_(search_kernel(spread_width)) {
  corner_[2] = size[2];  // rows are transformed whole
  const int nx = size[0], ny = size[1], nz = size[2], nc = nz / 2 + 1;
  columns_ = round_up(nc, 8);
  const std::ptrdiff_t c = columns_;
  // An odd number of cache lines, so that a line across all planes does not fall into few cache
  // sets.
  plane_ = (c * ny / 8 | 1) * 8;
  fft_x_ = LaneFft(nx);
  fft_y_ = LaneFft(ny);
  fft_z_ = LaneFft(nz);
  fixed_.resize(static_cast<std::size_t>(components) * offsets * ny * nx * columns_);
}

Correlator::Workspace::Workspace(const Correlator& plan)
    : spreader(plan.corner_, corner_box(plan.corner_, plan.spacing_), plan.kernel_,
               WeightKind::kReal),
      box(plan.size_) {
  const int nx = plan.size_[0];
  const auto plane = static_cast<std::size_t>(plan.plane_);
  corner.resize(spreader.grid_size());
  lines.resize(plane);
  planes.resize(plan.components_ * nx * plane);
  tile.resize(static_cast<std::size_t>(nx) * plan.columns_);
  sum.resize(plan.offsets_ * tile.size());
  product.resize(plan.offsets_ * nx * plane);
  slab.resize(plane);
  fft_work_x = plan.fft_x_.make_work();
  fft_work_y = plan.fft_y_.make_work();
  fft_work_z = plan.fft_z_.make_work();
}

void Correlator::set_fixed(
    int component, int offset,
    const std::function<std::complex<double>(int kx, int ky, int kz)>& value) {
  const auto [nx, ny, nz] = size_;
  const auto fold = [](int i, int n) { return i < (n + 1) / 2 ? i : i - n; };
  // Once an axis: Bessel functions at every mode of every offset took longer than all else here.
  std::array<std::vector<double>, 3> along;
  for (std::size_t d = 0; d < 3; ++d)
    for (int i = 0; i < size_[d]; ++i)
      along[d].push_back(kernel_.transform(static_cast<double>(fold(i, size_[d])) / size_[d]));
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      for (int k = 0; k <= nz / 2; ++k) {
        const int kx = fold(i, nx), ky = fold(j, ny);
        const double deconvolution = along[0][i] * along[1][j] * along[2][k];
        fixed_[((static_cast<std::size_t>(component * offsets_ + offset) * ny + j) * nx + i) *
                   columns_ +
               k] = std::complex<float>(value(kx, ky, k) / deconvolution);
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
    fft_z_.forward_rows(w.corner.data() + i * w.spreader.stride(0), w.spreader.stride(1),
                        corner_[1], w.lines.data(), columns_, w.fft_work_z);
    fft_y_.run(true, w.lines.data(), columns_, corner_[1], planes + i * plane_, columns_, columns_,
               w.fft_work_y);
  }
}

void Correlator::multiply(Workspace& w) const {
  const auto [nx, ny, nz] = size_;
  const std::ptrdiff_t c = columns_, tile = c * nx;
  for (int j = 0; j < ny; ++j) {
    for (int p = 0; p < components_; ++p) {
      fft_x_.run(true, w.planes.data() + p * nx * plane_ + j * c, plane_, corner_[0], w.tile.data(),
                 c, c, w.fft_work_x);
      for (int o = 0; o < offsets_; ++o)
        search_loops().multiply_conjugate(
            reinterpret_cast<const float*>(fixed_.data() + ((p * offsets_ + o) * ny + j) * tile),
            reinterpret_cast<const float*>(w.tile.data()), tile, p == 0,
            reinterpret_cast<float*>(w.sum.data() + o * tile));
    }
    for (int o = 0; o < offsets_; ++o)
      fft_x_.run(false, w.sum.data() + o * tile, c, nx, w.product.data() + o * nx * plane_ + j * c,
                 plane_, c, w.fft_work_x);
  }
}

void Correlator::backward_yz(int offset, Workspace& w) const {
  const std::complex<float>* const product = w.product.data() + offset * size_[0] * plane_;
  for (int i = 0; i < size_[0]; ++i) {
    fft_y_.run(false, product + i * plane_, columns_, size_[1], w.slab.data(), columns_, columns_,
               w.fft_work_y);
    fft_z_.backward_rows(w.slab.data(), columns_, size_[1], w.box.plane(i), w.box.row(),
                         w.fft_work_z);
    w.box.plane_written(i);
  }
}

}  // namespace mortise
