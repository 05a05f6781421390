// SPDX-License-Identifier: GPL-3.0-or-later
// NFFT against the direct sum over tolerances, dimensions, sizes and precisions; edge cases;
// threads.
#include "mortise/fourier/nfft.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>
#include <string>

#include "mortise/core/errors.hpp"
#include "reference/ndft.hpp"

namespace mortise {
namespace {

template <int D>
struct Problem {
  Eigen::Matrix<double, D, Eigen::Dynamic> points;
  Eigen::VectorXcd weights;
  std::array<double, D> box;
};

// Points in three boxes' width around the origin; `spread` < 1 clusters them.
template <int D>
Problem<D> random_problem(int count, unsigned seed, double spread = 1.5) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Problem<D> p;
  for (int d = 0; d < D; ++d) p.box[d] = 3.0 + 1.7 * d;
  p.points.resize(D, count);
  p.weights.resize(count);
  for (int i = 0; i < count; ++i) {
    for (int d = 0; d < D; ++d) p.points(d, i) = spread * p.box[d] * uniform(random);
    p.weights[i] = {uniform(random), uniform(random)};
  }
  return p;
}

// Of the result, in the shape of the plan, against the full direct sum.
template <int D, class Real>
double relative_error(Nfft<D, Real>& plan, const Problem<D>& p, bool real,
                      Eigen::VectorXcd expected = {}) {
  Problem<D> q = p;
  if (real) q.weights.imag().setZero();
  if (expected.size() == 0) expected = reference::ndft<D>(q.points, q.weights, plan.modes(), q.box);
  using Complex = std::complex<Real>;
  const Eigen::VectorX<Complex> complex_weights = q.weights.template cast<Complex>();
  const Eigen::VectorX<Real> real_weights = q.weights.real().template cast<Real>();
  const auto result =
      real ? plan.transform(q.points, real_weights) : plan.transform(q.points, complex_weights);
  const int n = plan.modes()[D - 1], row = plan.shape()[D - 1];
  double difference = 0.0, norm = 0.0, compared = 0.0;
  std::size_t index = 0;
  for (Eigen::Index first = 0; first < expected.size(); first += n)
    for (int k = 0; k < row; ++k, ++index) {
      if (real && 2 * k == n)
        continue;  // +n / 2 is not among the direct sum's modes; tested by itself
      const std::complex<double> value = expected[first + (real ? n / 2 + k : k)];
      difference += std::norm(std::complex<double>(result[index]) - value);
      norm += std::norm(value);
      compared += 1.0;
    }
  EXPECT_EQ(index, result.size());
  // Against what such weights sum to on average where the few modes there are happen to cancel.
  return std::sqrt(difference / std::max(norm, compared * q.weights.squaredNorm()));
}

template <int D, class Real>
void sweep(const std::array<int, D>& modes, std::initializer_list<double> tolerances,
           double least_narrow, double rounding) {
  const Problem<D> p = random_problem<D>(60, 7);
  const Eigen::VectorXcd real_weights = p.weights.real().template cast<std::complex<double>>();
  const Eigen::VectorXcd expected[] = {reference::ndft<D>(p.points, p.weights, modes, p.box),
                                       reference::ndft<D>(p.points, real_weights, modes, p.box)};
  for (const double tolerance : tolerances)
    for (const double upsampling : {0.0, 1.25, 2.0})
      for (const bool real : {false, true}) {
        if (upsampling == 1.25 && tolerance < least_narrow)
          continue;  // its correction magnifies rounding
        NfftOptions options{.tolerance = tolerance, .upsampling = upsampling, .threads = 1};
        if (real) options.weights = WeightKind::kReal;
        Nfft<D, Real> plan(modes, p.box, options);
        // The expected error is a mean over points; for 60 of them it holds within a few per cent
        // of what was left.
        const double error = relative_error(plan, p, real, expected[real]);
        EXPECT_LT(error, tolerance + rounding)
            << "tolerance " << tolerance << " upsampling " << upsampling << " real " << real
            << " width " << plan.kernel().width;
        // Not better than a kernel two cells wider would be: the tolerance is not wasted either.
        if (error > 10.0 * rounding && plan.kernel().width > 2) {
          EXPECT_GT(error, 2e-3 * tolerance);
        }
      }
}

TEST(Nfft, MeetsToleranceIn3dDouble) {
  for (const auto& modes :
       {std::array{12, 9, 16}, std::array{5, 14, 7}, std::array{16, 16, 16}, std::array{31, 6, 20}})
    sweep<3, double>(modes, {1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}, 1e-8, 2e-14);
}

// Single precision loses about 1e-7 per rounding, and its phases (computed in double) nothing.
TEST(Nfft, MeetsToleranceIn3dFloat) {
  for (const auto& modes : {std::array{12, 9, 16}, std::array{5, 14, 7}, std::array{20, 16, 24}})
    sweep<3, float>(modes, {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}, 1e-3, 5e-7);
}

TEST(Nfft, MeetsToleranceIn4dDouble) {
  for (const auto& modes : {std::array{6, 5, 8, 4}, std::array{3, 8, 4, 9}})
    sweep<4, double>(modes, {1e-1, 1e-2, 1e-3, 1e-6, 1e-9, 1e-12}, 1e-8, 2e-14);
}

TEST(Nfft, MeetsToleranceIn4dFloat) {
  for (const auto& modes : {std::array{6, 5, 8, 4}, std::array{3, 8, 4, 9}})
    sweep<4, float>(modes, {1e-1, 1e-2, 1e-3, 1e-6}, 1e-3, 5e-7);
}

TEST(Nfft, MeetsToleranceWithSortedPointsOnALargeGrid) {
  const Problem<3> p = random_problem<3>(40, 3);
  const std::array modes{50, 36, 70};  // 2 x: 100 x 72 x 144 doubles, above the threshold of tiling
  for (const bool real : {false, true}) {
    NfftOptions options{.tolerance = 1e-5, .upsampling = 2.0};
    if (real) options.weights = WeightKind::kReal;
    Nfft3 plan(modes, p.box, options);
    EXPECT_LT(relative_error(plan, p, real), 1e-5);
  }
}

TEST(Nfft, TinyGridsAndOneMode) {
  const Problem<3> p = random_problem<3>(5, 11);
  const Problem<4> p4 = random_problem<4>(5, 12);
  for (const double tolerance : {1e-3, 1e-9}) {
    for (const auto& modes : {std::array{1, 1, 1}, std::array{1, 2, 3}, std::array{2, 1, 1},
                              std::array{1, 1, 2}, std::array{3, 1, 1}}) {
      Nfft3 complex_plan(modes, p.box, {.tolerance = tolerance});
      EXPECT_LT(relative_error(complex_plan, p, false), tolerance)
          << modes[0] << modes[1] << modes[2];
      Nfft3 real_plan(modes, p.box, {.tolerance = tolerance, .weights = WeightKind::kReal});
      EXPECT_LT(relative_error(real_plan, p, true), tolerance) << modes[0] << modes[1] << modes[2];
    }
    Nfft4 plan({2, 1, 3, 1}, p4.box, {.tolerance = tolerance});
    EXPECT_LT(relative_error(plan, p4, false), tolerance);
  }
}

TEST(Nfft, OnePointBordersAndClusters) {
  const std::array modes{10, 11, 12};
  Nfft3 plan(modes, {3.0, 4.7, 6.4}, {.tolerance = 1e-7});
  constexpr double kInStep =
      1.5e-7;  // images and axes in step instead of at random, see docs/math.md
  Problem<3> p = random_problem<3>(1, 5);
  EXPECT_LT(relative_error(plan, p, false), kInStep);
  // On every corner and face of the box, a hair beside it, and many boxes away.
  p = random_problem<3>(27 * 3, 6);
  for (int i = 0; i < 81; ++i)
    for (int d = 0; d < 3; ++d) {
      const int digit = d == 0 ? i % 3 : d == 1 ? i / 3 % 3 : i / 9 % 3;
      p.points(d, i) =
          p.box[d] * (0.5 * digit + (i >= 54 ? 1000.0 : 0.0)) + (i >= 27 && i < 54 ? -1e-17 : 0.0);
    }
  EXPECT_LT(relative_error(plan, p, false), kInStep);
  p = random_problem<3>(200, 8, 1e-3);  // all within one cell
  EXPECT_LT(relative_error(plan, p, false), kInStep);
}

TEST(Nfft, RealHalfSpectrumHoldsThePositiveNyquistMode) {
  Problem<3> p = random_problem<3>(20, 9);
  p.weights.imag().setZero();
  Nfft3 plan({4, 4, 6}, p.box, {.tolerance = 1e-10, .weights = WeightKind::kReal});
  const Eigen::VectorXd weights = p.weights.real();
  const auto result = plan.transform(p.points, weights);
  const Eigen::VectorXcd odd = reference::ndft<3>(p.points, p.weights, {4, 4, 7}, p.box);
  double worst = 0.0;
  for (int row = 0; row < 16; ++row)
    worst = std::max(worst, std::abs(result[row * 4 + 3] - odd[row * 7 + 6]));
  EXPECT_LT(worst, 1e-9 * p.weights.norm());
}

TEST(Nfft, SameBytesForAnyNumberOfThreads) {
  const Problem<3> p = random_problem<3>(5000, 21);
  const Problem<4> p4 = random_problem<4>(3000, 22);
  std::vector<std::complex<float>> first;
  std::vector<std::complex<double>> first4;
  const Eigen::VectorXf weights = p.weights.real().cast<float>();
  for (const int threads : {1, 2, 5}) {
    Nfft3f plan({60, 50, 80}, p.box,
                {.tolerance = 1e-5, .weights = WeightKind::kReal, .threads = threads});
    const auto result = plan.transform(p.points, weights);
    Nfft4 plan4({16, 16, 14, 8}, p4.box, {.tolerance = 1e-6, .threads = threads});
    const auto result4 = plan4.transform(p4.points, p4.weights);
    if (threads == 1) {
      first.assign(result.begin(), result.end());
      first4.assign(result4.begin(), result4.end());
    }
    EXPECT_EQ(std::memcmp(first.data(), result.data(), result.size_bytes()), 0) << threads;
    EXPECT_EQ(std::memcmp(first4.data(), result4.data(), result4.size_bytes()), 0) << threads;
  }
}

TEST(Nfft, PlanIsReusableForOtherPointSets) {
  Nfft3 plan({8, 9, 10}, {3.0, 4.7, 6.4}, {.tolerance = 1e-8});
  for (const int count : {30, 3, 100})
    EXPECT_LT(relative_error(plan, random_problem<3>(count, count), false), 1e-8);
}

TEST(Nfft, TakesTheCentresOfKnotsWithoutCopying) {
  const Problem<4> p = random_problem<4>(20, 31);
  Nfft3 plan({6, 6, 6}, {3.0, 4.0, 5.0}, {.tolerance = 1e-9});
  const auto result = plan.transform(p.points.topRows<3>(), p.weights);
  const Eigen::Matrix3Xd centres = p.points.topRows<3>();
  const Eigen::VectorXcd expected =
      reference::ndft<3>(centres, p.weights, {6, 6, 6}, {3.0, 4.0, 5.0});
  const Eigen::Map<const Eigen::VectorXcd> map(result.data(), 216);
  EXPECT_LT((map - expected).norm(), 1e-9 * expected.norm());
}

TEST(Nfft, RefusesBadInput) {
  const std::array box{1.0, 1.0, 1.0};
  EXPECT_THROW(Nfft3({0, 4, 4}, box), InputError);
  EXPECT_THROW(Nfft3({4, 4, 4}, {1.0, -1.0, 1.0}), InputError);
  EXPECT_THROW(Nfft3({4, 4, 4}, box, {.tolerance = 1e-13}), InputError);
  EXPECT_THROW(Nfft3({4, 4, 4}, box, {.tolerance = std::numeric_limits<double>::quiet_NaN()}),
               InputError);
  EXPECT_THROW(Nfft3f({4, 4, 4}, box, {.tolerance = 1e-8}), InputError);
  EXPECT_THROW(Nfft3({4, 4, 4}, box, {.upsampling = 1.0}), InputError);
  EXPECT_THROW(Nfft3({40, 40, 40}, box, {.tolerance = 1e-12, .upsampling = 1.25}), InputError);
  EXPECT_THROW(Nfft3f({40, 40, 40}, box, {.tolerance = 1e-6, .upsampling = 1.25}), InputError);
  Nfft3 plan({4, 4, 4}, box);
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, 2);
  Eigen::VectorXcd weights = Eigen::VectorXcd::Ones(2);
  EXPECT_THROW(plan.transform(points, Eigen::VectorXcd(Eigen::VectorXcd::Ones(3))), InputError);
  EXPECT_THROW(plan.transform(points, Eigen::VectorXd(Eigen::VectorXd::Ones(2))), InputError);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    points(1, 1) = bad;
    EXPECT_THROW(plan.transform(points, weights), InputError);
  }
}

}  // namespace
}  // namespace mortise
