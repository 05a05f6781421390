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
#include <limits>

namespace mortise::detail {
namespace {

// scale basis T basis^T, with `diagonal` on and `beside` next to the diagonal of T; no entry is
// larger than 1 by much, without which Eigen's iteration does not know where to stop.
struct Tridiagonal {
  double scale = 1.0;
  Eigen::Vector4d diagonal;
  Eigen::Vector3d beside;
  Eigen::Matrix4d basis;
};

// By two reflections. Eigen's solver does that itself, by code for matrices of any size that takes
// a compiler seven seconds.
Tridiagonal tridiagonal(Eigen::Matrix4d a) {
  Tridiagonal out;
  const double largest = a.cwiseAbs().maxCoeff();
  if (largest > 0.0) out.scale = largest;
  a /= out.scale;
  out.basis.setIdentity();
  for (int k = 0; k < 2; ++k) {
    // The mirror that turns what stands below the diagonal of column k to axis k + 1.
    Eigen::Vector4d v = a.col(k);
    v.head(k + 1).setZero();
    const double length = v.norm();
    v[k + 1] += std::copysign(length, v[k + 1]);
    const double square = v.squaredNorm();
    if (!(square > std::numeric_limits<double>::min())) continue;
    const Eigen::Vector4d w = 2.0 / square * v;
    a -= w * (v.transpose() * a);
    a -= (a * v) * w.transpose();
    out.basis -= (out.basis * v) * w.transpose();
  }
  out.diagonal = a.diagonal();
  out.beside = a.diagonal<1>();
  return out;
}

}  // namespace

PairedMoments paired_moments(const Eigen::Matrix3Xd& model, const Eigen::Matrix3Xd& reference) {
  PairedMoments out;
  if (model.cols() == 0) return out;
  out.count = static_cast<double>(model.cols());
  out.model_mean = model.rowwise().mean();
  out.reference_mean = reference.rowwise().mean();
  const Eigen::Matrix3Xd m = model.colwise() - out.model_mean;
  const Eigen::Matrix3Xd r = reference.colwise() - out.reference_mean;
  out.cross = m.lazyProduct(r.transpose());
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
  const Tridiagonal horn = tridiagonal(horn_matrix(moments.cross));
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver;
  solver.computeFromTridiagonal(horn.diagonal, horn.beside, Eigen::EigenvaluesOnly);
  const double residual =
      moments.model_spread + moments.reference_spread - 2.0 * horn.scale * solver.eigenvalues()(3);
  return std::sqrt(std::max(0.0, residual / moments.count));
}

Eigen::Quaterniond best_rotation(const PairedMoments& moments) {
  const Tridiagonal horn = tridiagonal(horn_matrix(moments.cross));
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver;
  solver.computeFromTridiagonal(horn.diagonal, horn.beside, Eigen::ComputeEigenvectors);
  const Eigen::Vector4d q = horn.basis * solver.eigenvectors().col(3);
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
