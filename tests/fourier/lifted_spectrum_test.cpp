// SPDX-License-Identifier: GPL-3.0-or-later
// The three forms of the lifted spectrum against the sum of the offset balls' own transforms, and
// the paper's cone.
#include "mortise/fourier/lifted_spectrum.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "mortise/core/errors.hpp"
#include "mortise/kernels/cone.hpp"
#include "reference/ndft.hpp"

namespace mortise {
namespace {

constexpr std::array kModes{9, 8, 10};
constexpr std::array kBox{30.0, 28.0, 36.0};

Knots random_knots(int count, double r_min, double r_max) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Knots knots{Eigen::Matrix4Xd(4, count), Eigen::VectorXcd(count)};
  for (int i = 0; i < count; ++i) {
    knots.points.col(i) << 20.0 * uniform(random), 20.0 * uniform(random), 20.0 * uniform(random),
        r_min + (r_max - r_min) * uniform(random);
    knots.weights[i] = {uniform(random), uniform(random) - 0.5};
  }
  return knots;
}

// Of the shape with all radii r0 larger, ball by ball.
Eigen::VectorXcd offset_spectrum(const Knots& knots, const RadialKernel& kernel, double r0) {
  Eigen::VectorXcd result(kModes[0] * kModes[1] * kModes[2]);
  Eigen::Index index = 0;
  for (int x = 0; x < kModes[0]; ++x)
    for (int y = 0; y < kModes[1]; ++y)
      for (int z = 0; z < kModes[2]; ++z, ++index) {
        const Eigen::Vector3d w((x - kModes[0] / 2) / kBox[0], (y - kModes[1] / 2) / kBox[1],
                                (z - kModes[2] / 2) / kBox[2]);
        std::complex<double> sum = 0.0;
        for (Eigen::Index i = 0; i < knots.size(); ++i)
          sum += knots.weights[i] *
                 std::polar(1.0, -2.0 * std::numbers::pi * w.dot(knots.points.col(i).head<3>())) *
                 kernel.transform(w.norm(), knots.points(3, i) + r0);
        result[index] = sum;
      }
  return result;
}

TEST(LiftedSpectrum, ThreeFormsEqualTheOffsetShapesAtEveryTolerance) {
  const double r0 = 1.4;
  for (const auto& [r_min, r_max] :
       {std::pair{1.4, 2.1}, std::pair{0.5, 4.0}, std::pair{1.8, 1.8}}) {
    const Knots knots = random_knots(80, r_min, r_max);
    for (const RadialKernel& kernel : {RadialKernel(), RadialKernel(2.0)})
      for (const double tolerance : {1e-2, 1e-3, 1e-5, 1e-8})
        for (const LiftedForm form :
             {LiftedForm::kDirect4d, LiftedForm::kNfft4d, LiftedForm::kCompressed}) {
          const Eigen::MatrixXcd slices = lifted_spectrum(
              knots, kernel, kModes, kBox,
              {.offsets = {0.0, r0, 2.0 * r0}, .tolerance = tolerance, .form = form});
          for (int s = 0; s < 3; ++s) {
            const Eigen::VectorXcd expected = offset_spectrum(knots, kernel, s * r0);
            EXPECT_LT((slices.col(s) - expected).norm(), tolerance * expected.norm())
                << "slice " << s << " form " << static_cast<int>(form) << " radii " << r_min
                << " to " << r_max;
          }
        }
  }
}

// The cone exactly as printed, trimmed by psi_2, its spectrum cut off after 128 terms: slices come
// out with the trimming factor on each ball, and dividing the weights by it gives the shape back.
TEST(LiftedSpectrum, PapersConeWeighsBallsByItsTrimming) {
  const RadialKernel kernel(2.0);
  const Knots knots = random_knots(30, 1.4, 2.4);
  const double height = 10.0, r0 = 1.4;
  const ConeSeries cone = trimmed_cone(kernel, height, 2.0, 128);
  for (const double offset : {0.0, r0}) {
    Knots compensated = knots;
    for (Eigen::Index i = 0; i < knots.size(); ++i)
      compensated.weights[i] /= cone.trim(knots.points(3, i) + offset);
    const Eigen::VectorXcd sums = reference::ndft<4>(
        compensated.points, compensated.weights, {kModes[0], kModes[1], kModes[2], cone.modes()},
        {kBox[0], kBox[1], kBox[2], height});
    const Eigen::VectorXcd expected = offset_spectrum(knots, kernel, offset);
    Eigen::VectorXcd slice = Eigen::VectorXcd::Zero(expected.size());
    Eigen::Index index = 0;
    for (int x = 0; x < kModes[0]; ++x)
      for (int y = 0; y < kModes[1]; ++y)
        for (int z = 0; z < kModes[2]; ++z, ++index) {
          const Eigen::VectorXcd g = cone.coefficients(std::hypot((x - kModes[0] / 2) / kBox[0],
                                                                  (y - kModes[1] / 2) / kBox[1],
                                                                  (z - kModes[2] / 2) / kBox[2]));
          for (int m = 0; m < cone.modes(); ++m)
            slice[index] +=
                g[m] * sums[index * cone.modes() + m] *
                std::polar(1.0, -2.0 * std::numbers::pi * (m - cone.modes() / 2) * offset / height);
        }
    EXPECT_LT((slice - expected).norm(), 1e-5 * expected.norm())
        << offset;  // what 128 terms of psi_2 reach
  }
}

TEST(LiftedSpectrum, RefusesBadInput) {
  const Knots knots = random_knots(3, 1.0, 2.0);
  const RadialKernel ball;
  EXPECT_THROW((void)lifted_spectrum(Knots{}, ball, kModes, kBox), InputError);
  EXPECT_THROW((void)lifted_spectrum(knots, ball, {0, 1, 1}, kBox), InputError);
  EXPECT_THROW((void)lifted_spectrum(knots, ball, kModes, kBox, {.offsets = {}}), InputError);
  EXPECT_THROW((void)lifted_spectrum(knots, ball, kModes, kBox, {.offsets = {-1.0}}), InputError);
  EXPECT_THROW((void)lifted_spectrum(knots, ball, kModes, kBox, {.tolerance = 1e-12}), InputError);
}

}  // namespace
}  // namespace mortise
