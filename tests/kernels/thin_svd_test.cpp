// SPDX-License-Identifier: GPL-3.0-or-later
// The decomposition of matrices with known singular values.
#include "kernels/thin_svd.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

MatrixXd orthogonal(Index n) {
  return Eigen::HouseholderQR<MatrixXd>(MatrixXd::Random(n, n)).householderQ();
}

TEST(ThinSvd, FindsTheSingularValuesItWasBuiltFrom) {
  std::srand(1);
  for (const auto& [rows, columns] :
       {std::pair<Index, Index>{40, 17}, {17, 40}, {9, 9}, {5, 1}, {1, 5}}) {
    const Index n = std::min(rows, columns);
    Eigen::VectorXd sigma(n);
    for (Index i = 0; i < n; ++i) sigma[i] = 3.0 * std::pow(10.0, -1.5 * static_cast<double>(i));
    const MatrixXd m = orthogonal(rows).leftCols(n) * sigma.asDiagonal() *
                       orthogonal(columns).leftCols(n).transpose();
    const mortise::ThinSvd svd = mortise::thin_svd(m);
    const Index rank = svd.sigma.size();
    const double rounding = 1e-14 * sigma[0];  // some tens of operations a value
    ASSERT_LE(rank, n);
    EXPECT_GE(rank, std::min<Index>(n, 10));  // 1e-15 of the largest is the eleventh
    EXPECT_LT((svd.sigma - sigma.head(rank)).cwiseAbs().maxCoeff(), rounding);
    EXPECT_LT((svd.u * svd.sigma.asDiagonal() * svd.v.transpose() - m).cwiseAbs().maxCoeff(),
              rounding);
    EXPECT_LT((svd.u.transpose() * svd.u - MatrixXd::Identity(rank, rank)).norm(), 1e-13);
    EXPECT_LT((svd.v.transpose() * svd.v - MatrixXd::Identity(rank, rank)).norm(), 1e-13);
  }
}

TEST(ThinSvd, OfNothingIsOneZero) {
  const mortise::ThinSvd svd = mortise::thin_svd(MatrixXd::Zero(4, 3));
  ASSERT_EQ(svd.sigma.size(), 1);
  EXPECT_EQ(svd.sigma[0], 0.0);
}

}  // namespace
