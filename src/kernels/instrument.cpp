// SPDX-License-Identifier: GPL-3.0-or-later
// Windows, values and integrals of instrument kernels.
#include "mortise/kernels/instrument.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr int kSamplesPerMode = 32;

double window_at(InstrumentWindow window, double u) {
  switch (window) {
    case InstrumentWindow::kFejer:
      return 1.0 - u;
    case InstrumentWindow::kHann:
      return 0.5 + 0.5 * std::cos(std::numbers::pi * u);
    case InstrumentWindow::kBlackman:
      return 0.42 + 0.5 * std::cos(std::numbers::pi * u) + 0.08 * std::cos(kTwoPi * u);
  }
  throw InputError("window_kernel: unknown window");
}

InstrumentKernel scaled(InstrumentKernel kernel) {
  kernel.coefficients /= kernel.coefficients[0];
  return kernel;
}

// A root of k between a and b, whose signs differ.
double bisect(const InstrumentKernel& kernel, double a, double b) {
  const bool rising = kernel(a) < 0.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (a + b);
    (kernel(middle) < 0.0) == rising ? a = middle : b = middle;
  }
  return 0.5 * (a + b);
}

}  // namespace

double InstrumentKernel::operator()(double x) const {
  // Clenshaw's recurrence.
  const double c = 2.0 * std::cos(kTwoPi * x / period);
  double b1 = 0.0;
  double b2 = 0.0;
  for (Eigen::Index j = degree(); j >= 1; --j) {
    const double b0 = 2.0 * coefficients[j] + c * b1 - b2;
    b2 = b1;
    b1 = b0;
  }
  return (coefficients[0] + 0.5 * c * b1 - b2) / period;
}

double InstrumentKernel::antiderivative(double x) const {
  double sum = coefficients[0] * x / period;
  for (Eigen::Index j = 1; j <= degree(); ++j) {
    const double f = static_cast<double>(j);
    sum += coefficients[j] * std::sin(kTwoPi * f * x / period) / (std::numbers::pi * f);
  }
  return sum;
}

double InstrumentKernel::absolute_mass(double from, double to) const {
  if (!(from <= to))
    throw InputError("absolute_mass: expected from <= to, got " + std::to_string(from) + " and " +
                     std::to_string(to));
  const double modes = static_cast<double>(degree()) * (to - from) / period;
  const int n = static_cast<int>(std::ceil(kSamplesPerMode * modes)) + 1;
  double sum = 0.0;
  double last_root = from;
  double at = from;
  double value = (*this)(from);
  for (int i = 1; i <= n; ++i) {
    const double next = from + (to - from) * i / n;
    const double next_value = (*this)(next);
    if (value * next_value < 0.0) {
      const double root = bisect(*this, at, next);
      sum += std::abs(antiderivative(root) - antiderivative(last_root));
      last_root = root;
    }
    at = next;
    value = next_value;
  }
  return sum + std::abs(antiderivative(to) - antiderivative(last_root));
}

InstrumentKernel window_kernel(InstrumentWindow window, int degree, double period) {
  if (degree < 1)
    throw InputError("window_kernel: degree must be >= 1, got " + std::to_string(degree));
  if (!(period > 0.0))
    throw InputError("window_kernel: period must be > 0, got " + std::to_string(period));
  InstrumentKernel result{period, Eigen::VectorXd(degree + 1)};
  for (int j = 0; j <= degree; ++j)
    result.coefficients[j] = window_at(window, static_cast<double>(j) / (degree + 1));
  return result;
}

InstrumentKernel lifted_to_nonnegative(const InstrumentKernel& kernel) {
  const auto n = static_cast<int>(kSamplesPerMode * kernel.degree()) + 2;
  const double step = 0.5 * kernel.period / n;
  double least = kernel(0.0);
  for (int i = 0; i <= n; ++i) {
    const double x = step * i;
    // The vertex of the parabola through three samples: the minimum lies between them.
    const double y0 = kernel(x - step);
    const double y1 = kernel(x);
    const double y2 = kernel(x + step);
    if (y1 > y0 || y1 > y2) continue;
    const double curvature = y0 - 2.0 * y1 + y2;
    const double shift = curvature > 0.0 ? 0.5 * (y0 - y2) / curvature : 0.0;
    least = std::min({least, y1, kernel(x + step * std::clamp(shift, -1.0, 1.0))});
  }
  if (least >= 0.0) return kernel;
  InstrumentKernel lifted = kernel;
  lifted.coefficients[0] -= least * kernel.period * (1.0 + 1e-6);
  return scaled(lifted);
}

InstrumentKernel squared(const InstrumentKernel& kernel) {
  const Eigen::Index n = kernel.degree();
  const auto c = [&](Eigen::Index j) {
    return std::abs(j) > n ? 0.0 : kernel.coefficients[std::abs(j)];
  };
  InstrumentKernel result{kernel.period, Eigen::VectorXd::Zero(2 * n + 1)};
  for (Eigen::Index j = 0; j <= 2 * n; ++j)
    for (Eigen::Index i = -n; i <= n; ++i) result.coefficients[j] += c(i) * c(j - i);
  return scaled(result);
}

}  // namespace mortise
