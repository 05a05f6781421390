// SPDX-License-Identifier: GPL-3.0-or-later
// Time to cluster poses of a body that touches another, by ligand and by interface RMSD.
#include <benchmark/benchmark.h>

#include <random>
#include <vector>

#include "mortise/poses/cluster.hpp"
#include "search/sample_bodies.hpp"

namespace mortise {
namespace {

struct Setup {
  Eigen::Matrix3Xd fixed, moving;
  std::vector<RigidMotion> poses;
};

// Poses all over the fixed body, as a docking run leaves them: hardly any near another.
Setup make_setup(int count) {
  std::mt19937 random(1);
  Setup out;
  out.fixed =
      sample_bodies::ellipsoid(random, 1000, {30, 24, 22}, {0, 0, 0}, {1}).points.topRows<3>();
  out.moving =
      sample_bodies::ellipsoid(random, 600, {20, 18, 16}, {0, 0, 0}, {1}).points.topRows<3>();
  for (int i = 0; i < count; ++i) {
    out.poses.push_back(sample_bodies::random_motion(random, 1.0));
    Eigen::Vector3d& t = out.poses.back().translation;
    t = 42.0 * t.normalized();
  }
  return out;
}

void by_ligand_rmsd(benchmark::State& state) {
  const Setup setup = make_setup(static_cast<int>(state.range(0)));
  Clusters clusters;
  for (auto _ : state)
    clusters =
        cluster_poses(setup.poses, setup.moving, {.radius = static_cast<double>(state.range(1))});
  state.counters["clusters"] = static_cast<double>(clusters.founders.size());
}
BENCHMARK(by_ligand_rmsd)->ArgsProduct({{10000, 100000}, {3, 10}})->Unit(benchmark::kMillisecond);

void by_interface_rmsd(benchmark::State& state) {
  const Setup setup = make_setup(static_cast<int>(state.range(0)));
  Clusters clusters;
  for (auto _ : state)
    clusters = cluster_poses_by_interface(setup.poses, setup.fixed, setup.moving,
                                          {.radius = static_cast<double>(state.range(1))});
  state.counters["clusters"] = static_cast<double>(clusters.founders.size());
}
BENCHMARK(by_interface_rmsd)->ArgsProduct({{10000}, {3, 10}})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace mortise

BENCHMARK_MAIN();
