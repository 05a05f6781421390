// SPDX-License-Identifier: GPL-3.0-or-later
// Minkowski sums of knots against uniform sampling of the same resolution [SD, Fig. 6]: memory and
// time. CSV on stdout.
//
//   minkowski_bench GRID=a.h5,b.h5...   knots of two bodies decomposed on GRID nodes per axis
//   minkowski_bench N1xN2...            random knots, for the speed alone
//
// Uniform sampling: the nodes inside each body, their pairwise sums (measured where they fit into
// 2 GB, else their memory alone), and the correlation of the two grids by FFT.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <random>
#include <string>

#include "bench.hpp"
#include "mortise/collision/minkowski.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/fourier/aligned.hpp"
#include "mortise/fourier/fft_plan.hpp"
#include "mortise/store/knots_file.hpp"

namespace mortise {
namespace {

constexpr double kMegabyte = 1e6;

template <class F>
double least_ms(int repetitions, const F& f) {
  double best = 1e30;
  for (int i = 0; i < repetitions; ++i) {
    const auto start = std::chrono::steady_clock::now();
    f();
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    best = std::min(best, took.count());
  }
  return best;
}

// Nodes of an n^3 grid over a cube of the given side about the middle that lie in a ball.
Eigen::Matrix4Xd nodes_inside(const Eigen::Matrix4Xd& balls, int n) {
  const Eigen::RowVectorXd r = balls.row(3);
  const Eigen::Vector3d low = (balls.topRows<3>().rowwise() - r).rowwise().minCoeff();
  const Eigen::Vector3d high = (balls.topRows<3>().rowwise() + r).rowwise().maxCoeff();
  const double h = (high - low).maxCoeff() / n;
  std::vector<char> in(static_cast<std::size_t>(n) * n * n, 0);
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < balls.cols(); ++i) {
    const Eigen::Vector3d c = (balls.col(i).head<3>() - low) / h;
    const double radius = balls(3, i) / h;
    const auto first = [&](int d) {
      return std::max(0, static_cast<int>(std::ceil(c[d] - radius)));
    };
    const auto last = [&](int d) { return std::min(n - 1, static_cast<int>(c[d] + radius)); };
    for (int x = first(0); x <= last(0); ++x)
      for (int y = first(1); y <= last(1); ++y)
        for (int z = first(2); z <= last(2); ++z) {
          if ((Eigen::Vector3d(x, y, z) - c).squaredNorm() > radius * radius) continue;
          char& cell = in[(static_cast<std::size_t>(x) * n + y) * n + z];
          count += cell == 0 ? 1 : 0;
          cell = 1;
        }
  }
  Eigen::Matrix4Xd result(4, count);
  Eigen::Index at = 0;
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y)
      for (int z = 0; z < n; ++z)
        if (in[(static_cast<std::size_t>(x) * n + y) * n + z] != 0)
          result.col(at++) << low + h * Eigen::Vector3d(x, y, z), 0.5 * h;
  return result;
}

// One correlation of two real n^3 grids: two transforms there, one back.
double fft_ms(int n) {
  const std::ptrdiff_t nc = n / 2 + 1;
  const auto forward = FftPlan<float>::real_to_complex(
      {{{n, std::ptrdiff_t{n} * n, n * nc}, {n, n, nc}, {n, 1, 1}}, {}}, false,
      PlanRigor::kMeasure);
  const auto backward = FftPlan<float>::complex_to_real(
      {{{n, n * nc, std::ptrdiff_t{n} * n}, {n, nc, n}, {n, 1, 1}}, {}}, false,
      PlanRigor::kMeasure);
  AlignedVector<float> real(static_cast<std::size_t>(n) * n * n, 1.0F);
  AlignedVector<std::complex<float>> a(static_cast<std::size_t>(n) * n * nc), b(a.size());
  return least_ms(3, [&] {
    forward.run(real.data(), a.data());
    forward.run(real.data(), b.data());
    for (std::size_t i = 0; i < a.size(); ++i) a[i] *= std::conj(b[i]);
    backward.run(a.data(), real.data());
  });
}

void row(int grid, const Eigen::Matrix4Xd& a, const Eigen::Matrix4Xd& b) {
  const auto pairs = static_cast<double>(a.cols()) * static_cast<double>(b.cols());
  const double ms = least_ms(5, [&] { (void)minkowski_sum(a, b); });
  Balls sum = minkowski_sum(a, b);
  Eigen::Index kept = 0;
  const double reduce_ms = least_ms(1, [&] { kept = without_contained(sum).cols(); });
  // The same bytes written by nothing but a fill: the limit of memory.
  const double fill_ms = least_ms(5, [&] { (void)Balls::Constant(4, sum.cols(), 1.0F).eval(); });
  std::printf("%d,%td,%td,%.0f,%.2f,%.2f,%.2f,%td,%.2f", grid, a.cols(), b.cols(), pairs, ms,
              16.0 * pairs / kMegabyte, fill_ms, kept, reduce_ms);
  if (grid > 0) {
    const Eigen::Matrix4Xd ua = nodes_inside(a, grid);
    const Eigen::Matrix4Xd ub = nodes_inside(b, grid);
    const double uniform_pairs = static_cast<double>(ua.cols()) * static_cast<double>(ub.cols());
    double uniform_ms = -1.0;
    if (12.0 * uniform_pairs < 2e9) uniform_ms = least_ms(1, [&] { (void)minkowski_sum(ua, ub); });
    const double cells = std::pow(2.0 * grid, 3);
    std::printf(",%td,%td,%.1f,%.2f,%.2f,%.1f", ua.cols(), ub.cols(),
                12.0 * uniform_pairs / kMegabyte, uniform_ms, fft_ms(2 * grid),
                2.0 * 4.0 * cells / kMegabyte);
  } else {
    std::printf(",,,,,,");
  }
  std::printf("\n");
}

Eigen::Matrix4Xd random_knots(int n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::Matrix4Xd result(4, n);
  for (int i = 0; i < n; ++i)
    result.col(i) << uniform(random), uniform(random), uniform(random),
        0.02 + 0.1 * std::abs(uniform(random));
  return result;
}

}  // namespace
}  // namespace mortise

int main(int argc, char** argv) {
  return mortise::bench::bench_main("minkowski_bench", argc, argv, [](const auto& items) {
    if (items.empty())
      throw mortise::InputError("usage: minkowski_bench GRID=a.h5,b.h5... | N1xN2...");
    std::printf(
        "grid,knots_a,knots_b,pairs,ms,mb,fill_ms,kept,reduce_ms,nodes_a,nodes_b,uniform_mb,"
        "uniform_ms,"
        "fft_ms,fft_mb\n");
    for (const std::string& item : items) {
      const auto sign = item.find('=');
      const auto comma = item.find(',');
      const auto times = item.find('x');
      if (sign != std::string::npos && comma != std::string::npos && comma > sign)
        mortise::row(std::stoi(item.substr(0, sign)),
                     mortise::read_knots_file(item.substr(sign + 1, comma - sign - 1)).knots.points,
                     mortise::read_knots_file(item.substr(comma + 1)).knots.points);
      else if (times != std::string::npos)
        mortise::row(0, mortise::random_knots(std::stoi(item.substr(0, times)), 1),
                     mortise::random_knots(std::stoi(item.substr(times + 1)), 2));
      else
        throw mortise::InputError("expected GRID=a.h5,b.h5 or N1xN2, found " + item);
    }
  });
}
