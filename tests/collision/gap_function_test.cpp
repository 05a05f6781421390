// SPDX-License-Identifier: GPL-3.0-or-later
// The gap function against plain sums, exact volumes, differences and its symmetries.
#include "mortise/collision/gap_function.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "collision/bodies.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/kernels/ball.hpp"

namespace mortise {
namespace {

using tests::nudged;
using tests::random_knots;
using tests::random_pose;

const Eigen::Vector3d kFixedCentre(3.0, -1.0, 2.0), kMovingCentre(-2.0, 4.0, 1.0);

struct Pair {
  BodyDensity fixed, moving;
  explicit Pair(bool complex = false, unsigned seed = 1)
      : fixed(density_of_knots(random_knots(40, 4.0, kFixedCentre, seed, complex))),
        moving(density_of_knots(random_knots(30, 3.0, kMovingCentre, seed + 1, complex))) {}
  [[nodiscard]] RigidMotion pose(std::mt19937_64& random, double reach = 6.0) const {
    return random_pose(kFixedCentre, kMovingCentre, reach, random);
  }
};

// L^-3 Re sum of F(w) conj(G'(w)) over the modes |k| <= reach of the whole space, every body's
// spectrum summed ball by ball where it lies: no half space, no rotated frequencies, no gradient.
double plain_sum(const BodyDensity& fixed, const BodyDensity& moving, const RigidMotion& pose,
                 double box, int reach) {
  const auto spectrum = [](const BodyDensity& body, const Eigen::Matrix3Xd& places,
                           const Eigen::Vector3d& w, bool imaginary) {
    std::complex<double> sum = 0.0;
    for (Eigen::Index i = 0; i < body.size(); ++i)
      sum += (imaginary ? body.weights[i].imag() : body.weights[i].real()) *
             ball_transform(w.norm(), body.radii[i]) *
             std::polar(1.0, -2.0 * std::numbers::pi * w.dot(places.col(i)));
    return sum;
  };
  const Eigen::Matrix3Xd moved = pose * moving.points;
  double sum = 0.0;
  for (int x = -reach; x <= reach; ++x)
    for (int y = -reach; y <= reach; ++y)
      for (int z = -reach; z <= reach; ++z) {
        if (x * x + y * y + z * z > reach * reach) continue;
        const Eigen::Vector3d w = Eigen::Vector3d(x, y, z) / box;
        for (const bool imaginary : {false, true})
          sum += (imaginary ? -1.0 : 1.0) * (spectrum(fixed, fixed.points, w, imaginary) *
                                             std::conj(spectrum(moving, moved, w, imaginary)))
                                                .real();
      }
  return sum / (box * box * box);
}

TEST(GapFunction, ExactFormEqualsThePlainInnerProduct) {
  for (const bool complex : {false, true}) {
    const Pair pair(complex);
    // 0 and the 514 other modes within |k| <= 5: whole shells, so the plain sum has the very same.
    const GapFunction gap(pair.fixed, pair.moving, {.max_modes = 515});
    ASSERT_EQ(gap.modes(), 515);
    std::mt19937_64 random(7);
    for (int i = 0; i < 3; ++i) {
      const RigidMotion pose = pair.pose(random);
      const double expected = plain_sum(pair.fixed, pair.moving, pose, gap.box(), 5);
      const double scale = plain_sum(pair.fixed, pair.fixed, {}, gap.box(), 5);
      EXPECT_NEAR(gap.exact(pose).value, expected,
                  1e-6 * std::abs(scale));  // the fixed NFFT's 1e-7
    }
  }
}

TEST(GapFunction, ConvergesToTheOverlapOfTwoBalls) {
  const double a = 1.5, b = 1.0;
  const auto ball = [](const Eigen::Vector3d& x, double r) {
    return density_of_knots({Eigen::Vector4d(x[0], x[1], x[2], r), Eigen::VectorXcd::Ones(1)});
  };
  const BodyDensity fixed = ball({1, 2, 3}, a), moving = ball({0, 1, 0}, b);
  double last_error = 1.0;
  for (const int modes : {1000, 8000, 64000}) {
    const GapFunction gap(fixed, moving, {.max_modes = modes});
    double error = 0.0;
    for (const double distance : {0.2, 0.9, 1.6, 2.3}) {
      RigidMotion pose;
      pose.translation = Eigen::Vector3d(1, 1, 3) + distance * Eigen::Vector3d(0.6, 0.0, 0.8);
      error =
          std::max(error, std::abs(gap.exact(pose).value - ball_overlap_volume(a, b, distance)));
    }
    error /= ball_overlap_volume(a, b, 0.0);
    EXPECT_LT(error, 0.5 * last_error)
        << modes;  // spectra fall as k^-2 each: the rest as 1 / reach^2
    last_error = error;
  }
  EXPECT_LT(last_error, 2e-3);
}

// All six derivatives of `value` at `pose` by central differences of fourth order.
template <class Value>
Eigen::Matrix<double, 6, 1> differences(const Value& value, const RigidMotion& pose, double step) {
  Eigen::Matrix<double, 6, 1> result;
  for (int d = 0; d < 6; ++d) {
    const auto at = [&](double h) {
      Eigen::Vector3d shift = Eigen::Vector3d::Zero(), turn = Eigen::Vector3d::Zero();
      (d < 3 ? shift[d] : turn[d - 3]) = h;
      return value(nudged(pose, shift, turn));
    };
    result[d] = (8.0 * (at(step) - at(-step)) - (at(2.0 * step) - at(-2.0 * step))) / (12.0 * step);
  }
  return result;
}

Eigen::Matrix<double, 6, 1> gradient(const GapValue& value) {
  Eigen::Matrix<double, 6, 1> result;
  result << value.translation_gradient, value.rotation_gradient;
  return result;
}

TEST(GapFunction, GradientsMeetDifferencesInDoublePrecision) {
  for (const bool complex : {false, true})
    for (unsigned seed = 1; seed <= 3; ++seed) {
      const Pair pair(complex, 10 * seed);
      const GapFunction gap(pair.fixed, pair.moving, {.max_modes = 500});
      std::mt19937_64 random(seed);
      const RigidMotion pose = pair.pose(random);
      const auto value = [&](const RigidMotion& at) { return gap.exact(at).value; };
      const Eigen::Matrix<double, 6, 1> expected = differences(value, pose, 1e-3);
      const Eigen::Matrix<double, 6, 1> found = gradient(gap.exact(pose));
      EXPECT_LT((found - expected).norm(), 1e-6 * expected.norm()) << "seed " << seed;
    }
}

TEST(GapFunction, FastFormAgreesWithTheExactOne) {
  for (const bool complex : {false, true})
    for (const double oversampling : {1.5, 2.0, 3.0}) {
      const Pair pair(complex, 5);
      const GapFunction gap(pair.fixed, pair.moving,
                            {.max_modes = 4096, .oversampling = oversampling});
      std::mt19937_64 random(3);
      double value_scale = 0.0, slope_scale = 0.0, spin_scale = 0.0;
      double value_error = 0.0, slope_error = 0.0, spin_error = 0.0;
      for (int i = 0; i < 12; ++i) {
        const RigidMotion pose = pair.pose(random);
        for (const int modes : {1, 2, 63, 64, 65, 1001, 4096}) {
          const GapValue exact = gap.exact(pose, modes), fast = gap(pose, modes);
          value_scale = std::max(value_scale, std::abs(exact.value));
          slope_scale = std::max(slope_scale, exact.translation_gradient.norm());
          spin_scale = std::max(spin_scale, exact.rotation_gradient.norm());
          value_error = std::max(value_error, std::abs(fast.value - exact.value));
          slope_error = std::max(slope_error,
                                 (fast.translation_gradient - exact.translation_gradient).norm());
          spin_error =
              std::max(spin_error, (fast.rotation_gradient - exact.rotation_gradient).norm());
        }
      }
      RecordProperty("spectrum_error", std::to_string(gap.interpolation_error()));
      const double allowed = oversampling < 1.8 ? 1e-3 : oversampling < 2.5 ? 8e-4 : 5e-4;
      EXPECT_LT(value_error, allowed * value_scale);
      EXPECT_LT(slope_error, allowed * slope_scale);
      EXPECT_LT(spin_error, 3.0 * allowed * spin_scale);
    }
}

// The lattice of frequencies is mapped onto itself by the turns of a cube, so these identities hold
// to the accuracy of the spectra for them; any turn may be applied to the moving body's own frame.
TEST(GapFunction, ValuesDoNotDependOnTheFramesChosen) {
  const Pair pair;
  const GapOptions options = {.max_modes = 515, .box = 60.0};
  const GapFunction gap(pair.fixed, pair.moving, options);
  std::mt19937_64 random(11);
  Eigen::Matrix3d quarter;
  quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const RigidMotion a{Eigen::Quaterniond(quarter), {1.0, 2.0, 3.0}};
  const RigidMotion b{tests::random_rotation(random), {-2.0, 0.5, 1.0}};
  BodyDensity fixed = pair.fixed, moving = pair.moving;
  fixed.points = a * fixed.points;
  moving.points = b * moving.points;
  const GapFunction other(fixed, moving, options);
  for (int i = 0; i < 3; ++i) {
    const RigidMotion pose = pair.pose(random);
    const GapValue here = gap.exact(pose);
    const GapValue there = other.exact(compose(a, compose(pose, inverse(b))));
    EXPECT_NEAR(there.value, here.value, 1e-6 * std::abs(here.value));
    EXPECT_LT((there.translation_gradient - a.rotation * here.translation_gradient).norm(),
              1e-6 * here.translation_gradient.norm());
  }
}

TEST(GapFunction, SwappingTheBodiesInvertsThePose) {
  const Pair pair;
  const GapOptions options = {.max_modes = 515, .box = 60.0};
  const GapFunction gap(pair.fixed, pair.moving, options),
      swapped(pair.moving, pair.fixed, options);
  Eigen::Matrix3d quarter;
  quarter << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  std::mt19937_64 random(12);
  for (int i = 0; i < 3; ++i) {
    RigidMotion pose = pair.pose(random);
    const Eigen::Vector3d centre = pose * kMovingCentre;
    pose.rotation = Eigen::Quaterniond(quarter);
    pose.translation = centre - pose.rotation * kMovingCentre;
    const double here = gap.exact(pose).value, there = swapped.exact(inverse(pose)).value;
    EXPECT_NEAR(there, here, 1e-6 * std::abs(here));
  }
}

TEST(GapFunction, BatchesAreTheSameForAnyThreads) {
  const Pair pair(true);
  const GapFunction gap(pair.fixed, pair.moving, {.max_modes = 1000});
  std::mt19937_64 random(2);
  std::vector<RigidMotion> poses;
  for (int i = 0; i < 200; ++i) poses.push_back(pair.pose(random));
  std::vector<GapValue> one(poses.size()), three(poses.size());
  gap.evaluate(poses, one, 0, 1);
  gap.evaluate(poses, three, 0, 3);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(one[i].value, three[i].value);
    EXPECT_EQ(one[i].rotation_gradient, three[i].rotation_gradient);
  }
}

// Whatever is said to be below a threshold is so; and most of what is far below it is found out
// early.
TEST(GapFunction, EarlyMissesAreNeverWrong) {
  const Pair pair;
  const GapFunction gap(pair.fixed, pair.moving, {.max_modes = 4096, .oversampling = 4.0});
  std::mt19937_64 random(17);
  int early = 0, below = 0;
  for (int i = 0; i < 200; ++i) {
    const RigidMotion pose = pair.pose(random, 11.0);
    const double value = gap.exact(pose).value;
    for (const double threshold : {0.5, 5.0, 30.0, 100.0}) {
      const GapFunction::Rejection found = gap.reject(pose, threshold);
      if (found.rejected) {
        EXPECT_LT(value, threshold);
      }
      EXPECT_GE(found.bound, value);
      below += value < threshold ? 1 : 0;
      early += found.rejected && found.modes < gap.modes() / 2 ? 1 : 0;
    }
  }
  EXPECT_GT(early, below / 4);
}

TEST(GapFunction, RefusesBadInput) {
  const Pair real, complex(true);
  EXPECT_THROW(GapFunction(real.fixed, complex.moving), InputError);
  EXPECT_THROW(GapFunction(real.fixed, real.moving, {.max_modes = 0}), InputError);
  EXPECT_THROW(GapFunction(real.fixed, real.moving, {.box = 1.0}), InputError);
  EXPECT_THROW(GapFunction(real.fixed, real.moving, {.oversampling = 1.0}), InputError);
  EXPECT_THROW((void)density_of_knots(random_knots(3, 1.0, {0, 0, 0}, 1), RadialKernel{}, -5.0),
               InputError);
  const GapFunction gap(complex.fixed, complex.moving, {.max_modes = 100});
  EXPECT_THROW((void)gap.reject({}, 1.0), InputError);
}

}  // namespace
}  // namespace mortise
