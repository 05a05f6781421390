// SPDX-License-Identifier: GPL-3.0-or-later
// The three forms of the lifted spectrum.
#include "mortise/fourier/lifted_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <string>

#include "mortise/core/errors.hpp"
#include "mortise/fourier/direct_ndft.hpp"
#include "mortise/fourier/nfft.hpp"
#include "mortise/kernels/compressed_radius.hpp"
#include "mortise/kernels/cone.hpp"

namespace mortise {
namespace {

// |w| of every mode, and for each mode the index of its value in the list of different ones.
struct Shells {
  std::vector<double> lengths;
  std::vector<int> of_mode;
};

Shells shells_of(const std::array<int, 3>& modes, const std::array<double, 3>& box) {
  Shells shells;
  std::map<double, int> seen;
  for (int x = 0; x < modes[0]; ++x)
    for (int y = 0; y < modes[1]; ++y)
      for (int z = 0; z < modes[2]; ++z) {
        const double length = std::hypot((x - modes[0] / 2) / box[0], (y - modes[1] / 2) / box[1],
                                         (z - modes[2] / 2) / box[2]);
        const auto [entry, is_new] =
            seen.try_emplace(length, static_cast<int>(shells.lengths.size()));
        if (is_new) shells.lengths.push_back(length);
        shells.of_mode.push_back(entry->second);
      }
  return shells;
}

// Kernels' errors are relative to their volumes, the result's is relative to spectra that have
// fallen well below that.
constexpr double kKernelShare = 0.05, kSumShare = 0.1;

Eigen::MatrixXcd by_fourth_axis(const Knots& knots, const ConeSeries& cone, const Shells& shells,
                                const std::array<int, 3>& modes, const std::array<double, 3>& box,
                                const LiftedOptions& options) {
  const std::array<int, 4> modes4{modes[0], modes[1], modes[2], cone.modes()};
  const std::array<double, 4> box4{box[0], box[1], box[2], cone.period()};
  const Eigen::Matrix4Xd& points = knots.points;
  const Eigen::VectorXcd sums =
      options.form == LiftedForm::kDirect4d
          ? direct_ndft(points, knots.weights, modes4, box4, options.threads)
          : nfft(points, knots.weights, modes4, box4,
                 {.tolerance = std::max(1e-12, kSumShare * options.tolerance),
                  .threads = options.threads});
  const Eigen::Index count = cone.modes(), total = static_cast<Eigen::Index>(shells.of_mode.size());
  Eigen::MatrixXcd coefficients(count, static_cast<Eigen::Index>(shells.lengths.size()));
  for (Eigen::Index s = 0; s < coefficients.cols(); ++s)
    coefficients.col(s) = cone.coefficients(shells.lengths[s]);
  Eigen::MatrixXcd result(total, static_cast<Eigen::Index>(options.offsets.size()));
  for (Eigen::Index column = 0; column < result.cols(); ++column) {
    Eigen::VectorXcd slide(count);
    for (Eigen::Index m = 0; m < count; ++m)
      slide[m] = std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(m - count / 2) *
                                     options.offsets[column] / cone.period());
    for (Eigen::Index i = 0; i < total; ++i)
      result(i, column) = (coefficients.col(shells.of_mode[i]).array() * slide.array() *
                           sums.segment(i * count, count).array())
                              .sum();
  }
  return result;
}

Eigen::MatrixXcd by_compression(const Knots& knots, const CompressedRadius& compressed,
                                const Shells& shells, const std::array<int, 3>& modes,
                                const std::array<double, 3>& box, const LiftedOptions& options) {
  const Eigen::Index total = static_cast<Eigen::Index>(shells.of_mode.size());
  Eigen::MatrixXcd result =
      Eigen::MatrixXcd::Zero(total, static_cast<Eigen::Index>(options.offsets.size()));
  Nfft3 plan(modes, box,
             {.tolerance = std::max(1e-12, kSumShare * options.tolerance),
              .expected_points = knots.size(),
              .threads = options.threads});
  Eigen::MatrixXd b(knots.size(), compressed.terms());
  for (Eigen::Index i = 0; i < knots.size(); ++i)
    b.row(i) = compressed.radius_factors(knots.points(3, i));
  std::vector<Eigen::MatrixXd> factors;  // of each offset: terms x shells
  for (std::size_t o = 0; o < options.offsets.size(); ++o) {
    factors.emplace_back(compressed.terms(), static_cast<Eigen::Index>(shells.lengths.size()));
    for (Eigen::Index s = 0; s < factors[o].cols(); ++s)
      factors[o].col(s) = compressed.frequency_factors(shells.lengths[s], o);
  }
  // The basis in the radius is the same at all offsets: one transform a term serves them.
  for (int q = 0; q < compressed.terms(); ++q) {
    const Eigen::VectorXcd weights = knots.weights.array() * b.col(q).array();
    const auto sums = plan.transform(knots.points.topRows<3>(), weights);
    for (std::size_t o = 0; o < factors.size(); ++o)
      for (Eigen::Index i = 0; i < total; ++i)
        result(i, static_cast<Eigen::Index>(o)) += factors[o](q, shells.of_mode[i]) * sums[i];
  }
  return result;
}

}  // namespace

Eigen::MatrixXcd lifted_spectrum(const Knots& knots, const RadialKernel& kernel,
                                 const std::array<int, 3>& modes, const std::array<double, 3>& box,
                                 const LiftedOptions& options) {
  check_knots(knots, "lifted_spectrum");
  if (!(options.tolerance >= 1e-8 && options.tolerance <= 0.1))
    throw InputError("lifted_spectrum: tolerance must be in [1e-8, 0.1], got " +
                     std::to_string(options.tolerance));
  if (options.offsets.empty())
    throw InputError("lifted_spectrum: expected at least one offset, got none");
  for (const double offset : options.offsets)
    if (!(offset >= 0.0 && std::isfinite(offset)))
      throw InputError("lifted_spectrum: offsets must be >= 0 and finite, got " +
                       std::to_string(offset));
  for (int d = 0; d < 3; ++d)
    if (modes[d] < 1 || !(box[d] > 0.0) || std::isinf(box[d]))
      throw InputError("lifted_spectrum: expected mode counts >= 1 and box sides > 0, got " +
                       std::to_string(modes[d]) + " modes on side " + std::to_string(box[d]));
  const Shells shells = shells_of(modes, box);
  const double k_max =
      std::max(*std::max_element(shells.lengths.begin(), shells.lengths.end()), 1e-3 / box[0]);
  const double tolerance = std::max(1e-10, kKernelShare * options.tolerance);
  if (options.form == LiftedForm::kCompressed)
    return by_compression(
        knots,
        compress_radius(transform_of(kernel), k_max,
                        std::vector<double>(knots.points.row(3).begin(), knots.points.row(3).end()),
                        {.tolerance = tolerance, .offsets = options.offsets}),
        shells, modes, box, options);
  const auto [least, most] = std::minmax_element(options.offsets.begin(), options.offsets.end());
  return by_fourth_axis(
      knots,
      fitted_cone(transform_of(kernel), k_max, knots.points.row(3).minCoeff() + *least,
                  knots.points.row(3).maxCoeff() + *most, tolerance),
      shells, modes, box, options);
}

}  // namespace mortise
