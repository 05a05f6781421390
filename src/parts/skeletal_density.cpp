// SPDX-License-Identifier: GPL-3.0-or-later
// The skeletal density's kernel, tabulated, and its integral at nodes and points.
#include "mortise/parts/skeletal_density.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "core/chebyshev.hpp"
#include "core/isa.hpp"
#include "core/quadrature.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"
#include "parts/build_triangle_tree.hpp"
#include "parts/grid_blocks.hpp"
#include "parts/skeletal_isa.hpp"

namespace mortise {

namespace isa_baseline {
extern const SkeletalTable kSkeletalTable;
}
namespace isa_avx2 {
extern const SkeletalTable kSkeletalTable;
}
namespace isa_avx512 {
extern const SkeletalTable kSkeletalTable;
}

const SkeletalTable& skeletal_table() {
  return pick_isa(best_isa(), isa_baseline::kSkeletalTable, isa_avx2::kSkeletalTable,
                  isa_avx512::kSkeletalTable);
}

namespace {

using Eigen::Index;

std::complex<double> kernel_at(double t, double sigma) {
  const double x = (t - 1.0) / sigma;
  const double g = std::exp(-0.5 * x * x) / (std::sqrt(2.0 * std::numbers::pi) * sigma);
  return g / ((std::complex<double>(1.0, t)) * std::complex<double>(1.0, t));
}

// Int_t^longest of the kernel.
std::complex<double> tail(double t, double longest, double sigma, const QuadratureRule& rule) {
  const int panels = 1 + static_cast<int>((longest - t) / (0.5 * std::min(sigma, 1.0)));
  const double step = (longest - t) / panels;
  std::complex<double> sum = 0.0;
  for (int p = 0; p < panels; ++p)
    for (int k = 0; k < kSkeletalNodes; ++k)
      sum += rule.weights[k] * step * kernel_at(t + (p + rule.nodes[k]) * step, sigma);
  return sum;
}

SkeletalKernel make_kernel(double sigma, double tolerance) {
  SkeletalKernel kernel{};
  kernel.sigma = sigma;
  // What is left out is a share of the peak below tolerance / 30 over at most the whole sphere.
  kernel.longest = 1.0 + sigma * std::sqrt(2.0 * std::log(30.0 / tolerance));
  // One cluster at its worst may err by the tolerance; the errors of many largely cancel, the more
  // so the thinner the shell of surface that counts. Chosen by the largest errors of a sweep of
  // shapes.
  kernel.allowed = tolerance * std::clamp(0.4 / sigma, 1.0, 5.0);
  kernel.allowed_degree_five = std::sqrt(2.0 * kernel.allowed);
  kernel.middle = 0.5 * (1.0 + 1.0 / kernel.longest);
  kernel.half = 0.5 * (1.0 - 1.0 / kernel.longest);
  const QuadratureRule rule = gauss_legendre(kSkeletalNodes, 0.0, 1.0);
  constexpr int kSamples = 2 * kSkeletalTerms;
  std::vector<double> real(kSamples), imag(kSamples);
  for (int j = 0; j < kSamples; ++j) {
    const double t = 1.0 / (kernel.middle + kernel.half * chebyshev_zero(j, kSamples));
    const std::complex<double> value = tail(t, kernel.longest, sigma, rule);
    real[j] = value.real();
    imag[j] = value.imag();
  }
  real = chebyshev_series(real, kSkeletalTerms);
  imag = chebyshev_series(imag, kSkeletalTerms);
  real[0] *= 0.5;
  imag[0] *= 0.5;
  std::copy(real.begin(), real.end(), kernel.tail_real);
  std::copy(imag.begin(), imag.end(), kernel.tail_imag);
  std::copy(rule.nodes.begin(), rule.nodes.end(), kernel.nodes);
  std::copy(rule.weights.begin(), rule.weights.end(), kernel.weights);
  return kernel;
}

void check(const SkeletalDensityOptions& options) {
  const auto within = [](const char* name, double value, double least, double most) {
    if (!(value >= least && value <= most))
      throw InputError(std::string("skeletal_density: ") + name + " must be from " +
                       std::to_string(least) + " to " + std::to_string(most) + ", got " +
                       std::to_string(value));
  };
  within("thickness", options.thickness, 0.01, 4.0);
  within("tolerance", options.tolerance, 0.005, 0.1);
  if (!std::isfinite(options.exterior) || !std::isfinite(options.penalty))
    throw InputError("skeletal_density: exterior and penalty must be finite");
}

// The density at points whose signed distances are known.
Eigen::VectorXcd densities(const MeshSolid& solid, const SkeletalKernel& kernel,
                           const SkeletalDensityOptions& options, const Eigen::Matrix3Xd& points,
                           const Eigen::VectorXd& distances) {
  // Points on the surface get 0; a length that cannot overflow stands in for theirs.
  const double shortest = 1e-30 + 1e-14 * solid.bounds().diagonal().norm();
  const Eigen::VectorXd sizes = distances.cwiseAbs().cwiseMax(shortest);
  Eigen::Matrix2Xd parts(2, points.cols());
  skeletal_table().integrate(solid.tree().view(), kernel, points.data(), sizes.data(),
                             points.cols(), parts.data());
  Eigen::VectorXcd result(points.cols());
  for (Index i = 0; i < points.cols(); ++i) {
    const double d = distances[i];
    if (!(std::abs(d) > shortest))
      result[i] = 0.0;
    else if (d > 0.0)
      result[i] = options.exterior * std::complex<double>(parts(0, i), parts(1, i));
    else  // xi < 0 conjugates the kernel
      result[i] =
          -options.penalty * options.exterior * std::complex<double>(parts(0, i), -parts(1, i));
  }
  return result;
}

}  // namespace

SkeletalDensity skeletal_density(const MeshSolid& solid, const DistanceGrid& distances,
                                 const SkeletalDensityOptions& options) {
  check(options);
  check_nodes("skeletal_density", distances);
  if (static_cast<Index>(distances.values.size()) != distances.count())
    throw InputError("skeletal_density: " + std::to_string(distances.count()) +
                     " distances expected, got " + std::to_string(distances.values.size()));
  const SkeletalKernel kernel = make_kernel(options.thickness, options.tolerance);
  SkeletalDensity density;
  static_cast<GridNodes&>(density) = distances;
  density.values.resize(distances.values.size());
  const GridBlocks blocks(distances);
  parallel_for(blocks.count(), options.threads, [&](std::size_t index, int) {
    const GridBlock block = blocks.block(index);
    Eigen::VectorXd own(block.points.cols());
    for (Index n = 0; n < own.size(); ++n) own[n] = distances.values[block.indices[n]];
    const Eigen::VectorXcd values = densities(solid, kernel, options, block.points, own);
    for (Index n = 0; n < own.size(); ++n)
      density.values[block.indices[n]] = std::complex<float>(values[n]);
  });
  return density;
}

SkeletalDensity skeletal_density(const MeshSolid& solid, const GridNodes& nodes,
                                 const SkeletalDensityOptions& options) {
  check(options);
  return skeletal_density(solid, distance_grid(solid, nodes, {.threads = options.threads}),
                          options);
}

Eigen::VectorXcd skeletal_density_at(const MeshSolid& solid, const Eigen::Matrix3Xd& points,
                                     const SkeletalDensityOptions& options) {
  check(options);
  const Eigen::VectorXd distances =
      solid.signed_distance(points, std::numeric_limits<double>::infinity());
  const SkeletalKernel kernel = make_kernel(options.thickness, options.tolerance);
  Eigen::VectorXcd result(points.cols());
  constexpr Index kChunk = 64;
  parallel_for(static_cast<std::size_t>((points.cols() + kChunk - 1) / kChunk), options.threads,
               [&](std::size_t chunk, int) {
                 const Index begin = static_cast<Index>(chunk) * kChunk;
                 const Index count = std::min(kChunk, points.cols() - begin);
                 result.segment(begin, count) =
                     densities(solid, kernel, options, points.middleCols(begin, count),
                               distances.segment(begin, count));
               });
  return result;
}

}  // namespace mortise
