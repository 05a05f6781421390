// SPDX-License-Identifier: GPL-3.0-or-later
// Times the gap function's value and 6D gradient at one pose, on one thread.
//
//   taskset -c 0 build/release/bench/gap_bench --benchmark_filter=gap_wrench
//   --benchmark_repetitions=5
#include <benchmark/benchmark.h>

#include <random>
#include <vector>

#include "collision/bodies.hpp"
#include "mortise/collision/gap_function.hpp"

namespace {

using mortise::BodyDensity;
using mortise::GapFunction;
using mortise::RigidMotion;

BodyDensity body(unsigned seed, bool complex) {
  return mortise::density_of_knots(
      mortise::tests::random_knots(1000, 10.0, Eigen::Vector3d::Zero(), seed, complex));
}

std::vector<RigidMotion> poses() {
  std::mt19937_64 random(1);
  std::vector<RigidMotion> result;
  for (int i = 0; i < 256; ++i)
    result.push_back(mortise::tests::random_pose(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                                 18.0, random));
  return result;
}

// Argument: m', modes and their opposites counted as two. Two equal bodies, other poses each time.
void run(benchmark::State& state, bool complex, double oversampling) {
  const GapFunction gap(
      body(1, complex), body(2, complex),
      {.max_modes = static_cast<int>(state.range(0)), .oversampling = oversampling});
  const std::vector<RigidMotion> places = poses();
  std::size_t i = 0;
  for (auto step : state) {
    benchmark::DoNotOptimize(gap(places[i]));
    i = (i + 1) % places.size();
  }
  state.counters["ns_per_mode"] = benchmark::Counter(
      static_cast<double>(state.range(0)) * 1e-9,
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["spectrum_error"] = gap.interpolation_error();
}

void gap_wrench(benchmark::State& state) { run(state, false, 2.0); }
void gap_wrench_3x(benchmark::State& state) { run(state, false, 3.0); }
void gap_wrench_complex(benchmark::State& state) { run(state, true, 2.0); }

// 8192: strictly 4,096 pairs.
BENCHMARK(gap_wrench)
    ->RangeMultiplier(4)
    ->Range(256, 65536)
    ->Arg(8192)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(gap_wrench_3x)->Arg(4096)->Unit(benchmark::kMicrosecond);
BENCHMARK(gap_wrench_complex)->Arg(4096)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
