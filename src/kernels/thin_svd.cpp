// SPDX-License-Identifier: GPL-3.0-or-later
// Pivoted QR takes the numerical rank, Jacobi's rotations work on what is left: as exact as Jacobi
// on the whole, and fast where the rank is low. Eigen's divide and conquer (BDCSVD) would be the
// library's longest compilation by far.
#include "kernels/thin_svd.hpp"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>

namespace mortise {

ThinSvd thin_svd(const Eigen::MatrixXd& m) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(m);
  qr.setThreshold(1e-16);
  const Eigen::Index rank = std::max<Eigen::Index>(qr.rank(), 1);
  // m = Q R P^T, and of R^T = U S V^T follows m = (Q V) S (P U)^T.
  const Eigen::MatrixXd upper = qr.matrixR().topRows(rank).triangularView<Eigen::Upper>();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(upper.transpose(),
                                              Eigen::ComputeThinU | Eigen::ComputeThinV);
  ThinSvd result;
  result.sigma = svd.singularValues();
  result.v = qr.colsPermutation() * svd.matrixU();
  result.u = Eigen::MatrixXd::Zero(m.rows(), rank);
  result.u.topRows(rank) = svd.matrixV();
  result.u.applyOnTheLeft(qr.householderQ());
  return result;
}

}  // namespace mortise
