// SPDX-License-Identifier: GPL-3.0-or-later
// Moments of paired points under rigid motions.
//
// With S = sum m~ r~^T and n pairs, for a model moved by x -> R x + t:
//   sum |R m + t - r|^2 = sum |m~|^2 + sum |r~|^2 - 2 tr(R S) + n |R mean m + t - mean r|^2,
// because the mixed terms vanish with the means and sum (R m~).r~ = tr(R S). A superposition moves
// the means onto each other and takes the R that makes tr(R S) largest. Differences of large sums
// cost digits: with spreads of 10^6 A^2 and double precision the mean square is good to 1e-10 A^2,
// so an RMSD of zero comes out below 1e-5 A.
#include "core/paired_moments.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace mortise::detail {

PairedMoments paired_moments(const Eigen::Matrix3Xd& model, const Eigen::Matrix3Xd& reference) {
  PairedMoments out;
  if (model.cols() == 0) return out;
  out.count = static_cast<double>(model.cols());
  out.model_mean = model.rowwise().mean();
  out.reference_mean = reference.rowwise().mean();
  const Eigen::Matrix3Xd m = model.colwise() - out.model_mean;
  const Eigen::Matrix3Xd r = reference.colwise() - out.reference_mean;
  out.cross = m * r.transpose();
  out.model_spread = m.squaredNorm();
  out.reference_spread = r.squaredNorm();
  return out;
}

PairedMoments merge(const PairedMoments& a, const PairedMoments& b) {
  PairedMoments out;
  out.count = a.count + b.count;
  if (out.count == 0.0) return out;
  const double share = b.count / out.count;
  const Eigen::Vector3d model_step = b.model_mean - a.model_mean;
  const Eigen::Vector3d reference_step = b.reference_mean - a.reference_mean;
  const double reduced = a.count * share;  // as the reduced mass of two bodies
  out.model_mean = a.model_mean + share * model_step;
  out.reference_mean = a.reference_mean + share * reference_step;
  out.cross = a.cross + b.cross + reduced * model_step * reference_step.transpose();
  out.model_spread = a.model_spread + b.model_spread + reduced * model_step.squaredNorm();
  out.reference_spread =
      a.reference_spread + b.reference_spread + reduced * reference_step.squaredNorm();
  return out;
}

PairedMoments moved(const PairedMoments& moments, const Eigen::Matrix3d& R,
                    const Eigen::Vector3d& t) {
  PairedMoments out = moments;
  out.model_mean = R * moments.model_mean + t;
  out.cross = R * moments.cross;
  return out;
}

double rmsd_in_place(const PairedMoments& moments) {
  const double spread =
      moments.model_spread + moments.reference_spread - 2.0 * moments.cross.trace();
  const double step = (moments.model_mean - moments.reference_mean).squaredNorm();
  return std::sqrt(std::max(0.0, spread / moments.count) + step);
}

double rmsd_superposed(const PairedMoments& moments) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(horn_matrix(moments.cross),
                                                              Eigen::EigenvaluesOnly);
  const double residual =
      moments.model_spread + moments.reference_spread - 2.0 * solver.eigenvalues()(3);
  return std::sqrt(std::max(0.0, residual / moments.count));
}

Eigen::Quaterniond best_rotation(const PairedMoments& moments) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(horn_matrix(moments.cross));
  const Eigen::Vector4d q = solver.eigenvectors().col(3);
  return {q(0), q(1), q(2), q(3)};
}

Eigen::Matrix4d horn_matrix(const Eigen::Matrix3d& cross) {
  const Eigen::Matrix3d& s = cross;
  Eigen::Matrix4d n;
  n(0, 0) = s(0, 0) + s(1, 1) + s(2, 2);
  n(1, 1) = s(0, 0) - s(1, 1) - s(2, 2);
  n(2, 2) = -s(0, 0) + s(1, 1) - s(2, 2);
  n(3, 3) = -s(0, 0) - s(1, 1) + s(2, 2);
  n(0, 1) = n(1, 0) = s(1, 2) - s(2, 1);
  n(0, 2) = n(2, 0) = s(2, 0) - s(0, 2);
  n(0, 3) = n(3, 0) = s(0, 1) - s(1, 0);
  n(1, 2) = n(2, 1) = s(0, 1) + s(1, 0);
  n(1, 3) = n(3, 1) = s(2, 0) + s(0, 2);
  n(2, 3) = n(3, 2) = s(1, 2) + s(2, 1);
  return n;
}

}  // namespace mortise::detail
