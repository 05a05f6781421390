// SPDX-License-Identifier: GPL-3.0-or-later
// Ribbons of proteins and nucleic acids.
#include "report/ribbon.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace mortise::detail {
namespace {

constexpr int kSteps = 8;        // per residue
constexpr int kSides = 16;       // of the cross-section
constexpr double kWidth = 1.35;  // half axes of the cross-section, angstrom
constexpr double kHeight = 0.38;
constexpr double kLongestStep = 4.5;     // angstrom from CA to CA
constexpr double kLongestStepP = 8.0;    // from P to P
constexpr std::size_t kShortestRun = 4;  // residues

struct Node {
  Eigen::Vector3d at;
  Eigen::Vector3d across;  // in the band's plane
};

const Atom* find_atom(const Molecule& molecule, const ResidueRange& residue, const char* name) {
  for (std::size_t i = residue.first; i < residue.last; ++i)
    if (molecule.atoms[i].name == name) return &molecule.atoms[i];
  return nullptr;
}

// Runs of residues that follow each other.
std::vector<std::vector<Node>> runs_of(const Molecule& molecule) {
  std::vector<std::vector<Node>> runs;
  const Atom* last = nullptr;
  for (const ResidueRange& residue : residues(molecule)) {
    const Atom* trace = find_atom(molecule, residue, "CA");
    const Atom* side = find_atom(molecule, residue, "O");
    double longest = kLongestStep;
    if (trace == nullptr || trace->element == "Ca") {
      trace = find_atom(molecule, residue, "P");
      side = find_atom(molecule, residue, "C1'");
      longest = kLongestStepP;
    }
    if (trace == nullptr || trace->hetero) {
      last = nullptr;
      continue;
    }
    const bool follows = last != nullptr && last->chain == trace->chain &&
                         (trace->position - last->position).norm() < longest;
    if (!follows) runs.emplace_back();
    Eigen::Vector3d across = side != nullptr ? Eigen::Vector3d(side->position - trace->position)
                                             : Eigen::Vector3d::UnitX();
    if (!runs.back().empty() && runs.back().back().across.dot(across) < 0.0)
      across = -across;  // strands turn the carbonyl over at every residue
    runs.back().push_back({trace->position, across.normalized()});
    last = trace;
  }
  std::erase_if(runs, [](const auto& run) { return run.size() < kShortestRun; });
  return runs;
}

// Uniform cubic B-spline weights and those of its slope.
std::array<double, 4> weights(double t) {
  const double s = 1.0 - t;
  return {s * s * s / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
          (3.0 * s * s * s - 6.0 * s * s + 4.0) / 6.0, t * t * t / 6.0};
}
std::array<double, 4> slopes(double t) {
  const double s = 1.0 - t;
  return {-s * s / 2.0, (3.0 * t * t - 4.0 * t) / 2.0, -(3.0 * s * s - 4.0 * s) / 2.0, t * t / 2.0};
}

void add_band(const std::vector<Node>& run, std::vector<Eigen::Vector3d>& vertices,
              std::vector<Eigen::Vector3i>& triangles) {
  const auto last = static_cast<int>(run.size()) - 1;
  const auto node = [&](int i) -> const Node& {
    return run[static_cast<std::size_t>(std::clamp(i, 0, last))];
  };
  const auto first_vertex = static_cast<int>(vertices.size());
  const int rings = last * kSteps + 1;
  for (int ring = 0; ring < rings; ++ring) {
    const int segment = std::min(ring / kSteps, last - 1);
    const double t = static_cast<double>(ring - segment * kSteps) / kSteps;
    const std::array<double, 4> w = weights(t);
    const std::array<double, 4> dw = slopes(t);
    Eigen::Vector3d at = Eigen::Vector3d::Zero(), along = at, across = at;
    for (int k = 0; k < 4; ++k) {
      const Node& n = node(segment - 1 + k);
      const auto index = static_cast<std::size_t>(k);
      at += w[index] * n.at;
      along += dw[index] * n.at;
      across += w[index] * n.across;
    }
    along.normalize();
    across = (across - across.dot(along) * along).normalized();
    const Eigen::Vector3d up = along.cross(across);
    // The ends close in half a residue.
    const double from_end = std::min(ring, rings - 1 - ring) / (0.5 * kSteps);
    const double fullness = from_end >= 1.0 ? 1.0 : std::sqrt(from_end * (2.0 - from_end));
    for (int side = 0; side < kSides; ++side) {
      const double a = 2.0 * std::numbers::pi * side / kSides;
      vertices.emplace_back(at + fullness *
                                     (kWidth * std::cos(a) * across + kHeight * std::sin(a) * up));
    }
  }
  for (int ring = 0; ring + 1 < rings; ++ring)
    for (int side = 0; side < kSides; ++side) {
      const int a = first_vertex + ring * kSides + side;
      const int b = first_vertex + ring * kSides + (side + 1) % kSides;
      triangles.emplace_back(a, b, b + kSides);
      triangles.emplace_back(a, b + kSides, a + kSides);
    }
}

}  // namespace

TriangleMesh ribbon(const Molecule& molecule) {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector3i> triangles;
  for (const std::vector<Node>& run : runs_of(molecule)) add_band(run, vertices, triangles);
  TriangleMesh mesh;
  mesh.vertices.resize(3, static_cast<Eigen::Index>(vertices.size()));
  mesh.triangles.resize(3, static_cast<Eigen::Index>(triangles.size()));
  for (std::size_t i = 0; i < vertices.size(); ++i)
    mesh.vertices.col(static_cast<Eigen::Index>(i)) = vertices[i];
  for (std::size_t i = 0; i < triangles.size(); ++i)
    mesh.triangles.col(static_cast<Eigen::Index>(i)) = triangles[i];
  return mesh;
}

}  // namespace mortise::detail
