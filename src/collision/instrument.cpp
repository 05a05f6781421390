// SPDX-License-Identifier: GPL-3.0-or-later
// Instrument kernels and their cut-off; derivation in docs/math.md.
#include "mortise/collision/instrument.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "collision/remez.hpp"
#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

using std::numbers::pi;

void check(int degree, double period) {
  if (degree < 1)
    throw InputError("instrument_kernel: degree must be >= 1, got " + std::to_string(degree));
  if (!(period > 0.0) || !std::isfinite(period))
    throw InputError("instrument_kernel: period must be > 0, got " + std::to_string(period));
}

// Adds `shift` to the kernel and gives it unit integral.
InstrumentKernel nonnegative(double period, Eigen::VectorXd coefficients, double shift) {
  coefficients[0] += shift;
  coefficients /= coefficients[0] * period;
  return {period, coefficients};
}

// The least value on a grid of 16 points per oscillation, lowered by what may lie between.
double least_value(const InstrumentKernel& kernel) {
  const int count = 16 * (kernel.degree() + 1);
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (int i = 0; i <= count; ++i) {
    const double v = kernel.value(0.5 * kernel.period * i / count);
    least = std::min(least, v);
    most = std::max(most, v);
  }
  // Bernstein: |w''| <= (2 pi n / L)^2 max|w|, and the nearest point is at most L / (64 n) away.
  return least - 0.5 * std::pow(2.0 * pi / 64.0, 2) * std::max(-least, 0.0);
}

}  // namespace

double InstrumentKernel::value(double x) const {
  double sum = coefficients[0];
  for (Eigen::Index k = 1; k < coefficients.size(); ++k)
    sum += 2.0 * coefficients[k] * std::cos(2.0 * pi * static_cast<double>(k) * x / period);
  return sum;
}

double InstrumentKernel::integral(double x) const {
  double sum = coefficients[0] * x;
  for (Eigen::Index k = 1; k < coefficients.size(); ++k) {
    const double f = 2.0 * pi * static_cast<double>(k) / period;
    sum += 2.0 * coefficients[k] * std::sin(f * x) / f;
  }
  return sum;
}

double InstrumentKernel::second_integral(double x) const {
  double sum = 0.5 * coefficients[0] * x * x;
  for (Eigen::Index k = 1; k < coefficients.size(); ++k) {
    const double f = 2.0 * pi * static_cast<double>(k) / period, s = std::sin(0.5 * f * x);
    sum += 4.0 * coefficients[k] * s * s / (f * f);
  }
  return sum;
}

double InstrumentKernel::transform(const Eigen::VectorXd& w) const {
  double product = 1.0;
  for (Eigen::Index d = 0; d < w.size(); ++d) {
    const double k = std::round(std::abs(w[d]) * period);
    product *= k > degree() ? 0.0 : period * coefficients[static_cast<Eigen::Index>(k)];
  }
  return product;
}

InstrumentKernel parks_mcclellan(int degree, double period, double pass, double stop) {
  check(degree, period);
  if (!(0.0 < pass && pass < stop && stop < 0.5 * period))
    throw InputError("parks_mcclellan: expected 0 < pass < stop < period / 2, got " +
                     std::to_string(pass) + ", " + std::to_string(stop) + " and " +
                     std::to_string(period));
  const RemezResult fit = remez(degree, 2.0 * pi * pass / period, 2.0 * pi * stop / period);
  Eigen::VectorXd coefficients = fit.cosines;  // of cos(k theta), without the 2
  coefficients.tail(degree) *= 0.5;
  const double least = least_value({period, coefficients});
  return nonnegative(period, coefficients, std::max(0.0, -least));
}

InstrumentKernel instrument_kernel(InstrumentShape shape, int degree, double period) {
  check(degree, period);
  Eigen::VectorXd a(degree + 1);
  const auto fejer = [](int n) {
    Eigen::VectorXd f(n + 1);
    for (int k = 0; k <= n; ++k) f[k] = 1.0 - k / (n + 1.0);
    return f;
  };
  switch (shape) {
    case InstrumentShape::kFejer:
      return nonnegative(period, fejer(degree), 0.0);
    case InstrumentShape::kHann:
    case InstrumentShape::kJackson: {
      const int half = degree / 2;
      Eigen::VectorXd f = fejer(half);
      if (shape == InstrumentShape::kHann)
        for (int k = 0; k <= half; ++k) f[k] = 0.5 + 0.5 * std::cos(pi * k / (half + 1.0));
      a.setZero();
      for (int i = -half; i <= half; ++i)
        for (int j = -half; j <= half; ++j)
          if (i + j >= 0) a[i + j] += f[std::abs(i)] * f[std::abs(j)];
      return nonnegative(period, a, 0.0);
    }
    case InstrumentShape::kParksMcClellan: {
      // [FC, Sec. 7]'s first guess of the transition, narrow pass band.
      const double transition = std::min(0.3, 0.5 * std::log(degree + 1.0) / (degree + 1.0));
      return parks_mcclellan(degree, period, 0.1 * transition * period, 1.1 * transition * period);
    }
  }
  throw InputError("instrument_kernel: unknown shape");
}

Cutoff estimate_cutoff(const InstrumentKernel& kernel, int dimension, double measure) {
  if (dimension < 1 || dimension > 3)
    throw InputError("estimate_cutoff: dimension must be 1 to 3, got " + std::to_string(dimension));
  if (!(measure >= 0.0)) throw InputError("estimate_cutoff: measure must be >= 0");
  const double period = kernel.period,
               volume = measure > 0.0 ? measure : std::pow(0.5 * period, dimension);
  const int count = 64 * (kernel.degree() + 1);
  const double step = 0.5 * period / count;
  const auto inside = [&](double x0) {
    return std::pow(2.0 * kernel.second_integral(2.0 * x0), dimension);
  };
  std::vector<double> level(count / 2 + 1);  // inside() is monotone: one table serves every x1
  for (std::size_t i = 0; i < level.size(); ++i) level[i] = inside(static_cast<double>(i) * step);
  Cutoff best;
  best.hausdorff = std::numeric_limits<double>::infinity();
  for (int i = 0; i < count; ++i) {
    const double x1 = i * step;
    const double outside =
        volume * std::max(0.0, 1.0 - std::pow(std::min(1.0, 2.0 * kernel.integral(x1)), dimension));
    const auto above = std::upper_bound(level.begin(), level.end(), outside);
    if (above == level.end()) continue;
    const double x0 = static_cast<double>(above - level.begin()) * step;
    if (2.0 * x0 + x1 < best.hausdorff) best = {outside, x0, x1, 2.0 * x0 + x1};
  }
  return best;
}

Instrument best_instrument(InstrumentShape shape, int degree, double period, int dimension,
                           double measure) {
  Instrument best{instrument_kernel(shape, degree, period), {}};
  best.cutoff = estimate_cutoff(best.kernel, dimension, measure);
  if (shape != InstrumentShape::kParksMcClellan) return best;
  // Steps of a third of the way on, both bands in turn, in units of the resolution L / (n + 1).
  const double unit = period / (degree + 1.0);
  double pass = 0.3, transition = 1.0;
  const auto improve = [&](double new_pass, double new_transition) {
    const double stop = (new_pass + new_transition) * unit;
    if (!(stop < 0.45 * period)) return false;
    const InstrumentKernel kernel = parks_mcclellan(degree, period, new_pass * unit, stop);
    const Cutoff cutoff = estimate_cutoff(kernel, dimension, measure);
    if (!(cutoff.hausdorff < best.cutoff.hausdorff)) return false;
    best = {kernel, cutoff};
    pass = new_pass, transition = new_transition;
    return true;
  };
  for (const double start : {0.7, 1.4, 2.0, 2.8, 3.6, 4.8}) improve(pass, start);
  bool moved = true;
  for (double factor = 1.3; factor > 1.04; factor = std::sqrt(factor))
    for (moved = true; moved;) {
      moved = improve(pass, transition * factor) || improve(pass, transition / factor);
      moved = improve(pass * factor, transition) || improve(pass / factor, transition) || moved;
    }
  return best;
}

}  // namespace mortise
