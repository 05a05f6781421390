// SPDX-License-Identifier: GPL-3.0-or-later
// Data of the figure that compares two ways to the spectrum of a union of balls [SD, Fig. 8]:
// rasterise the bumps on a uniform grid and take a 3D FFT, or sum over the 4D knots. CSV on stdout.
//
//   spectrum_data GRID=knots.h5...      the knots of one body decomposed on GRID nodes per axis
//
// One thread, CPU seconds; each time is the least of several calls. Sums to a tolerance of 1e-3,
// with the product by the kernel's spectrum; plans and that spectrum are ready before, as the FFT's
// plan is. -1: not tried, for its time or memory.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "../bench.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/fourier/aligned.hpp"
#include "mortise/fourier/direct_ndft.hpp"
#include "mortise/fourier/fft_plan.hpp"
#include "mortise/fourier/nfft.hpp"
#include "mortise/kernels/bump.hpp"
#include "mortise/kernels/compressed_radius.hpp"
#include "mortise/kernels/cone.hpp"
#include "mortise/store/knots_file.hpp"

namespace mortise {
namespace {

constexpr double kAlpha = 2.0;

using bench::cpu_seconds;

template <class F>
double least_seconds(const F& f) {
  double best = 1e30, spent = 0.0;
  for (int i = 0; i < 100 && (i < 3 || spent < 0.05) && spent < 5.0; ++i) {
    const double start = cpu_seconds();
    f();
    const double took = cpu_seconds() - start;
    best = std::min(best, took);
    spent += took;
  }
  return best;
}

double box_side(const Knots& knots) {
  const Eigen::RowVectorXd radii = knots.points.row(3);
  const Eigen::Vector3d low = (knots.points.topRows<3>().rowwise() - radii).rowwise().minCoeff();
  const Eigen::Vector3d high = (knots.points.topRows<3>().rowwise() + radii).rowwise().maxCoeff();
  return 2.0 * (high - low).maxCoeff();  // room for an obstacle of two such bodies
}

// Sum of bumps at the nodes of an n^3 grid; a table of the bump stands in for its exponential.
void rasterise(const Knots& knots, double side, int n, AlignedVector<float>& grid) {
  constexpr int kTable = 1024;
  static const std::vector<float> table = [] {
    std::vector<float> t(kTable + 2, 0.0F);
    for (int i = 0; i <= kTable; ++i)
      t[static_cast<std::size_t>(i)] =
          static_cast<float>(bump(std::sqrt(static_cast<double>(i) / kTable), kAlpha));
    return t;
  }();
  std::fill(grid.begin(), grid.end(), 0.0F);
  const double h = side / n;
  const Eigen::Vector3d low = knots.points.topRows<3>().rowwise().minCoeff();
  for (Eigen::Index i = 0; i < knots.size(); ++i) {
    const Eigen::Vector3d c =
        (knots.points.col(i).head<3>() - low) / h + Eigen::Vector3d::Constant(0.25 * n);
    const double r = knots.points(3, i) / h;
    const auto from = [&](int d) { return std::max(0, static_cast<int>(std::ceil(c[d] - r))); };
    const auto to = [&](int d) { return std::min(n - 1, static_cast<int>(std::floor(c[d] + r))); };
    for (int x = from(0); x <= to(0); ++x)
      for (int y = from(1); y <= to(1); ++y) {
        const double rest = (x - c[0]) * (x - c[0]) + (y - c[1]) * (y - c[1]);
        float* row = &grid[(static_cast<std::size_t>(x) * n + y) * n];
        for (int z = from(2); z <= to(2); ++z) {
          const double u = (rest + (z - c[2]) * (z - c[2])) / (r * r);
          if (u < 1.0) row[z] += table[static_cast<std::size_t>(u * kTable)];
        }
      }
  }
}

// One spectrum of modes^3 frequencies, by each of the three sums.
class Sums {
 public:
  Sums(const Knots& knots, double side, int modes)
      : knots_(knots), side_(side), modes_(modes), largest_(0.87 * modes / side) {}

  double direct4d() {
    const ConeSeries cone = fitted();
    const Eigen::MatrixXcd factors = cone_factors(cone);
    return least_seconds([&] {
      const Eigen::VectorXcd sums =
          direct_ndft(knots_.points, knots_.weights, {modes_, modes_, modes_, cone.modes()},
                      {side_, side_, side_, cone.period()}, 1);
      keep((sums.reshaped(factors.rows(), factors.cols()).array() * factors.array())
               .colwise()
               .sum()
               .matrix(),
           modes_, modes_ / 2);
    });
  }

  double nfft4d() {
    const ConeSeries cone = fitted();
    const Eigen::MatrixXcf factors = cone_factors(cone).cast<std::complex<float>>();
    const Eigen::VectorXcf weights = knots_.weights.cast<std::complex<float>>();
    Nfft4f plan({modes_, modes_, modes_, cone.modes()}, {side_, side_, side_, cone.period()},
                {.tolerance = kTolerance, .expected_points = knots_.size(), .threads = 1});
    return least_seconds([&] {
      const auto sums = plan.transform(knots_.points, weights);
      const Eigen::Map<const Eigen::MatrixXcf> table(sums.data(), factors.rows(), factors.cols());
      keep((table.array() * factors.array()).colwise().sum().matrix(), modes_, modes_ / 2);
    });
  }

  double compressed() {
    const auto [least, most] = radii();
    const CompressedRadius kernel = compress_radius(transform_of(RadialKernel(kAlpha)), largest_,
                                                    least, most, {.tolerance = kKernelError});
    Eigen::MatrixXf b(knots_.size(), kernel.terms());
    for (Eigen::Index i = 0; i < knots_.size(); ++i)
      b.row(i) = knots_.weights[i].real() *
                 kernel.radius_factors(knots_.points(3, i)).transpose().cast<float>();
    Nfft3f plan({modes_, modes_, modes_}, {side_, side_, side_},
                {.tolerance = kTolerance,
                 .weights = WeightKind::kReal,
                 .expected_points = knots_.size(),
                 .threads = 1});
    const Eigen::Index half = modes_ / 2 + 1;
    Eigen::MatrixXf a(Eigen::Index{modes_} * modes_ * half, kernel.terms());
    for (Eigen::Index i = 0; i < a.rows(); ++i)
      a.row(i) = kernel.frequency_factors(std::min(largest_, length(i, half, 0)))
                     .transpose()
                     .cast<float>();
    return least_seconds([&] {
      Eigen::RowVectorXcf result = Eigen::RowVectorXcf::Zero(a.rows());
      for (int q = 0; q < kernel.terms(); ++q) {
        const auto sums = plan.transform(knots_.points.topRows<3>(), b.col(q));
        result.array() += Eigen::Map<const Eigen::RowVectorXcf>(sums.data(), a.rows()).array() *
                          a.col(q).transpose().array();
      }
      keep(result, half, 0);
    });
  }

 private:
  static constexpr double kTolerance = 1e-3, kKernelError = 5e-5;

  std::pair<double, double> radii() const {
    return {knots_.points.row(3).minCoeff(), knots_.points.row(3).maxCoeff()};
  }
  ConeSeries fitted() const {
    const auto [least, most] = radii();
    return fitted_cone(transform_of(RadialKernel(kAlpha)), largest_, least, most, kKernelError);
  }
  // |w| of mode i, first axis slowest; the last axis has `last` modes from -`below` on.
  double length(Eigen::Index i, Eigen::Index last, Eigen::Index below) const {
    const Eigen::Index z = i % last - below, y = i / last % modes_ - modes_ / 2,
                       x = i / last / modes_ - modes_ / 2;
    return std::sqrt(static_cast<double>(x * x + y * y + z * z)) / side_;
  }
  Eigen::MatrixXcd cone_factors(const ConeSeries& cone) const {
    Eigen::MatrixXcd factors(cone.modes(), Eigen::Index{modes_} * modes_ * modes_);
    for (Eigen::Index i = 0; i < factors.cols(); ++i)
      factors.col(i) = cone.coefficients(length(i, modes_, modes_ / 2));
    return factors;
  }
  // Looks at frequency (1, 0, 0), which all three must give alike.
  template <class Row>
  void keep(const Row& row, Eigen::Index last, Eigen::Index zero) {
    const Eigen::Index n = modes_, h = n / 2;
    const double size = static_cast<double>(std::abs(row[((h + 1) * n + h) * last + zero]));
    if (seen_ > 0.0 && std::abs(size - seen_) > 5e-3 * seen_)
      throw InputError("the sums disagree: " + std::to_string(size) + " and " +
                       std::to_string(seen_));
    seen_ = size;
  }

  const Knots& knots_;
  double side_;
  int modes_;
  double largest_;  // |w|: half the cube's diagonal and a little more
  double seen_ = 0.0;
};

void compare(int n, const Knots& knots) {
  const double side = box_side(knots);
  const auto cells = static_cast<std::size_t>(n) * n * n;
  AlignedVector<float> grid(cells);
  AlignedVector<std::complex<float>> half(static_cast<std::size_t>(n) * n * (n / 2 + 1));
  const std::ptrdiff_t nc = n / 2 + 1;
  const auto plan = FftPlan<float>::real_to_complex(
      {{{n, std::ptrdiff_t{n} * n, n * nc}, {n, n, nc}, {n, 1, 1}}, {}}, false,
      PlanRigor::kMeasure);
  const double raster = least_seconds([&] { rasterise(knots, side, n, grid); });
  const double fft = least_seconds([&] { plan.run(grid.data(), half.data()); });
  for (int modes = 4; modes <= n; modes *= 2) {
    Sums sums(knots, side, modes);
    const double terms = static_cast<double>(knots.size()) * std::pow(modes, 3.0);
    const double direct = terms < 3e7 ? sums.direct4d() : -1.0;
    const double nfft = modes <= 32 ? sums.nfft4d() : -1.0;
    std::printf("%d,%td,%d,%.7f,%.7f,%.7f,%.7f,%.7f\n", n, knots.size(), modes, raster, fft, direct,
                nfft, sums.compressed());
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace mortise

int main(int argc, char** argv) {
  return mortise::bench::bench_main("spectrum_data", argc, argv, [](const auto& items) {
    if (items.empty()) throw mortise::InputError("usage: spectrum_data GRID=knots.h5...");
    std::printf("grid,knots,modes,raster,fft,ndft4d,nfft4d,compressed\n");
    for (const std::string& item : items) {
      const auto sign = item.find('=');
      if (sign == std::string::npos) throw mortise::InputError("expected GRID=FILE, found " + item);
      mortise::compare(std::stoi(item.substr(0, sign)),
                       mortise::read_knots_file(item.substr(sign + 1)).knots);
    }
  });
}
