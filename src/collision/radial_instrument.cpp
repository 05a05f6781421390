// SPDX-License-Identifier: GPL-3.0-or-later
// The radial instrument kernel, by quadrature in units of its bandwidth.
#include "mortise/collision/radial_instrument.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/quadrature.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/kernels/ball.hpp"

namespace mortise {
namespace {

using std::numbers::pi;

// Radii are in units of 1 / B. K is worked out up to kReach; beyond, where it is below 1e-10, the
// integral of the asymptotic r^-6 is added to `outside`.
constexpr double kReach = 24.0;
constexpr int kSteps = 4800;
// A table linear between steps h is off by h^2 / 8 max |K^''| at most, and |K^''| <= 4 pi^2 Int r^2
// K / 3 = 15.5 (test): 4.7e-7.
constexpr int kTransformSteps = 2048;

// 4 pi Int_0^{1/2} k^2 cos^2(pi k) sin(2 pi k r) / (2 pi k r) dk, B = 1. At kReach there are 12
// oscillations: 60 nodes are good to rounding.
double root_kernel(double r) {
  static const QuadratureRule rule = gauss_legendre(60, 0.0, 0.5);
  double sum = 0.0;
  for (Eigen::Index i = 0; i < rule.nodes.size(); ++i) {
    const double k = rule.nodes[i], u = 2.0 * pi * k * r;
    sum += rule.weights[i] * std::pow(k * std::cos(pi * k), 2) * (u < 1e-8 ? 1.0 : std::sin(u) / u);
  }
  return 4.0 * pi * sum;
}

// Everything for B = 1, worked out once per process.
struct UnitKernel {
  double step = kReach / kSteps;
  Eigen::VectorXd value = Eigen::VectorXd(kSteps);  // K at (i + 1/2) step, times 4 pi r^2 step
  Eigen::VectorXd outside = Eigen::VectorXd(kSteps + 1);             // at i step
  Eigen::VectorXd transform = Eigen::VectorXd(kTransformSteps + 1);  // at i / kTransformSteps

  UnitKernel() {
    for (int i = 0; i < kSteps; ++i) {
      const double r = (i + 0.5) * step;
      value[i] = 4.0 * pi * r * r * step * std::pow(root_kernel(r), 2);
    }
    const double tail = value[kSteps - 1] / step * kReach / 3.0;  // r^2 r^-6, integrated
    const double total = value.sum() + tail;
    value /= total;
    outside[kSteps] = 4.0 * tail / total;  // an envelope of an oscillating end
    for (int i = kSteps - 1; i >= 0; --i) outside[i] = outside[i + 1] + value[i];
    for (int j = 0; j <= kTransformSteps; ++j) {
      const double k = static_cast<double>(j) / kTransformSteps;
      double sum = 0.0;
      for (int i = 0; i < kSteps; ++i) {
        const double u = 2.0 * pi * k * (i + 0.5) * step;
        sum += value[i] * (u < 1e-8 ? 1.0 : std::sin(u) / u);
      }
      transform[j] = std::max(0.0, sum);
    }
    transform /= transform[0];
    transform[kTransformSteps] = 0.0;
  }
};

const UnitKernel& unit() {
  static const UnitKernel kernel;
  return kernel;
}

}  // namespace

RadialInstrument::RadialInstrument(double bandwidth) : bandwidth_(bandwidth) {
  if (!(bandwidth > 0.0) || !std::isfinite(bandwidth))
    throw InputError("RadialInstrument: bandwidth must be > 0, got " + std::to_string(bandwidth));
}

double RadialInstrument::transform(double k) const {
  const double at = k / bandwidth_ * kTransformSteps;
  if (!(at < kTransformSteps)) return 0.0;
  const int i = static_cast<int>(at);
  const Eigen::VectorXd& table = unit().transform;
  return table[i] + (at - i) * (table[i + 1] - table[i]);
}

double RadialInstrument::outside(double r) const {
  if (r <= 0.0) return 1.0;
  const UnitKernel& kernel = unit();
  return kernel.outside[std::min<Eigen::Index>(
      kSteps, static_cast<Eigen::Index>(r * bandwidth_ / kernel.step))];
}

double RadialInstrument::lens(double r) const {
  const UnitKernel& kernel = unit();
  const double step = kernel.step / bandwidth_;
  double sum = 0.0;
  for (int i = 0; i < kSteps && (i + 0.5) * step < 2.0 * r; ++i)
    sum += kernel.value[i] * ball_overlap_volume(r, r, (i + 0.5) * step);
  return sum;
}

}  // namespace mortise
