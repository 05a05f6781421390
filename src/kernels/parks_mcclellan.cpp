// SPDX-License-Identifier: GPL-3.0-or-later
// The Remez exchange for equiripple instrument kernels.
//
// With c = cos(2 pi x / L) an even trigonometric polynomial of degree n is a polynomial of degree n
// in c on [-1, 1]; the best one deviates from the wanted values with equal size and alternating
// sign at n + 2 points (Parks and McClellan, IEEE Trans. Circuit Theory 19 (1972) 189-194). Each
// round interpolates at the points of the last one and moves them to the error's extrema.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "mortise/core/errors.hpp"
#include "mortise/kernels/instrument.hpp"

namespace mortise {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kGridPerMode = 24;
constexpr int kMostRounds = 200;

struct Sample {
  double c;       // cos of the angle
  double wanted;  // 1 in the pass band, 0 in the stop band
  double weight;
  bool edge;  // first or last of its band
};

void add_band(std::vector<Sample>& grid, double from, double to, double wanted, double weight,
              int degree) {
  const int n = std::max(2, static_cast<int>(std::ceil(kGridPerMode * degree * (to - from) / kPi)));
  for (int i = 0; i <= n; ++i)
    grid.push_back({std::cos(from + (to - from) * i / n), wanted, weight, i == 0 || i == n});
}

// The polynomial through n + 1 of the reference points, in barycentric form.
class Interpolant {
 public:
  Interpolant(const std::vector<Sample>& grid, const std::vector<std::size_t>& reference) {
    const std::size_t m = reference.size();  // n + 2
    // Weights of the divided difference of order n + 1. Products of differences of cosines shrink
    // as 2^-m: times 2 keeps them near 1.
    std::vector<double> b(m, 1.0);
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t j = 0; j < m; ++j)
        if (j != i) b[i] /= 2.0 * (grid[reference[i]].c - grid[reference[j]].c);
    double top = 0.0;
    double bottom = 0.0;
    double sign = 1.0;
    for (std::size_t i = 0; i < m; ++i, sign = -sign) {
      top += b[i] * grid[reference[i]].wanted;
      bottom += b[i] * sign / grid[reference[i]].weight;
    }
    deviation_ = top / bottom;
    sign = 1.0;
    for (std::size_t i = 0; i + 1 < m; ++i, sign = -sign) {
      const Sample& s = grid[reference[i]];
      c_.push_back(s.c);
      value_.push_back(s.wanted - sign * deviation_ / s.weight);
      // Leaving out the last point multiplies each weight by its difference to it.
      weight_.push_back(b[i] * 2.0 * (s.c - grid[reference[m - 1]].c));
    }
  }

  double operator()(double c) const {
    double top = 0.0;
    double bottom = 0.0;
    for (std::size_t i = 0; i < c_.size(); ++i) {
      const double gap = c - c_[i];
      if (gap == 0.0) return value_[i];
      top += weight_[i] * value_[i] / gap;
      bottom += weight_[i] / gap;
    }
    return top / bottom;
  }

  [[nodiscard]] double deviation() const { return std::abs(deviation_); }

 private:
  std::vector<double> c_, value_, weight_;
  double deviation_ = 0.0;
};

// Local extrema of the error with alternating sign, the largest of each run.
std::vector<std::size_t> alternating_extrema(const std::vector<Sample>& grid,
                                             const std::vector<double>& error) {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const double e = std::abs(error[i]);
    const bool same_band_before = i > 0 && grid[i - 1].wanted == grid[i].wanted;
    const bool same_band_after = i + 1 < grid.size() && grid[i + 1].wanted == grid[i].wanted;
    const double s = error[i] < 0.0 ? -1.0 : 1.0;
    if (same_band_before && s * error[i - 1] > e) continue;
    if (same_band_after && s * error[i + 1] >= e) continue;
    if (!result.empty() && (error[result.back()] < 0.0) == (error[i] < 0.0)) {
      if (std::abs(error[result.back()]) < e) result.back() = i;
    } else {
      result.push_back(i);
    }
  }
  return result;
}

}  // namespace

InstrumentKernel parks_mcclellan_kernel(int degree, double period, double pass, double stop,
                                        double stop_weight) {
  if (degree < 1)
    throw InputError("parks_mcclellan_kernel: degree must be >= 1, got " + std::to_string(degree));
  if (!(period > 0.0))
    throw InputError("parks_mcclellan_kernel: period must be > 0, got " + std::to_string(period));
  if (!(pass >= 0.0 && pass < stop && stop < 0.5 * period))
    throw InputError("parks_mcclellan_kernel: expected 0 <= pass < stop < period / 2, got pass " +
                     std::to_string(pass) + " and stop " + std::to_string(stop));
  if (!(stop_weight > 0.0 && std::isfinite(stop_weight)))
    throw InputError("parks_mcclellan_kernel: stop_weight must be > 0, got " +
                     std::to_string(stop_weight));
  std::vector<Sample> grid;
  if (pass > 0.0)
    add_band(grid, 0.0, 2.0 * kPi * pass / period, 1.0, 1.0, degree);
  else
    grid.push_back({1.0, 1.0, 1.0, true});  // the pass band is the point x = 0
  add_band(grid, 2.0 * kPi * stop / period, kPi, 0.0, stop_weight, degree);

  const std::size_t points = static_cast<std::size_t>(degree) + 2;
  if (grid.size() < points)
    throw InputError("parks_mcclellan_kernel: the bands are too narrow for degree " +
                     std::to_string(degree));
  std::vector<std::size_t> reference(points);
  for (std::size_t i = 0; i < points; ++i) reference[i] = i * (grid.size() - 1) / (points - 1);

  bool converged = false;
  for (int round = 0; round < kMostRounds && !converged; ++round) {
    const Interpolant polynomial(grid, reference);
    std::vector<double> error(grid.size());
    double largest = 0.0;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      error[i] = grid[i].weight * (grid[i].wanted - polynomial(grid[i].c));
      largest = std::max(largest, std::abs(error[i]));
    }
    converged = largest <= polynomial.deviation() * (1.0 + 1e-7) + 1e-15;
    std::vector<std::size_t> extrema = alternating_extrema(grid, error);
    if (converged || extrema.size() < points) break;
    while (extrema.size() > points)  // the smaller end goes: signs go on alternating
      std::abs(error[extrema.front()]) < std::abs(error[extrema.back()])
          ? static_cast<void>(extrema.erase(extrema.begin()))
          : extrema.pop_back();
    reference = std::move(extrema);
  }
  if (!converged)
    throw InputError("parks_mcclellan_kernel: no convergence for degree " + std::to_string(degree) +
                     ", pass " + std::to_string(pass) + ", stop " + std::to_string(stop));

  // Cosine coefficients of a polynomial of degree n from n + 1 samples at the angles pi i / n.
  const Interpolant polynomial(grid, reference);
  Eigen::VectorXd samples(degree + 1);
  for (int i = 0; i <= degree; ++i) samples[i] = polynomial(std::cos(kPi * i / degree));
  InstrumentKernel result{period, Eigen::VectorXd::Zero(degree + 1)};
  for (int j = 0; j <= degree; ++j) {
    double sum = 0.5 * (samples[0] + (j % 2 == 0 ? 1.0 : -1.0) * samples[degree]);
    for (int i = 1; i < degree; ++i) sum += samples[i] * std::cos(kPi * i * j / degree);
    result.coefficients[j] = sum * (j == 0 || j == degree ? 1.0 : 2.0) / degree;
  }
  // From a_j of sum a_j cos to c_j of c_0 + 2 sum c_j cos.
  result.coefficients.tail(degree) *= 0.5;
  if (!(result.coefficients[0] > 0.0))
    throw InputError("parks_mcclellan_kernel: the kernel's integral is not positive");
  result.coefficients /= result.coefficients[0];
  return result;
}

}  // namespace mortise
