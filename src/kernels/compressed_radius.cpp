// SPDX-License-Identifier: GPL-3.0-or-later
// Singular value decomposition of phi(k, r + o) on nodes; derivation in docs/math.md.
#include "mortise/kernels/compressed_radius.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/quadrature.hpp"
#include "kernels/thin_svd.hpp"
#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

void check(double k_max, double r_min, double r_max, const CompressRadiusOptions& options) {
  const auto refuse = [](const std::string& what) { throw InputError("compress_radius: " + what); };
  if (!(k_max > 0.0 && std::isfinite(k_max)))
    refuse("k_max must be > 0 and finite, got " + std::to_string(k_max));
  if (!(r_min > 0.0 && r_min <= r_max && std::isfinite(r_max)))
    refuse("expected 0 < r_min <= r_max, got " + std::to_string(r_min) + " and " +
           std::to_string(r_max));
  if (!(options.tolerance >= 1e-12 && options.tolerance <= 0.1))
    refuse("tolerance must be in [1e-12, 0.1], got " + std::to_string(options.tolerance));
  if (options.offsets.empty()) refuse("expected at least one offset, got none");
  for (const double o : options.offsets)
    if (!(r_min + o > 0.0) || !std::isfinite(o))
      refuse("every radius plus offset must be > 0 and finite, got " + std::to_string(r_min) +
             " and offset " + std::to_string(o));
}

// phi turns about 2 k r times; transforms with a skin more often. Nodes to resolve that and a
// margin; where they are too few, the measured error tells, and they are doubled.
int node_count(int least, double k, double length) {
  return least + static_cast<int>(std::ceil(6.0 * k * length));
}

constexpr int kDoublings = 3;

}  // namespace

Eigen::VectorXd CompressedRadius::frequency_factors(double k, std::size_t offset) const {
  Eigen::VectorXd row(static_cast<Eigen::Index>(radii_.size()));
  for (Eigen::Index j = 0; j < row.size(); ++j)
    row[j] = transform_(k, radii_[j] + offsets_.at(offset));
  return from_radii_.transpose() * row;
}

Eigen::VectorXd CompressedRadius::radius_factors(double r) const {
  if (!(low_ < high_)) {
    const auto at = std::lower_bound(radii_.begin(), radii_.end(), r);
    if (at == radii_.end() || *at != r)
      throw InputError("CompressedRadius: " + std::to_string(r) + " is not one of the radii");
    return at_radii_.row(at - radii_.begin());
  }
  const double slack = 1e-9 * high_;
  if (!(r >= low_ - slack && r <= high_ + slack))
    throw InputError("CompressedRadius: radius " + std::to_string(r) + " is not within " +
                     std::to_string(low_) + " to " + std::to_string(high_));
  const Eigen::Index count = frequencies_.size();
  Eigen::VectorXd column(count * static_cast<Eigen::Index>(offsets_.size()));
  for (Eigen::Index i = 0; i < column.size(); ++i) {
    const double k = frequencies_[i % count];
    column[i] = low_pass_(k) * transform_(k, r + offsets_[i / count]);
  }
  return from_frequency_.transpose() * column;
}

void CompressedRadius::fit(int k_count, double k_max, double tolerance,
                           const Eigen::VectorXd& radius_weights) {
  const double last = std::min(k_max, low_pass_.cutoff);
  const QuadratureRule in_k = gauss_legendre(k_count, 0.0, last);
  frequencies_ = in_k.nodes;
  const auto offsets = static_cast<Eigen::Index>(offsets_.size());
  const auto count = static_cast<Eigen::Index>(radii_.size());
  const bool interval = low_ < high_;

  // Errors are looked at between and beyond the nodes, ends included; of a set at its radii.
  const Eigen::Index fine_k = 2 * k_count + 1, fine_r = interval ? 2 * count + 1 : count;
  const auto fine_radius = [&](Eigen::Index j) {
    return interval
               ? low_ + (high_ - low_) * static_cast<double>(j) / static_cast<double>(fine_r - 1)
               : radii_[j];
  };
  const auto table = [&](Eigen::Index rows, const auto& frequency, Eigen::Index columns,
                         const auto& radius) {
    Eigen::MatrixXd values(offsets * rows, columns);
    for (Eigen::Index o = 0; o < offsets; ++o)
      for (Eigen::Index i = 0; i < rows; ++i)
        for (Eigen::Index j = 0; j < columns; ++j)
          values(o * rows + i, j) =
              low_pass_(frequency(i)) * transform_(frequency(i), radius(j) + offsets_[o]);
    return values;
  };
  const auto node = [&](Eigen::Index i) { return frequencies_[i]; };
  const auto fine = [&](Eigen::Index i) {
    return last * static_cast<double>(i) / static_cast<double>(fine_k - 1);
  };
  const auto radius = [&](Eigen::Index j) { return radii_[j]; };
  const Eigen::MatrixXd fitted = table(k_count, node, count, radius);
  Eigen::MatrixXd rest = table(fine_k, fine, fine_r, fine_radius);  // less the terms found so far

  // Relative to each radius' and offset's largest value; where that is 0 nothing is asked for.
  Eigen::MatrixXd scale(offsets, fine_r);
  for (Eigen::Index o = 0; o < offsets; ++o)
    scale.row(o) = rest.middleRows(o * fine_k, fine_k).cwiseAbs().colwise().maxCoeff();
  const auto worst = [&] {
    double error = 0.0;
    for (Eigen::Index o = 0; o < offsets; ++o)
      for (Eigen::Index j = 0; j < fine_r; ++j)
        if (scale(o, j) > 0.0)
          error = std::max(
              error, rest.col(j).segment(o * fine_k, fine_k).cwiseAbs().maxCoeff() / scale(o, j));
    return error;
  };

  // Columns are weighed by about one over their size, rows of an offset by one over what is left of
  // theirs then.
  Eigen::VectorXd by_radius(count), by_frequency(offsets * k_count);
  for (Eigen::Index j = 0; j < count; ++j) {
    double size = 1.0;
    for (Eigen::Index o = 0; o < offsets; ++o)
      size *= fitted.col(j).segment(o * k_count, k_count).cwiseAbs().maxCoeff();
    size = std::pow(size, 1.0 / static_cast<double>(offsets));
    by_radius[j] = std::sqrt(radius_weights[j]) / (size > 0.0 ? size : 1.0);
  }
  for (Eigen::Index o = 0; o < offsets; ++o) {
    const double size = (fitted.middleRows(o * k_count, k_count) * by_radius.asDiagonal()).norm();
    by_frequency.segment(o * k_count, k_count) =
        in_k.weights.cwiseSqrt() / (size > 0.0 ? size : 1.0);
  }
  const auto [u, sigma, v] = thin_svd(by_frequency.asDiagonal() * fitted * by_radius.asDiagonal());

  from_radii_ = by_radius.asDiagonal() * v;
  at_radii_ = by_radius.cwiseInverse().asDiagonal() * v;
  from_frequency_ = by_frequency.asDiagonal() * u *
                    sigma.unaryExpr([](double s) { return s > 0.0 ? 1.0 / s : 0.0; }).asDiagonal();
  // Values of all a_q and b_q on the fine grid.
  const Eigen::MatrixXd a = table(fine_k, fine, count, radius) * from_radii_;
  const Eigen::MatrixXd b =
      interval
          ? Eigen::MatrixXd(table(k_count, node, fine_r, fine_radius).transpose() * from_frequency_)
          : at_radii_;
  Eigen::Index terms = 0;
  while (terms < sigma.size()) {
    if (terms > 0 && sigma[terms] < 1e-14 * sigma[0]) break;  // nothing left but rounding
    rest.noalias() -= a.col(terms) * b.col(terms).transpose();
    ++terms;
    measured_error_ = worst();
    if (measured_error_ <= tolerance) break;
  }
  from_radii_ = from_radii_.leftCols(terms).eval();
  at_radii_ = at_radii_.leftCols(terms).eval();
  from_frequency_ = from_frequency_.leftCols(terms).eval();
}

CompressedRadius compress_radius(const RadialTransform& transform, double k_max,
                                 const std::vector<double>& radii,
                                 const CompressRadiusOptions& options) {
  if (radii.empty()) throw InputError("compress_radius: expected at least one radius, got none");
  CompressedRadius result(transform, options);
  result.radii_ = radii;
  std::sort(result.radii_.begin(), result.radii_.end());
  result.radii_.erase(std::unique(result.radii_.begin(), result.radii_.end()), result.radii_.end());
  const double r_min = result.radii_.front(), r_max = result.radii_.back();
  check(k_max, r_min, r_max, options);
  const auto count = static_cast<Eigen::Index>(result.radii_.size());
  if (count == 1) {  // a(k) = phi(k, r + o), b = 1: exact, and no rounding
    result.from_radii_ = result.at_radii_ = Eigen::MatrixXd::Ones(1, 1);
    return result;
  }
  const double last = std::min(k_max, options.low_pass.cutoff);
  if (count > node_count(16, last, r_max - r_min))
    return compress_radius(transform, k_max, r_min, r_max, options);
  const double reach = r_max + *std::max_element(options.offsets.begin(), options.offsets.end());
  for (int doubling = 0; doubling <= kDoublings; ++doubling) {
    result.fit(node_count(24, last, reach) << doubling, k_max, options.tolerance,
               Eigen::VectorXd::Ones(count));
    if (result.measured_error_ <= options.tolerance) break;
  }
  return result;
}

CompressedRadius compress_radius(const RadialTransform& transform, double k_max, double r_min,
                                 double r_max, const CompressRadiusOptions& options) {
  check(k_max, r_min, r_max, options);
  if (r_min == r_max) return compress_radius(transform, k_max, std::vector<double>{r_min}, options);
  CompressedRadius result(transform, options);
  result.low_ = r_min;
  result.high_ = r_max;
  const double last = std::min(k_max, options.low_pass.cutoff);
  const double reach = r_max + *std::max_element(options.offsets.begin(), options.offsets.end());
  for (int doubling = 0; doubling <= kDoublings; ++doubling) {
    const QuadratureRule in_r =
        gauss_legendre(node_count(16, last, r_max - r_min) << doubling, r_min, r_max);
    result.radii_.assign(in_r.nodes.begin(), in_r.nodes.end());
    result.fit(node_count(24, last, reach) << doubling, k_max, options.tolerance, in_r.weights);
    if (result.measured_error_ <= options.tolerance) break;
  }
  return result;
}

}  // namespace mortise
