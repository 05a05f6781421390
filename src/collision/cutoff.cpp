// SPDX-License-Identifier: GPL-3.0-or-later
// Thresholds and error bounds of truncated gap functions.
//
// Notation: d dimension, M = largest_overlap, ov(y) the common volume of two fattening sets whose
// centres are y apart, K the product of kernels, K- its negative part. Where the bodies meet,
// V >= Int K ov - M Int K-. Farther than 2 x0 + x1 from the obstacle, V <= M Int_{outside x1} K+,
// and Int_{outside} K+ <= Int K+ - Int_{inside} K, whose last term is exact by Parseval.
#include "mortise/collision/cutoff.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "mortise/core/errors.hpp"
#include "mortise/kernels/ball.hpp"

namespace mortise {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void check(const InstrumentKernel& kernel, const CutoffOptions& options) {
  if (options.dimension != 2 && options.dimension != 3)
    throw InputError("estimate_cutoff: dimension must be 2 or 3, got " +
                     std::to_string(options.dimension));
  if (!(options.largest_overlap >= 0.0 && std::isfinite(options.largest_overlap)))
    throw InputError("estimate_cutoff: largest_overlap must be >= 0, got " +
                     std::to_string(options.largest_overlap));
  if (options.steps < 10)
    throw InputError("estimate_cutoff: steps must be >= 10, got " + std::to_string(options.steps));
  if (kernel.coefficients.size() < 2 || !(kernel.period > 0.0) ||
      !(std::abs(kernel.coefficients[0] - 1.0) < 1e-9))
    throw InputError(
        "estimate_cutoff: expected a kernel of degree >= 1 with coefficient 0 equal to 1");
}

// Fourier transform of the indicator of a disc of radius r at frequency |w| = k.
double disc_transform(double k, double r) {
  if (k * r < 1e-9) return std::numbers::pi * r * r;
  return r * std::cyl_bessel_j(1.0, 2.0 * std::numbers::pi * k * r) / k;
}

// prod_axes c_|j| summed over all frequencies j of one length |j|^2, with that length.
struct Shell {
  double frequency;
  double sum;
};

std::vector<Shell> shells(const InstrumentKernel& kernel, int dimension) {
  const Eigen::Index n = kernel.degree();
  std::vector<double> by_square(static_cast<std::size_t>(dimension * n * n + 1), 0.0);
  const auto c = [&](Eigen::Index j) { return (j == 0 ? 1.0 : 2.0) * kernel.coefficients[j]; };
  for (Eigen::Index i = 0; i <= n; ++i)
    for (Eigen::Index j = 0; j <= n; ++j)
      for (Eigen::Index k = 0; k <= (dimension == 3 ? n : 0); ++k)
        by_square[static_cast<std::size_t>(i * i + j * j + k * k)] += c(i) * c(j) * c(k);
  std::vector<Shell> result;
  for (std::size_t q = 0; q < by_square.size(); ++q)
    if (by_square[q] != 0.0)
      result.push_back({std::sqrt(static_cast<double>(q)) / kernel.period, by_square[q]});
  return result;
}

// Integrals of K over one period against sets of half width r: exact by Parseval.
class KernelMass {
 public:
  KernelMass(const InstrumentKernel& kernel, const CutoffOptions& options)
      : kernel_(kernel), options_(options) {
    if (options.fattening == Fattening::kBall) shells_ = shells(kernel, options.dimension);
  }

  // Int K over the ball or cube.
  [[nodiscard]] double inside(double r) const { return sum(r, 1); }
  // Int K ov: the spectrum of a set's self-overlap is its own squared.
  [[nodiscard]] double overlap(double r) const { return sum(r, 2); }

 private:
  [[nodiscard]] double sum(double r, int power) const {
    if (options_.fattening == Fattening::kBall) {
      double total = 0.0;
      for (const Shell& shell : shells_) {
        const double f = options_.dimension == 3 ? ball_transform(shell.frequency, r)
                                                 : disc_transform(shell.frequency, r);
        total += shell.sum * (power == 1 ? f : f * f);
      }
      return total / std::pow(kernel_.period, options_.dimension);
    }
    double axis = std::pow(2.0 * r, power);
    for (Eigen::Index j = 1; j <= kernel_.degree(); ++j) {
      const double w = std::numbers::pi * static_cast<double>(j) / kernel_.period;
      const double side = std::sin(2.0 * w * r) / w;  // transform of an interval of half length r
      axis += 2.0 * kernel_.coefficients[j] * std::pow(side, power);
    }
    return std::pow(axis / kernel_.period, options_.dimension);
  }

  const InstrumentKernel& kernel_;
  const CutoffOptions& options_;
  std::vector<Shell> shells_;
};

}  // namespace

Cutoff estimate_cutoff(const InstrumentKernel& kernel, const CutoffOptions& options) {
  check(kernel, options);
  const double half = 0.5 * kernel.period;
  const double most =
      options.largest_overlap > 0.0 ? options.largest_overlap : std::pow(half, options.dimension);
  const double whole =
      std::pow(kernel.absolute_mass(-half, half), static_cast<double>(options.dimension));
  const double negative = 0.5 * std::max(0.0, whole - 1.0);
  const KernelMass mass(kernel, options);
  const auto n = static_cast<std::size_t>(options.steps);
  const double step = half / static_cast<double>(n);
  std::vector<double> tail(n + 1);
  for (std::size_t i = 0; i <= n; ++i)
    tail[i] = most * std::max(0.0, 1.0 + negative - mass.inside(step * static_cast<double>(i)));
  Cutoff best;
  best.hausdorff_error = kInfinity;
  // For each fattening the threshold is what is certain inside, and the stop radius the least whose
  // tail stays below it.
  for (std::size_t i = 1; i <= n; ++i) {
    const double x0 = 0.5 * step * static_cast<double>(i);
    if (2.0 * x0 >= best.hausdorff_error) break;
    // A margin for rounding in the sums keeps the promise "never a false no".
    const double threshold = (mass.overlap(x0) - most * negative) * (1.0 - 1e-9);
    if (!(threshold > 0.0)) continue;
    const auto first = std::find_if(tail.begin(), tail.end(),
                                    [&](double t) { return t < threshold * (1.0 - 1e-6); });
    if (first == tail.end()) continue;
    const double x1 = step * static_cast<double>(first - tail.begin());
    if (2.0 * x0 + x1 < best.hausdorff_error) best = {threshold, x0, x1, 2.0 * x0 + x1};
  }
  if (!(best.hausdorff_error < kInfinity))
    throw InputError(
        "estimate_cutoff: no threshold separates inside from outside; the kernel's "
        "negative part weighs " +
        std::to_string(negative) + " of its whole: lift or square it, or take more modes");
  return best;
}

Instrument best_instrument(int degree, double period, const CutoffOptions& options) {
  if (degree < 2)
    throw InputError("best_instrument: degree must be >= 2, got " + std::to_string(degree));
  Instrument best;
  best.cutoff.hausdorff_error = kInfinity;
  const auto consider = [&](const InstrumentKernel& kernel) {
    try {
      const Cutoff cutoff = estimate_cutoff(kernel, options);
      if (cutoff.hausdorff_error < best.cutoff.hausdorff_error) best = {kernel, cutoff};
    } catch (const InputError&) {
      // This kernel separates nothing at this degree; another may.
    }
  };
  for (const auto window :
       {InstrumentWindow::kFejer, InstrumentWindow::kHann, InstrumentWindow::kBlackman})
    consider(lifted_to_nonnegative(window_kernel(window, degree, period)));
  // Stop bands from 0.6 to 4 times the width of one mode's main lobe, L / n.
  for (double lobes = 0.6; lobes <= 4.01; lobes += 0.2) {
    const double stop = lobes * period / degree;
    if (stop < 0.45 * period)
      consider(lifted_to_nonnegative(parks_mcclellan_kernel(degree, period, 0.0, stop)));
    const int half = degree / 2;
    const double half_stop = lobes * period / (2.0 * half);
    if (half >= 1 && half_stop < 0.45 * period)
      consider(squared(parks_mcclellan_kernel(half, period, 0.0, half_stop)));
  }
  if (!(best.cutoff.hausdorff_error < kInfinity))
    throw InputError("best_instrument: " + std::to_string(degree) +
                     " modes separate nothing; take more");
  return best;
}

}  // namespace mortise
