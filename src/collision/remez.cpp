// SPDX-License-Identifier: GPL-3.0-or-later
// Remez's exchange on a grid, the polynomial in cos(theta) in barycentric form.
#include "collision/remez.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace mortise {
namespace {

using std::numbers::pi;

struct Node {
  double theta, wanted;
};

// Reference points theta_i with the levelled error: p(theta_i) = wanted_i - (-1)^i level.
struct Interpolant {
  std::vector<double> x, weight, value;  // all but the last reference point
  double level = 0.0;

  explicit Interpolant(const std::vector<Node>& reference) {
    const std::size_t count = reference.size();
    std::vector<double> all(count), w(count);
    for (std::size_t i = 0; i < count; ++i) all[i] = std::cos(reference[i].theta);
    // Products of differences, scaled by 2 each (the capacity of [-1, 1] is 1 / 2), neither over-
    // nor underflow up to some hundred points.
    const auto weights = [&](std::size_t n) {
      std::vector<double> result(n, 1.0);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
          if (i != j) result[i] /= 2.0 * (all[i] - all[j]);
      return result;
    };
    w = weights(count);
    double top = 0.0, bottom = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      top += w[i] * reference[i].wanted;
      bottom += (i % 2 == 0 ? w[i] : -w[i]);
    }
    level = top / bottom;
    x.assign(all.begin(), all.end() - 1);
    weight = weights(count - 1);
    for (std::size_t i = 0; i + 1 < count; ++i)
      value.push_back(reference[i].wanted - (i % 2 == 0 ? level : -level));
  }

  [[nodiscard]] double operator()(double theta) const {
    const double at = std::cos(theta);
    double top = 0.0, bottom = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double difference = at - x[i];
      if (std::abs(difference) < 1e-14) return value[i];
      top += weight[i] / difference * value[i];
      bottom += weight[i] / difference;
    }
    return top / bottom;
  }
};

// Local extrema of the error with alternating signs, the largest of each run of equal sign; cut
// down to `count` from the smaller end.
std::vector<std::size_t> alternation(const std::vector<double>& error, std::size_t count) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < error.size(); ++i) {
    const bool left =
        i == 0 || std::abs(error[i]) >= std::abs(error[i - 1]) || error[i] * error[i - 1] < 0.0;
    const bool right = i + 1 == error.size() || std::abs(error[i]) >= std::abs(error[i + 1]) ||
                       error[i] * error[i + 1] < 0.0;
    if (!left || !right) continue;
    if (found.empty() || error[found.back()] * error[i] < 0.0)
      found.push_back(i);
    else if (std::abs(error[i]) > std::abs(error[found.back()]))
      found.back() = i;
  }
  std::size_t first = 0, last = found.size();
  while (last - first > count) {
    if (std::abs(error[found[first]]) < std::abs(error[found[last - 1]]))
      ++first;
    else
      --last;
  }
  return {found.begin() + static_cast<std::ptrdiff_t>(first),
          found.begin() + static_cast<std::ptrdiff_t>(last)};
}

}  // namespace

RemezResult remez(int degree, double pass, double stop) {
  const std::size_t wanted = static_cast<std::size_t>(degree) + 2;
  const int density = 16 * (degree + 2);  // nodes per unit of theta / pi
  std::vector<Node> grid;
  const auto band = [&](double from, double to, double value) {
    const int nodes = std::max(8, static_cast<int>(std::ceil(density * (to - from) / pi)));
    for (int i = 0; i <= nodes; ++i) grid.push_back({from + (to - from) * i / nodes, value});
  };
  band(0.0, pass, 1.0);
  band(stop, pi, 0.0);
  std::vector<Node> reference(wanted);
  for (std::size_t i = 0; i < wanted; ++i)
    reference[i] = grid[i * (grid.size() - 1) / (wanted - 1)];

  RemezResult result;
  result.ripple = 1e300;
  std::vector<Node> best = reference;
  std::vector<double> error(grid.size());
  for (int round = 0; round < 60; ++round) {
    const Interpolant p(reference);
    double largest = 0.0;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      error[i] = grid[i].wanted - p(grid[i].theta);
      largest = std::max(largest, std::abs(error[i]));
    }
    if (largest < result.ripple) {
      result.ripple = largest;
      result.levelled = std::abs(p.level);
      best = reference;
    }
    if (largest < 1.01 * std::abs(p.level)) break;
    const std::vector<std::size_t> next = alternation(error, wanted);
    if (next.size() < wanted) break;  // rounding errors: the level is next to nothing
    for (std::size_t i = 0; i < wanted; ++i) reference[i] = grid[next[i]];
  }
  const Interpolant p(best);
  // Cosine coefficients by sampling at 2 (degree + 1) equal steps: exact for this degree.
  const int samples = 2 * (degree + 1);
  result.cosines = Eigen::VectorXd::Zero(degree + 1);
  for (int s = 0; s < samples; ++s) {
    const double theta = 2.0 * pi * (s + 0.5) / samples, v = p(theta);
    for (int k = 0; k <= degree; ++k)
      result.cosines[k] += (k == 0 ? 1.0 : 2.0) * v * std::cos(k * theta) / samples;
  }
  return result;
}

}  // namespace mortise
