// SPDX-License-Identifier: GPL-3.0-or-later
// A part's main directions and the oblique view along them.
#include "report/part_view.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace mortise::detail {
namespace {

constexpr double kSame = 0.998;     // cosine of 3.6 degrees: faces of one direction
constexpr double kAcross = 0.2;     // cosine below which two directions are across each other
constexpr double kFlatShare = 0.1;  // of the whole area, for a direction to count
constexpr std::size_t kMostDirections = 200;  // curved surfaces have one per triangle

struct Direction {
  Eigen::Vector3d normal;
  double area = 0.0;
};

// Directions of the triangles without sign, the largest area first.
std::vector<Direction> directions_of(const TriangleMesh& mesh) {
  std::vector<Direction> found;
  for (Eigen::Index t = 0; t < mesh.size(); ++t) {
    const Eigen::Vector3d a = mesh.vertices.col(mesh.triangles(0, t));
    const Eigen::Vector3d n = (mesh.vertices.col(mesh.triangles(1, t)) - a)
                                  .cross(mesh.vertices.col(mesh.triangles(2, t)) - a);
    const double area = n.norm();
    if (!(area > 0.0)) continue;
    const auto same = std::find_if(found.begin(), found.end(), [&](const Direction& d) {
      return std::abs(d.normal.dot(n)) > kSame * area;
    });
    if (same != found.end())
      same->area += area;
    else if (found.size() < kMostDirections)
      found.push_back({n / area, area});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Direction& a, const Direction& b) { return a.area > b.area; });
  return found;
}

double total_area(const std::vector<Direction>& directions) {
  double sum = 0.0;
  for (const Direction& d : directions) sum += d.area;
  return sum;
}

// Columns: three directions across each other.
Eigen::Matrix3d main_directions(const TriangleMesh& mesh) {
  const std::vector<Direction> found = directions_of(mesh);
  if (found.empty() || found.front().area < kFlatShare * total_area(found))
    return Eigen::Matrix3d::Identity();
  const Eigen::Vector3d first = found.front().normal;
  Eigen::Vector3d second = first.unitOrthogonal();
  for (const Direction& d : found)
    if (std::abs(d.normal.dot(first)) < kAcross) {
      second = (d.normal - d.normal.dot(first) * first).normalized();
      break;
    }
  Eigen::Matrix3d axes;
  axes << first, second, first.cross(second);
  return axes;
}

}  // namespace

Eigen::Matrix3d part_view(const TriangleMesh& fixed, const Eigen::Vector3d& away) {
  const Eigen::Matrix3d axes = main_directions(fixed);
  const bool flat = !axes.isIdentity();
  int up_axis = flat ? 0 : 2;
  if (flat && away.norm() > 0.0) (axes.transpose() * away).cwiseAbs().maxCoeff(&up_axis);
  Eigen::Vector3d up = axes.col(up_axis);
  if (up.dot(away) < 0.0) up = -up;
  const Eigen::Vector3d side = axes.col((up_axis + 1) % 3);
  Eigen::Matrix3d upright;  // carries up to z
  upright << side.transpose(), up.cross(side).transpose(), up.transpose();
  const double turn = -35.0 * std::numbers::pi / 180.0;
  const double tilt = -60.0 * std::numbers::pi / 180.0;
  return (Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitX()) *
          Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()))
             .toRotationMatrix() *
         upright;
}

}  // namespace mortise::detail
