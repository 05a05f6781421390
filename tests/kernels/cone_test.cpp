// SPDX-License-Identifier: GPL-3.0-or-later
// The lifted cone's transform against a plain double integral, and its series against the
// kernel.
#include "mortise/kernels/cone.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

using std::numbers::pi;

TEST(TrimmingFactor, IsOneInTheMiddleAndZeroAtTheEnds) {
  EXPECT_EQ(trimming_factor(5.0, 10.0, 2.0), 1.0);
  EXPECT_EQ(trimming_factor(0.0, 10.0, 2.0), 0.0);
  EXPECT_EQ(trimming_factor(10.0, 10.0, 2.0), 0.0);
  EXPECT_DOUBLE_EQ(trimming_factor(2.5, 10.0, 2.0), std::exp(-1.0 / 3.0));  // psi_2(1 / 2)
}

// The 4D transform as it is defined: over |x| and over -L < r < 0, midpoint rule in both.
std::complex<double> cone_by_definition(double alpha, double k, double eta, double height,
                                        double trim_alpha) {
  const int n = 1500;
  std::complex<double> sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const double r = -height * (i + 0.5) / n, radius = -r;
    double slice = 0.0;
    for (int j = 0; j < n; ++j) {
      const double s = radius * (j + 0.5) / n, u = 2.0 * pi * k * s;
      slice += 4.0 * pi * s * s * bump(s / radius, alpha) * (u == 0.0 ? 1.0 : std::sin(u) / u);
    }
    sum += slice * (radius / n) * bump(1.0 + 2.0 * r / height, trim_alpha) *
           std::polar(1.0, -2.0 * pi * eta * r);
  }
  return sum * (height / n);
}

TEST(ConeTransform, EqualsTheDefinition) {
  const RadialKernel kernel(2.0);
  const double scale = std::abs(cone_transform(kernel, 0.0, 0.0, 6.0, 2.0));
  for (const double k : {0.0, 0.1, 0.3})
    for (const double eta : {0.0, 0.2, -0.5}) {
      const auto value = cone_transform(kernel, k, eta, 6.0, 2.0),
                 expected = cone_by_definition(2.0, k, eta, 6.0, 2.0);
      EXPECT_LT(std::abs(value - expected), 1e-6 * scale) << k << " " << eta;
    }
}

std::complex<double> series_at(const ConeSeries& cone, double k, double r) {
  const Eigen::VectorXcd g = cone.coefficients(k);
  std::complex<double> value = 0.0;
  for (int m = 0; m < cone.modes(); ++m)
    value += g[m] * std::polar(1.0, -2.0 * pi * (m - cone.modes() / 2) * r / cone.period());
  return value;
}

TEST(ConeSeries, TrimmedConeHasTheTransformAsCoefficientsAndSumsToTheTrimmedKernel) {
  const RadialKernel kernel;
  const ConeSeries cone = trimmed_cone(kernel, 8.0, 2.0, 121);
  const Eigen::VectorXcd g = cone.coefficients(0.2);
  const double scale = kernel.volume(4.0);
  for (const int m : {0, 40, 60, 61, 75})
    EXPECT_LT(std::abs(g[m] - cone_transform(kernel, 0.2, (m - 60) / 8.0, 8.0, 2.0) / 8.0),
              1e-10 * scale);
  for (const double r : {0.5, 1.8, 3.2, 6.0})
    EXPECT_LT(
        std::abs(series_at(cone, 0.2, r) - kernel.transform(0.2, r) * trimming_factor(r, 8.0, 2.0)),
        1e-6 * scale);
}

TEST(ConeSeries, FittedConeGivesTheKernelOnItsRadii) {
  for (const RadialKernel& kernel : {RadialKernel(), RadialKernel(2.0)})
    for (const auto& [r_min, r_max] :
         {std::pair{1.4, 4.8}, std::pair{1.8, 1.8}, std::pair{0.3, 12.0}})
      for (const double tolerance : {1e-2, 1e-6, 1e-10}) {
        const ConeSeries cone = fitted_cone(transform_of(kernel), 0.43, r_min, r_max, tolerance);
        for (const double k : {0.0, 0.071, 0.21, 0.43})
          for (const double part : {0.0, 0.013, 0.37, 0.77, 1.0}) {
            const double r = r_min + part * (r_max - r_min);
            EXPECT_LT(std::abs(series_at(cone, k, r) - kernel.transform(k, r)),
                      1.1 * tolerance * kernel.volume(r_max))
                << "k " << k << " r " << r << " modes " << cone.modes();
          }
      }
  EXPECT_LE(fitted_cone(transform_of(RadialKernel()), 0.43, 1.4, 4.8, 1e-6).modes(), 20);
  EXPECT_THROW((void)fitted_cone(transform_of(RadialKernel()), 0.43, 0.0, 4.8, 1e-6), InputError);
}

}  // namespace
}  // namespace mortise
