// SPDX-License-Identifier: GPL-3.0-or-later
// The fast direct sums against the plain one.
#include "mortise/fourier/direct_ndft.hpp"

#include <gtest/gtest.h>

#include <random>

#include "mortise/core/errors.hpp"
#include "reference/ndft.hpp"

namespace mortise {
namespace {

template <int D>
void compare(const std::array<int, D>& modes, int count) {
  std::mt19937 random(count);
  std::uniform_real_distribution<double> uniform(-7.0, 7.0);
  Eigen::Matrix<double, D, Eigen::Dynamic> points(D, count);
  Eigen::VectorXcd weights(count);
  for (int i = 0; i < count; ++i) {
    for (int d = 0; d < D; ++d) points(d, i) = uniform(random);
    weights[i] = {uniform(random), uniform(random)};
  }
  std::array<double, D> box;
  for (int d = 0; d < D; ++d) box[d] = 3.0 + d;
  const Eigen::VectorXcd expected = reference::ndft<D>(points, weights, modes, box);
  const Eigen::VectorXcd result = direct_ndft(points, weights, modes, box, 1);
  ASSERT_EQ(result.size(), expected.size());
  EXPECT_LT((result - expected).norm(),
            1e-13 * expected.norm());  // phases up to 100 turns in the plain sum
  EXPECT_EQ(result, direct_ndft(points, weights, modes, box, 3));

  Eigen::MatrixXd frequencies(D, 2);  // the first mode, and zero
  for (int d = 0; d < D; ++d) frequencies(d, 0) = -(modes[d] / 2) / box[d];
  frequencies.col(1).setZero();
  const Eigen::VectorXcd listed = direct_ndft(Eigen::MatrixXd(points), weights, frequencies, 1);
  EXPECT_LT(std::abs(listed[0] - expected[0]), 1e-13 * weights.norm() * count);
  EXPECT_LT(std::abs(listed[1] - weights.sum()), 1e-13 * weights.norm() * count);
}

TEST(DirectNdft, EqualsThePlainSum) {
  for (const int count : {1, 3, 4, 16, 17, 50}) {
    compare<3>({5, 4, 7}, count);
    compare<4>({3, 4, 2, 5}, count);
  }
  compare<3>({1, 1, 1}, 5);
  compare<4>({1, 1, 1, 1}, 5);
}

TEST(DirectNdft, RefusesBadInput) {
  const Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, 2);
  EXPECT_THROW((void)direct_ndft(points, Eigen::VectorXcd::Ones(3), {2, 2, 2}, {1.0, 1.0, 1.0}),
               InputError);
  EXPECT_THROW((void)direct_ndft(points, Eigen::VectorXcd::Ones(2), {2, 0, 2}, {1.0, 1.0, 1.0}),
               InputError);
  EXPECT_THROW((void)direct_ndft(points, Eigen::VectorXcd::Ones(2), {2, 2, 2}, {1.0, 0.0, 1.0}),
               InputError);
}

}  // namespace
}  // namespace mortise
