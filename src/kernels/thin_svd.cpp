// SPDX-License-Identifier: GPL-3.0-or-later
// Pivoted QR takes the numerical rank, a second one makes what is left square and graded, Jacobi's
// rotations work on that: as exact as Jacobi on the whole, and fast where the rank is low. Eigen's
// divide and conquer (BDCSVD) would be the library's longest compilation by far, and its Jacobi
// with QR of its own the next.
#include "kernels/thin_svd.hpp"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>

namespace mortise {

ThinSvd thin_svd(const Eigen::MatrixXd& m) {
  using Qr = Eigen::ColPivHouseholderQR<Eigen::MatrixXd>;
  Qr qr(m);
  qr.setThreshold(1e-16);
  const Eigen::Index rank = std::max<Eigen::Index>(qr.rank(), 1);
  // m P = Q R, R^T P' = Q' R' with R' square, and of R' = U S V^T follows
  // m = (Q P' V) S (P Q' U)^T.
  const Eigen::MatrixXd upper = qr.matrixR().topRows(rank).triangularView<Eigen::Upper>();
  const Qr again(upper.transpose());
  const Eigen::MatrixXd square = again.matrixR().topRows(rank).triangularView<Eigen::Upper>();
  const Eigen::JacobiSVD<Eigen::MatrixXd, Eigen::NoQRPreconditioner> svd(
      square, Eigen::ComputeFullU | Eigen::ComputeFullV);
  ThinSvd result;
  result.sigma = svd.singularValues();
  result.u = Eigen::MatrixXd::Zero(m.rows(), rank);
  result.u.topRows(rank) = again.colsPermutation() * svd.matrixV();
  result.u.applyOnTheLeft(qr.householderQ());
  result.v = Eigen::MatrixXd::Zero(m.cols(), rank);
  result.v.topRows(rank) = svd.matrixU();
  result.v.applyOnTheLeft(again.householderQ());
  result.v = qr.colsPermutation() * result.v;
  return result;
}

}  // namespace mortise
