// SPDX-License-Identifier: GPL-3.0-or-later
// Collision answers and queries per second beside FCL, on the same meshes and the same poses near
// contact, for growing numbers of triangles. One thread. A table on stdout.
//
//   fcl_compare [--poses 10000] [--triangles 1000,4000,...] [--grid 64]
#include <fcl/fcl.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "bench.hpp"
#include "collision/bodies.hpp"
#include "mortise/collision/collider.hpp"
#include "mortise/parts/mesh_solid.hpp"
#include "parts/shapes.hpp"

namespace {

using Model = fcl::BVHModel<fcl::OBBRSSd>;

// Everything timed runs on one thread.
using mortise::bench::cpu_seconds;

std::shared_ptr<Model> fcl_model(const mortise::TriangleMesh& mesh) {
  auto model = std::make_shared<Model>();
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;
  for (Eigen::Index i = 0; i < mesh.vertices.cols(); ++i)
    vertices.emplace_back(mesh.vertices.col(i));
  for (Eigen::Index i = 0; i < mesh.size(); ++i)
    triangles.emplace_back(mesh.triangles(0, i), mesh.triangles(1, i), mesh.triangles(2, i));
  model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
  model->addSubModel(vertices, triangles);
  model->endModel();
  return model;
}

fcl::Transform3d transform(const mortise::RigidMotion& pose) {
  fcl::Transform3d result = fcl::Transform3d::Identity();
  result.linear() = pose.rotation.toRotationMatrix();
  result.translation() = pose.translation;
  return result;
}

// Surfaces that touch, or one body inside the other: what FCL says of surfaces is no more than the
// first.
bool fcl_collides(const Model& a, const Model& b, const mortise::RigidMotion& pose) {
  const fcl::CollisionRequestd request;
  fcl::CollisionResultd result;
  return fcl::collide(&a, fcl::Transform3d::Identity(), &b, transform(pose), request, result) > 0;
}

// Random directions and turns; along each the moving body is brought from afar to where the answers
// of FCL change (bisection), then moved by up to `spread` to either side.
std::vector<mortise::RigidMotion> near_contact(const Model& a, const Model& b, int count,
                                               double reach, double spread) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<mortise::RigidMotion> poses;
  while (static_cast<int>(poses.size()) < count) {
    mortise::RigidMotion pose{mortise::tests::random_rotation(random), Eigen::Vector3d::Zero()};
    Eigen::Vector3d direction;
    do direction << uniform(random), uniform(random), uniform(random);
    while (direction.norm() > 1.0 || direction.norm() < 0.1);
    direction.normalize();
    double near = 0.5 * reach, far = 1.2 * reach;
    pose.translation = near * direction;
    if (!fcl_collides(a, b, pose)) continue;
    for (int step = 0; step < 12; ++step) {
      const double middle = 0.5 * (near + far);
      pose.translation = middle * direction;
      (fcl_collides(a, b, pose) ? near : far) = middle;
    }
    pose.translation = (near + spread * uniform(random)) * direction;
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace

int main(int argc, char** argv) {
  int count = 10000, grid = 64;
  std::vector<int> sizes = {1000, 4000, 16000, 64000, 256000, 400000};
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--poses") == 0) count = std::atoi(argv[i + 1]);
    if (std::strcmp(argv[i], "--grid") == 0) grid = std::atoi(argv[i + 1]);
    if (std::strcmp(argv[i], "--triangles") == 0) {
      sizes.clear();
      for (char* at = argv[i + 1]; *at != '\0'; at += *at == ',' ? 1 : 0)
        sizes.push_back(static_cast<int>(std::strtol(at, &at, 10)));
    }
  }
  std::printf(
      "triangles  FCL q/s  trees q/s  with gap q/s   sum q/s   yes    no  band  wrong  by sum  "
      "balls  "
      "band/diameter\n");
  for (const int size : sizes) {
    const mortise::TriangleMesh fixed = mortise::shapes::noisy_sphere(1.0, size, 0.15, 1),
                                moving = mortise::shapes::noisy_sphere(0.8, size, 0.15, 2);
    const std::shared_ptr<Model> a = fcl_model(fixed), b = fcl_model(moving);
    const std::vector<mortise::RigidMotion> poses = near_contact(*a, *b, count, 2.2, 0.1);

    std::vector<char> truth(poses.size());
    double start = cpu_seconds();
    for (std::size_t i = 0; i < poses.size(); ++i)
      truth[i] = fcl_collides(*a, *b, poses[i]) ? 1 : 0;
    const double fcl_seconds = cpu_seconds() - start;

    const mortise::CollisionBody fixed_body = mortise::collision_body(mortise::MeshSolid(fixed),
                                                                      {.grid = grid}),
                                 moving_body = mortise::collision_body(mortise::MeshSolid(moving),
                                                                       {.grid = grid});
    const mortise::Collider trees(fixed_body, moving_body),
        gaps(fixed_body, moving_body, {.with_gap = true});
    std::vector<mortise::Collision> answers(poses.size());
    start = cpu_seconds();
    trees.evaluate(poses, answers, 1);
    const double tree_seconds = cpu_seconds() - start;
    start = cpu_seconds();
    gaps.evaluate(poses, answers, 1);
    const double gap_seconds = cpu_seconds() - start;
    std::vector<mortise::GapValue> values(poses.size());
    start = cpu_seconds();
    gaps.gap_function().evaluate(poses, values, 0, 1);
    const double sum_seconds = cpu_seconds() - start;

    int yes = 0, no = 0, band = 0, wrong = 0, by_sum = 0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const mortise::Contact contact = answers[i].contact;
      yes += contact == mortise::Contact::kYes ? 1 : 0;
      no += contact == mortise::Contact::kNo ? 1 : 0;
      band += contact == mortise::Contact::kBand ? 1 : 0;
      by_sum += answers[i].by == mortise::DecidedBy::kSum ? 1 : 0;
      wrong += (contact == mortise::Contact::kYes && truth[i] == 0) ||
                       (contact == mortise::Contact::kNo && truth[i] != 0)
                   ? 1
                   : 0;
    }
    const double n = static_cast<double>(poses.size());
    std::printf("%9ld %8.0f %10.0f %13.0f %9.0f %5d %5d %5d %6d %7d %6ld %14.4f\n",
                static_cast<long>(fixed.size()), n / fcl_seconds, n / tree_seconds, n / gap_seconds,
                n / sum_seconds, yes, no, band, wrong, by_sum,
                static_cast<long>(fixed_body.balls.size()), trees.tree_band() / 2.0);
    std::fflush(stdout);
  }
}
