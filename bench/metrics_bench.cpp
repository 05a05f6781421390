// SPDX-License-Identifier: GPL-3.0-or-later
// Time to measure one pose: against a reference complex, and against another pose.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <vector>

#include "helpers/random_motions.hpp"
#include "metrics/bodies.hpp"
#include "mortise/core/pose_distance.hpp"
#include "mortise/metrics/reference_complex.hpp"

namespace mortise {
namespace {

// Two made-up proteins of range(0) and range(1) residues in touch, and poses that roll one over the
// other.
struct Setup {
  ReferenceComplex complex;
  std::vector<RigidMotion> poses;
};

Setup make_setup(int fixed_size, int moving_size) {
  std::mt19937 random(1);
  const double distance = 3.0 * (std::cbrt(fixed_size) + std::cbrt(moving_size));
  const Molecule fixed = testing_bodies::random_protein(random, "A", fixed_size, {0, 0, 0});
  const Molecule moving = testing_bodies::random_protein(random, "B", moving_size, {0, 0, 0});
  const RigidMotion place{Eigen::Quaterniond::Identity(), {distance, 0, 0}};
  Setup out{ReferenceComplex(fixed, moving, fixed, testing_bodies::moved(place, moving)), {}};
  for (int i = 0; i < 1000; ++i) {
    const RigidMotion turn = tests::random_turn(random, 0.003 * i, 0.0);
    const RigidMotion roll = tests::random_turn(random, 0.003 * i, 0.0);
    out.poses.push_back(compose(roll, compose(place, turn)));
  }
  return out;
}

void evaluate_pose(benchmark::State& state) {
  const Setup setup =
      make_setup(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  std::size_t i = 0;
  double sum = 0.0;
  for (auto _ : state) sum += setup.complex.evaluate(setup.poses[i++ % setup.poses.size()]).dockq;
  benchmark::DoNotOptimize(sum);
}
BENCHMARK(evaluate_pose)->Args({150, 80})->Args({300, 200})->Args({800, 300});

void build_reference(benchmark::State& state) {
  for (auto _ : state)
    benchmark::DoNotOptimize(
        make_setup(static_cast<int>(state.range(0)), static_cast<int>(state.range(1))));
}
BENCHMARK(build_reference)->Args({300, 200})->Unit(benchmark::kMillisecond);

void pose_distance(benchmark::State& state) {
  const Setup setup = make_setup(150, 80);
  const PoseDistance distance(20.0 * Eigen::Matrix3Xd::Random(3, 1000));
  std::size_t i = 0;
  double sum = 0.0;
  for (auto _ : state) {
    ++i;
    sum += distance.mean_square(setup.poses[i % 1000], setup.poses[(7 * i) % 1000]);
  }
  benchmark::DoNotOptimize(sum);
}
BENCHMARK(pose_distance);

}  // namespace
}  // namespace mortise

BENCHMARK_MAIN();
