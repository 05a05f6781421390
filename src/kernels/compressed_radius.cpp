// SPDX-License-Identifier: GPL-3.0-or-later
// Singular value decomposition of Psi(k r) on Gauss nodes; derivation in docs/math.md.
#include "mortise/kernels/compressed_radius.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <string>

#include "kernels/quadrature.hpp"
#include "mortise/core/errors.hpp"

namespace mortise {

Eigen::VectorXd CompressedRadius::frequency_factors(double k) const {
  Eigen::VectorXd row(radii_.size());
  for (Eigen::Index j = 0; j < row.size(); ++j)
    row[j] = kernel_.transform(k, radii_[j]) / (radii_[j] * radii_[j] * radii_[j]);
  return low_pass_(k) * (from_radius_.transpose() * row);
}

Eigen::VectorXd CompressedRadius::radius_factors(double r) const {
  Eigen::VectorXd column(frequencies_.size());
  for (Eigen::Index i = 0; i < column.size(); ++i)
    column[i] = low_pass_(frequencies_[i]) * kernel_.transform(frequencies_[i], r);
  return from_frequency_.transpose() * column;
}

CompressedRadius compress_radius(const RadialKernel& kernel, double k_max, double r_min,
                                 double r_max, const CompressRadiusOptions& options) {
  if (!(k_max > 0.0 && std::isfinite(k_max)))
    throw InputError("compress_radius: k_max must be > 0 and finite, got " + std::to_string(k_max));
  if (!(r_min > 0.0 && r_min <= r_max && std::isfinite(r_max)))
    throw InputError("compress_radius: expected 0 < r_min <= r_max, got " + std::to_string(r_min) +
                     " and " + std::to_string(r_max));
  if (!(options.tolerance >= 1e-12 && options.tolerance <= 0.1))
    throw InputError("compress_radius: tolerance must be in [1e-12, 0.1], got " +
                     std::to_string(options.tolerance));
  const double last = std::min(k_max, options.low_pass.cutoff);
  // Psi(k r) turns 2 k r times: enough nodes to resolve that and a margin.
  const int k_count = 24 + static_cast<int>(std::ceil(6.0 * last * r_max));
  const int r_count = 16 + static_cast<int>(std::ceil(6.0 * last * (r_max - r_min)));
  const QuadratureRule in_k = gauss_legendre(k_count, 0.0, last),
                       in_r = gauss_legendre(r_count, r_min, r_max);

  CompressedRadius result(kernel, options.low_pass);
  result.frequencies_ = in_k.nodes;
  result.radii_ = in_r.nodes;
  Eigen::MatrixXd table(k_count, r_count);  // low_pass(k) Psi(k r)
  for (int i = 0; i < k_count; ++i)
    for (int j = 0; j < r_count; ++j)
      table(i, j) = options.low_pass(in_k.nodes[i]) *
                    kernel.transform(in_k.nodes[i], in_r.nodes[j]) / std::pow(in_r.nodes[j], 3);
  const Eigen::VectorXd root_k = in_k.weights.cwiseSqrt(), root_r = in_r.weights.cwiseSqrt();
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(root_k.asDiagonal() * table * root_r.asDiagonal(),
                                           Eigen::ComputeThinU | Eigen::ComputeThinV);

  // Errors are looked at between and beyond the nodes, ends included.
  const int fine_k = 2 * k_count + 1, fine_r = r_min == r_max ? 1 : 2 * r_count + 1;
  const double volume = kernel.volume(1.0);
  for (int terms = 1; terms <= std::min(k_count, r_count); ++terms) {
    const Eigen::ArrayXd sigma = svd.singularValues().head(terms);
    if (terms > 1 && sigma[terms - 1] < 1e-14 * sigma[0]) break;  // nothing left but rounding
    result.from_radius_ = root_r.asDiagonal() * svd.matrixV().leftCols(terms);
    result.from_frequency_ =
        root_k.asDiagonal() * svd.matrixU().leftCols(terms) * sigma.inverse().matrix().asDiagonal();
    Eigen::MatrixXd a(terms, fine_k);
    for (int i = 0; i < fine_k; ++i) a.col(i) = result.frequency_factors(k_max * i / (fine_k - 1));
    double worst = 0.0;
    for (int j = 0; j < fine_r; ++j) {
      const double r = fine_r == 1 ? r_min : r_min + (r_max - r_min) * j / (fine_r - 1);
      const Eigen::VectorXd b = result.radius_factors(r);
      for (int i = 0; i < fine_k; ++i) {
        const double k = k_max * i / (fine_k - 1);
        const double error = options.low_pass(k) * kernel.transform(k, r) - a.col(i).dot(b);
        worst = std::max(worst, std::abs(error) / (r * r * r * volume));
      }
    }
    result.measured_error_ = worst;
    if (worst <= options.tolerance) break;
  }
  return result;
}

}  // namespace mortise
