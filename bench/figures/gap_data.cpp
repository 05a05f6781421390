// SPDX-License-Identifier: GPL-3.0-or-later
// Data of the gap function's figures: values, gradients and terms to reject over a plane of
// translations [FC, Fig. 5; SD, Fig. 7] and the time of a query against the modes [SD, Fig. 9]. CSV
// on stdout.
//
//   gap_data plane | time
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <numbers>
#include <vector>

#include "collision/bodies.hpp"
#include "mortise/collision/gap_function.hpp"

namespace {

using mortise::BodyDensity;
using mortise::GapFunction;
using mortise::Knots;
using mortise::RigidMotion;

Knots balls(const std::vector<Eigen::Vector4d>& list) {
  Knots knots{Eigen::Matrix4Xd(4, static_cast<Eigen::Index>(list.size())),
              Eigen::VectorXcd::Ones(static_cast<Eigen::Index>(list.size()))};
  for (std::size_t i = 0; i < list.size(); ++i)
    knots.points.col(static_cast<Eigen::Index>(i)) = list[i];
  return knots;
}

// Three quarters of a ring, and a bent rod that fits into its mouth.
BodyDensity ring() {
  std::vector<Eigen::Vector4d> list;
  for (int i = 0; i <= 36; ++i) {
    const double a = std::numbers::pi * (0.25 + 1.5 * i / 36.0);
    list.emplace_back(3.0 * std::cos(a), 3.0 * std::sin(a), 0.0, 0.7);
  }
  return mortise::density_of_knots(balls(list));
}

BodyDensity rod() {
  std::vector<Eigen::Vector4d> list;
  for (int i = 0; i <= 12; ++i) list.emplace_back(0.25 * i - 1.5, 0.0, 0.0, 0.5);
  for (int i = 1; i <= 6; ++i) list.emplace_back(1.5, 0.25 * i, 0.0, 0.5);
  return mortise::density_of_knots(balls(list));
}

void plane() {
  const double threshold = 0.5;
  std::printf("# threshold %g\nmodes,x,y,value,gx,gy,rejected,terms,reference\n", threshold);
  std::vector<RigidMotion> poses;
  for (double x = -6.5; x <= 6.5; x += 0.13)
    for (double y = -6.5; y <= 6.5; y += 0.13)
      poses.push_back({Eigen::Quaterniond::Identity(), {x, y, 0.0}});
  std::vector<mortise::GapValue> reference(poses.size()), values(poses.size());
  GapFunction(ring(), rod(), {.max_modes = 262144}).evaluate(poses, reference);
  for (const int modes : {64, 512, 4096, 32768}) {
    const GapFunction gap(ring(), rod(), {.max_modes = modes, .oversampling = 4.0});
    gap.evaluate(poses, values);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const mortise::GapValue& v = values[i];
      const GapFunction::Rejection r = gap.reject(poses[i], threshold);
      std::printf("%d,%.3f,%.3f,%.5g,%.5g,%.5g,%d,%d,%.5g\n", modes, poses[i].translation[0],
                  poses[i].translation[1], v.value, v.translation_gradient[0],
                  v.translation_gradient[1], r.rejected ? 1 : 0, r.modes, reference[i].value);
    }
  }
}

void time_queries() {
  std::printf("modes,microseconds,value_only_microseconds\n");
  std::mt19937_64 random(1);
  std::vector<RigidMotion> poses;
  for (int i = 0; i < 64; ++i)
    poses.push_back(mortise::tests::random_pose({0, 0, 0}, {0, 0, 0}, 2.0, random));
  for (int modes = 64; modes <= 262144; modes *= 2) {
    const GapFunction gap(ring(), rod(), {.max_modes = modes});
    const auto fastest = [&](const auto& query) {
      double best = 1e300;
      for (int round = 0; round < 5; ++round) {
        const std::clock_t start = std::clock();  // the machine may be busy
        for (const RigidMotion& pose : poses) query(pose);
        best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
      }
      return 1e6 * best / static_cast<double>(poses.size());
    };
    double sum = 0.0;  // keeps the work from being dropped
    const double whole = fastest([&](const RigidMotion& pose) { sum += gap(pose).value; });
    // No bound ever falls below this threshold: all modes, the value alone.
    const double value =
        fastest([&](const RigidMotion& pose) { sum += gap.reject(pose, -1e300).bound; });
    std::printf("%d,%.3f,%.3f\n", modes, whole, value);
    if (!std::isfinite(sum)) std::printf("# not finite\n");
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::strcmp(argv[1], "plane") == 0) {
    plane();
    return 0;
  }
  if (argc == 2 && std::strcmp(argv[1], "time") == 0) {
    time_queries();
    return 0;
  }
  std::fprintf(stderr, "usage: gap_data plane | time\n");
  return 1;
}
