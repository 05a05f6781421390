// SPDX-License-Identifier: GPL-3.0-or-later
// Fourier sums over scattered points: knots per second, the whole NFFT against the bare FFTW time
// of its own grid, and the 4D NFFT against the direct sum. All on one thread.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <random>

#include "bench.hpp"
#include "mortise/fourier/direct_ndft.hpp"
#include "mortise/fourier/nfft.hpp"

namespace mortise {
namespace {

using bench::cpu_seconds;

// Least time of one call over many, which is what a cache-warm loop pays.
template <class Call>
double least_seconds(const Call& call, double budget) {
  double least = 1e30;
  const double begin = cpu_seconds();
  do {
    const double start = cpu_seconds();
    call();
    least = std::min(least, cpu_seconds() - start);
  } while (cpu_seconds() - begin < budget);
  return least;
}

// A globule: points at the density of heavy atoms in a protein (17 cubic angstrom each) in a ball,
// shuffled along a chain.
template <int D>
Eigen::Matrix<double, D, Eigen::Dynamic> globule(int count, double centre) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const double radius = std::cbrt(count * 17.0 * 3.0 / (4.0 * 3.14159265));
  Eigen::Matrix<double, D, Eigen::Dynamic> points(D, count);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d direction =
        Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
    points.col(i).template head<3>() =
        (direction * radius * std::cbrt(uniform(random))).array() + centre;
    if constexpr (D == 4) points(3, i) = 1.4 + 3.4 * uniform(random);
  }
  return points;
}

// Args: atoms, fine grid cells per axis, -log10 of the tolerance. Single precision, real weights:
// what docking uses.
void BM_NfftOfProtein(benchmark::State& state) {
  const int atoms = static_cast<int>(state.range(0)), fine = static_cast<int>(state.range(1));
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(2)));
  const double side = 2.0 * fine;  // 2 A grid
  Nfft3f plan({fine / 2, fine / 2, fine / 2}, {side, side, side},
              {.tolerance = tolerance,
               .weights = WeightKind::kReal,
               .upsampling = 2.0,
               .rigor = PlanRigor::kMeasure,
               .threads = 1});
  const auto& size = plan.fine_size();
  const Eigen::Matrix3Xd points = globule<3>(atoms, side / 2);
  const Eigen::VectorXf weights = Eigen::VectorXf::Ones(atoms);
  // The bare transform of the same grid, real to half-complex in place, planned as carefully.
  FftLayout layout = contiguous_layout({size[0], size[1], size[2]});
  const std::ptrdiff_t row = size[2] / 2 + 1;
  for (int d = 0; d < 2; ++d) {
    layout.transform[d].out_stride = d == 0 ? row * size[1] : row;
    layout.transform[d].in_stride = 2 * layout.transform[d].out_stride;
  }
  const auto fft = FftPlan<float>::real_to_complex(layout, true, PlanRigor::kMeasure);
  AlignedVector<std::complex<float>> grid(static_cast<std::size_t>(size[0] * size[1] * row));
  Spreader<3, float> spreader(size, {side, side, side}, plan.kernel(), WeightKind::kReal, 1);
  AlignedVector<float> cells(spreader.grid_size());
  double whole = 1e30, bare = 1e30, spread = 1e30;
  for (auto _ : state) {
    bare = std::min(
        bare,
        least_seconds([&] { fft.run(reinterpret_cast<float*>(grid.data()), grid.data()); }, 0.05));
    whole = std::min(
        whole,
        least_seconds([&] { benchmark::DoNotOptimize(plan.transform(points, weights).data()); },
                      0.05));
    spread = std::min(spread,
                      least_seconds([&] { spreader.spread(points, weights, cells.data()); }, 0.05));
    std::fill(grid.begin(), grid.end(), std::complex<float>(0));
  }
  state.counters["width"] = plan.kernel().width;
  state.counters["fine"] = size[0];
  state.counters["fft_us"] = bare * 1e6;
  state.counters["nfft_us"] = whole * 1e6;
  state.counters["spread_us"] = spread * 1e6;
  state.counters["ratio"] = whole / bare;
  state.counters["knots_per_s"] = atoms / whole;
  state.counters["spread_knots_per_s"] = atoms / spread;
}
BENCHMARK(BM_NfftOfProtein)
    ->ArgsProduct({{2000, 5000}, {48, 64}, {2, 3}})
    ->Iterations(4)
    ->Unit(benchmark::kMillisecond);

// Knots per second where there are many: 10^5 in double precision.
void BM_NfftThroughput3d(benchmark::State& state) {
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
  const Eigen::Matrix3Xd points = globule<3>(100000, 100.0);
  const Eigen::VectorXcd weights = Eigen::VectorXcd::Ones(points.cols());
  Nfft3 plan({64, 64, 64}, {200.0, 200.0, 200.0},
             {.tolerance = tolerance, .expected_points = points.cols(), .threads = 1});
  for (auto _ : state) benchmark::DoNotOptimize(plan.transform(points, weights).data());
  state.counters["width"] = plan.kernel().width;
  state.counters["fine"] = plan.fine_size()[0];
  state.counters["knots"] = benchmark::Counter(static_cast<double>(points.cols()),
                                               benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(BM_NfftThroughput3d)->Arg(3)->Arg(6)->Arg(9)->Arg(12)->Unit(benchmark::kMillisecond);

// 32^3 x 16 modes at 1e-6, complex weights, double precision: the NFFT, the direct sum and where
// they cross. Arg: knots.
void BM_Nfft4dAgainstDirectSum(benchmark::State& state) {
  const int count = static_cast<int>(state.range(0));
  const Eigen::Matrix4Xd points = globule<4>(count, 40.0);
  const Eigen::VectorXcd weights = Eigen::VectorXcd::Ones(count);
  const std::array<int, 4> modes{32, 32, 32, 16};
  const std::array<double, 4> box{160.0, 160.0, 160.0, 8.5};
  Nfft4 plan(
      modes, box,
      {.tolerance = 1e-6, .expected_points = count, .rigor = PlanRigor::kMeasure, .threads = 1});
  double fast = 1e30, slow = 1e30;
  for (auto _ : state) {
    fast = std::min(
        fast, least_seconds(
                  [&] { benchmark::DoNotOptimize(plan.transform(points, weights).data()); }, 0.1));
    slow = std::min(
        slow,
        least_seconds(
            [&] { benchmark::DoNotOptimize(direct_ndft(points, weights, modes, box, 1).data()); },
            0.0));
  }
  state.counters["width"] = plan.kernel().width;
  state.counters["fine"] = plan.fine_size()[0];
  state.counters["nfft_ms"] = fast * 1e3;
  state.counters["direct_ms"] = slow * 1e3;
  state.counters["speedup"] = slow / fast;
}
BENCHMARK(BM_Nfft4dAgainstDirectSum)
    ->Arg(16)
    ->Arg(32)
    ->Arg(64)
    ->Arg(100)
    ->Arg(1000)
    ->Arg(10000)
    ->Iterations(2)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace mortise

BENCHMARK_MAIN();
