// SPDX-License-Identifier: GPL-3.0-or-later
// Which modes a gap function keeps, in which order, and how well they are interpolated.
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "collision/gap_state.hpp"

namespace mortise {
namespace {

// 0 and one of each pair k, -k with |k|^2 <= reach^2.
std::vector<Eigen::Vector3i> half_ball(int reach) {
  std::vector<Eigen::Vector3i> modes;
  for (int z = 0; z <= reach; ++z)
    for (int y = z == 0 ? 0 : -reach; y <= reach; ++y)
      for (int x = z == 0 && y == 0 ? 0 : -reach; x <= reach; ++x)
        if (x * x + y * y + z * z <= reach * reach) modes.emplace_back(x, y, z);
  std::sort(modes.begin(), modes.end(), [](const Eigen::Vector3i& a, const Eigen::Vector3i& b) {
    const int na = a.squaredNorm(), nb = b.squaredNorm();
    return na != nb ? na < nb
                    : std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  });
  return modes;
}

}  // namespace

// A ball's part of (spacing 1 / box)^3 lattice points, and then some.
int GapFunction::State::reach_of(int half) {
  int reach = static_cast<int>(std::ceil(std::cbrt(half * 1.5 / std::numbers::pi)));
  while (static_cast<int>(half_ball(reach).size()) < half) ++reach;
  return reach;
}

void GapFunction::State::order_modes(int half, const Eigen::MatrixXcd& spectrum, int side,
                                     const GapOptions& options) {
  std::vector<Eigen::Vector3i> candidates = half_ball(side / 2 - 1);
  const auto row = [&](const Eigen::Vector3i& k) {
    const Eigen::Index h = side / 2, n = side;
    return ((k[0] + h) * n + k[1] + h) * n + k[2] + h;
  };
  const auto window = [&](const Eigen::Vector3i& k) {
    return options.window ? options.window(k.cast<double>() / box) : 1.0;
  };
  candidates.resize(half);
  modes = std::move(candidates);
  coefficients.resize(half, spectrum.cols());
  for (int i = 0; i < half; ++i) {
    const double scale = (modes[i].isZero() ? 1.0 : 2.0) * window(modes[i]) / (box * box * box);
    for (Eigen::Index p = 0; p < spectrum.cols(); ++p)
      coefficients(i, p) = (p == 0 ? scale : -scale) * spectrum(row(modes[i]), p);
    bandwidth = std::max(bandwidth, modes[i].cast<double>().norm() / box);
  }
}

void GapFunction::State::pack() {
  const std::size_t count = (modes.size() + kModeBlock - 1) / kModeBlock * kModeBlock;
  for (int d = 0; d < 3; ++d) {
    frequency[d].assign(count, 0.0F);
    for (std::size_t i = 0; i < modes.size(); ++i)
      frequency[d][i] = static_cast<float>(modes[i][d]);
  }
  for (Eigen::Index p = 0; p < coefficients.cols(); ++p) {
    real.emplace_back(count, 0.0F);
    imag.emplace_back(count, 0.0F);
    for (std::size_t i = 0; i < modes.size(); ++i) {
      const std::complex<double> c = coefficients(static_cast<Eigen::Index>(i), p);
      real.back()[i] = static_cast<float>(c.real());
      imag.back()[i] = static_cast<float>(c.imag());
    }
  }
}

void GapFunction::State::measure_error(int threads) {
  constexpr double kWork = 2e7;  // exponentials spent on this
  const double wanted = std::clamp(kWork / static_cast<double>(moving.size()), 16.0, 512.0);
  std::mt19937_64 random(20110307);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::Matrix3Xd frequencies(3, static_cast<Eigen::Index>(wanted));
  for (Eigen::Index i = 0; i < frequencies.cols(); ++i) do {
      frequencies.col(i) << uniform(random), uniform(random), uniform(random);
    } while (frequencies.col(i).norm() > 1.0);
  frequencies *= bandwidth;
  const Eigen::MatrixXcd exact =
      density_spectrum_at(moving, moving_ball.centre, frequencies, threads);
  for (std::size_t p = 0; p < tables.size(); ++p) {
    double total = 0.0;
    for (Eigen::Index i = 0; i < moving.size(); ++i)
      total += std::abs(p == 0 ? moving.weights[i].real() : moving.weights[i].imag()) *
               (moving.radii.size() > 0 ? moving.kernel.volume(moving.radii[i]) : 1.0);
    if (total == 0.0) continue;
    for (Eigen::Index i = 0; i < frequencies.cols(); ++i)
      interpolation_error =
          std::max(interpolation_error, std::abs(tables[p].at(frequencies.col(i), kernel.kernel) -
                                                 exact(i, 4 * static_cast<Eigen::Index>(p))) /
                                            total);
  }
}

}  // namespace mortise
