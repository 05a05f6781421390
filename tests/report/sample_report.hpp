// SPDX-License-Identifier: GPL-3.0-or-later
// Runs made by hand over the sample molecules and over two simple parts, for the tests of reports.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "mortise/core/pose_distance.hpp"
#include "mortise/molecules/radii.hpp"
#include "mortise/molecules/read_molecule.hpp"
#include "mortise/report/bodies.hpp"
#include "mortise/store/run_file.hpp"
#include "store/sample_run.hpp"

namespace mortise::testing {

inline std::string sample_molecule(const std::string& name) {
  return std::string(MORTISE_SOURCE_DIR) + "/molecules/" + name;
}

/// The two chains of HIV protease.
inline ReportBodies protease() {
  ReportBodies bodies;
  bodies.fixed.found = sample_molecule("1hpv_receptor.pdb");
  bodies.moving.found = sample_molecule("1hpv_ligand.pdb");
  bodies.fixed.molecule = read_molecule({bodies.fixed.found}).molecule;
  bodies.moving.molecule = read_molecule({bodies.moving.found}).molecule;
  return bodies;
}

/// A prism over the outline in the x-y plane, z from `low` to `high`; the outline runs
/// counter-clockwise and is star-shaped about `centre`.
inline void add_prism(TriangleMesh& mesh, const Eigen::Matrix2Xd& outline, double low,
                      double high) {
  const auto n = static_cast<int>(outline.cols());
  const auto first = static_cast<int>(mesh.vertices.cols());
  mesh.vertices.conservativeResize(3, first + 2 * n + 2);
  for (int i = 0; i < n; ++i) {
    mesh.vertices.col(first + i) << outline.col(i), low;
    mesh.vertices.col(first + n + i) << outline.col(i), high;
  }
  const Eigen::Vector2d centre = outline.rowwise().mean();
  mesh.vertices.col(first + 2 * n) << centre, low;
  mesh.vertices.col(first + 2 * n + 1) << centre, high;
  auto t = static_cast<int>(mesh.triangles.cols());
  mesh.triangles.conservativeResize(3, t + 4 * n);
  for (int i = 0; i < n; ++i) {
    const int a = first + i;
    const int b = first + (i + 1) % n;
    mesh.triangles.col(t++) << a, b, b + n;
    mesh.triangles.col(t++) << a, b + n, a + n;
    mesh.triangles.col(t++) << b, a, first + 2 * n;
    mesh.triangles.col(t++) << a + n, b + n, first + 2 * n + 1;
  }
}

/// A plate with a round hole through it, and a headed pin that fits the hole, head up.
inline ReportBodies plate_and_pin() {
  constexpr int kSides = 48;
  constexpr double kHole = 5.0;
  ReportBodies bodies;
  bodies.fixed.found = "plate.stl";
  bodies.moving.found = "pin.stl";
  // Plate: rings of four square-outline and hole-outline circles joined by quads.
  TriangleMesh& plate = bodies.fixed.mesh;
  plate.vertices.resize(3, 4 * kSides);
  plate.triangles.resize(3, 8 * kSides);
  for (int i = 0; i < kSides; ++i) {
    const double a = 2.0 * std::numbers::pi * (i + 0.5) / kSides;
    const double reach = 15.0 / std::max(std::abs(std::cos(a)), std::abs(std::sin(a)));
    for (int ring = 0; ring < 4; ++ring) {  // outer low, outer high, hole high, hole low
      const double r = ring < 2 ? reach : kHole;
      const double z = ring == 1 || ring == 2 ? 4.0 : -4.0;
      plate.vertices.col(ring * kSides + i) << r * std::cos(a), r * std::sin(a), z;
    }
  }
  for (int ring = 0; ring < 4; ++ring)
    for (int i = 0; i < kSides; ++i) {
      const int a = ring * kSides + i;
      const int b = ring * kSides + (i + 1) % kSides;
      const int c = ((ring + 1) % 4) * kSides + (i + 1) % kSides;
      const int d = ((ring + 1) % 4) * kSides + i;
      plate.triangles.col(2 * a) << a, b, c;
      plate.triangles.col(2 * a + 1) << a, c, d;
    }
  const auto circle = [&](double radius) {
    Eigen::Matrix2Xd outline(2, kSides);
    for (int i = 0; i < kSides; ++i) {
      const double a = 2.0 * std::numbers::pi * i / kSides;
      outline.col(i) << radius * std::cos(a), radius * std::sin(a);
    }
    return outline;
  };
  add_prism(bodies.moving.mesh, circle(4.9), -6.0, 4.0);
  add_prism(bodies.moving.mesh, circle(8.0), 4.0, 7.0);
  return bodies;
}

/// A run over these bodies with `count` poses: the identity's neighbourhood first, then anywhere
/// around the fixed body; scores fall with the distance from the identity, with noise.
inline Run report_run(const ReportBodies& bodies, int count, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Run run = sample_run(0, seed);
  run.provenance.mortise_version = "0.1.0";
  run.kind = bodies.fixed.is_mesh() ? "mate" : "dock";
  run.fixed.path = run.fixed.spec = bodies.fixed.found;
  run.moving.path = run.moving.spec = bodies.moving.found;
  run.poses.channel_names = {"shape", "contact"};
  run.metrics.clear();
  const Eigen::Matrix3Xd fixed = report_points(bodies.fixed);
  const Eigen::Matrix3Xd moving = report_points(bodies.moving);
  const Eigen::Vector3d fixed_centre = fixed.rowwise().mean();
  const Eigen::Vector3d moving_centre = moving.rowwise().mean();
  const double reach = (moving_centre - fixed_centre).norm();
  const PoseDistance distance(moving);
  struct Row {
    Pose pose;
    double rmsd = 0.0;
  };
  std::vector<Row> rows(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    Row& row = rows[static_cast<std::size_t>(i)];
    RigidMotion& motion = row.pose.moving_in_fixed;
    const bool near = i < count / 20 + 1;
    const double spread = near ? 0.02 * i / (count / 20 + 1.0) : 10.0;
    motion.rotation =
        near ? canonical(Eigen::Quaterniond(1.0, spread * normal(random), spread * normal(random),
                                            spread * normal(random))
                             .normalized())
             : tests::random_rotation(random);
    const Eigen::Vector3d direction =
        near ? Eigen::Vector3d((moving_centre - fixed_centre).normalized())
             : Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
    const double shift = near ? 20.0 * spread * normal(random) : 0.1 * reach * normal(random);
    motion.translation =
        fixed_centre + (reach + shift) * direction - motion.rotation * moving_centre;
    row.rmsd = distance.rmsd({}, motion);
    const double shape = 3.0 + 0.5 * normal(random);
    const double contact = 16.0 * std::exp(-row.rmsd / 6.0) + 1.5 * normal(random);
    row.pose.channels = {shape, contact};
    row.pose.score = shape + contact;
    row.pose.rotation_index = i % 50;
  }
  std::sort(rows.begin(), rows.end(),
            [](const Row& a, const Row& b) { return a.pose.score > b.pose.score; });
  for (const Row& row : rows) run.poses.poses.push_back(row.pose);
  if (run.kind == "mate" || count == 0) return run;
  run.metrics = {
      {"interface_rmsd", {}}, {"ligand_rmsd", {}}, {"fnat", {}}, {"dockq", {}}, {"capri", {}}};
  for (const Row& row : rows) {
    const double values[] = {row.rmsd / 2, row.rmsd, std::exp(-row.rmsd / 5),
                             std::exp(-row.rmsd / 6),
                             row.rmsd < 2    ? 3.0
                             : row.rmsd < 5  ? 2.0
                             : row.rmsd < 10 ? 1.0
                                             : 0.0};
    for (std::size_t k = 0; k < run.metrics.size(); ++k) run.metrics[k].values.push_back(values[k]);
  }
  return run;
}

}  // namespace mortise::testing
