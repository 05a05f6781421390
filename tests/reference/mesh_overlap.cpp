// SPDX-License-Identifier: GPL-3.0-or-later
// What two closed meshes have in common, by the crossings of parallel lines with their triangles.
//
// Along a line a closed mesh is a set of intervals, its crossings sorted. The lengths that the
// intervals of both share, times the lines' area, are the volume; a crossing of one mesh inside an
// interval of the other lies on the boundary of what is common. All is turned first, so that no
// face of the parts lies along the lines.
#include "reference/mesh_overlap.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace mortise::reference {
namespace {

constexpr int kLines = 200;  // along either side of the box that both meshes reach into

// Lines along z through the middles of an even grid's cells.
struct Lines {
  Eigen::Vector2d low, step;

  [[nodiscard]] Eigen::Vector2d at(int i, int j) const {
    return low + step.cwiseProduct(Eigen::Vector2d(i + 0.5, j + 0.5));
  }
};

Lines lines_through_both(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  const Eigen::Vector2d low =
      a.rowwise().minCoeff().cwiseMax(b.rowwise().minCoeff().eval()).head<2>();
  const Eigen::Vector2d high =
      a.rowwise().maxCoeff().cwiseMin(b.rowwise().maxCoeff().eval()).head<2>();
  return {low, (high - low).cwiseMax(0.0) / kLines};
}

// z where the line through (x, y) crosses the triangle. Ends of an edge are taken in one order from
// both of its triangles, so that rounding puts the line into one of them.
bool crosses(const TriangleMesh& mesh, Eigen::Index t, const Eigen::Vector2d& at, double& z) {
  double weights[3], sum = 0.0;
  int positive = 0, negative = 0;
  for (int e = 0; e < 3; ++e) {
    const int p = mesh.triangles((e + 1) % 3, t), q = mesh.triangles((e + 2) % 3, t);
    const Eigen::Vector2d u = mesh.vertices.col(std::min(p, q)).head<2>() - at,
                          v = mesh.vertices.col(std::max(p, q)).head<2>() - at;
    const double side = (u[0] * v[1] - u[1] * v[0]) * (p < q ? 1.0 : -1.0);
    weights[e] = side;
    sum += side;
    (side > 0.0 ? positive : negative) += 1;
  }
  if ((positive != 3 && negative != 3) || sum == 0.0) return false;
  z = 0.0;
  for (int e = 0; e < 3; ++e) z += weights[e] / sum * mesh.vertices(2, mesh.triangles(e, t));
  return true;
}

// Sorted crossings of each line, kLines x kLines of them.
std::vector<std::vector<double>> crossings(const TriangleMesh& mesh, const Lines& lines) {
  std::vector<std::vector<double>> found(std::size_t{kLines} * kLines);
  for (Eigen::Index t = 0; t < mesh.size(); ++t) {
    Eigen::Matrix<double, 2, 3> corners;
    for (int c = 0; c < 3; ++c)
      corners.col(c) =
          (mesh.vertices.col(mesh.triangles(c, t)).head<2>() - lines.low).cwiseQuotient(lines.step);
    const Eigen::Vector2d low = corners.rowwise().minCoeff(), high = corners.rowwise().maxCoeff();
    const auto cell = [](double x) { return static_cast<int>(std::clamp(x, -1.0, kLines + 0.0)); };
    for (int i = std::max(0, cell(low[0]) - 1); i <= std::min(kLines - 1, cell(high[0]) + 1); ++i)
      for (int j = std::max(0, cell(low[1]) - 1); j <= std::min(kLines - 1, cell(high[1]) + 1);
           ++j) {
        double z = 0.0;
        if (crosses(mesh, t, lines.at(i, j), z))
          found[std::size_t{kLines} * static_cast<std::size_t>(i) + static_cast<std::size_t>(j)]
              .push_back(z);
      }
  }
  for (std::vector<double>& line : found) {
    std::sort(line.begin(), line.end());
    if (line.size() % 2 != 0) throw std::runtime_error("mesh_overlap: a mesh is not closed");
  }
  return found;
}

bool inside(const std::vector<double>& line, double z) {
  return (std::upper_bound(line.begin(), line.end(), z) - line.begin()) % 2 == 1;
}

// Length that the intervals of both have in common.
double common_length(const std::vector<double>& a, const std::vector<double>& b) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < a.size(); i += 2)
    for (std::size_t j = 0; j + 1 < b.size(); j += 2)
      length += std::max(0.0, std::min(a[i + 1], b[j + 1]) - std::max(a[i], b[j]));
  return length;
}

double square_distance(const Eigen::Vector3d& x, const TriangleMesh& mesh, Eigen::Index t) {
  const Eigen::Vector3d a = mesh.vertices.col(mesh.triangles(0, t)),
                        b = mesh.vertices.col(mesh.triangles(1, t)),
                        c = mesh.vertices.col(mesh.triangles(2, t));
  const Eigen::Vector3d n = (b - a).cross(c - a);
  const bool above = n.dot((b - a).cross(x - a)) >= 0.0 && n.dot((c - b).cross(x - b)) >= 0.0 &&
                     n.dot((a - c).cross(x - c)) >= 0.0;
  if (above && n.squaredNorm() > 0.0) return std::pow(n.dot(x - a), 2) / n.squaredNorm();
  double least = (x - a).squaredNorm();
  for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
    const Eigen::Vector3d along = q - p;
    const double square = along.squaredNorm();
    const double share = square > 0.0 ? std::clamp(along.dot(x - p) / square, 0.0, 1.0) : 0.0;
    least = std::min(least, (p + share * along - x).squaredNorm());
  }
  return least;
}

// Largest distance from points to a mesh.
class Farthest {
 public:
  explicit Farthest(const TriangleMesh& mesh)
      : mesh_(mesh), centres_(3, mesh.size()), radii_(mesh.size()) {
    for (Eigen::Index t = 0; t < mesh.size(); ++t) {
      Eigen::Matrix3d corners;
      for (int c = 0; c < 3; ++c) corners.col(c) = mesh.vertices.col(mesh.triangles(c, t));
      centres_.col(t) = corners.rowwise().mean();
      radii_[t] = (corners.colwise() - centres_.col(t)).colwise().norm().maxCoeff();
    }
  }

  void look(const Eigen::Vector3d& x) {
    // The triangle that ruled out the last point mostly rules out the next.
    double least = std::sqrt(square_distance(x, mesh_, last_));
    for (Eigen::Index t = 0; t < mesh_.size() && least > largest_; ++t) {
      const double reach = least + radii_[t];
      if ((x - centres_.col(t)).squaredNorm() >= reach * reach) continue;
      const double here = std::sqrt(square_distance(x, mesh_, t));
      if (here >= least) continue;
      least = here;
      last_ = t;
    }
    largest_ = std::max(largest_, least);
  }

  [[nodiscard]] double distance() const { return largest_; }

 private:
  const TriangleMesh& mesh_;
  Eigen::Matrix3Xd centres_;  // spheres around the triangles, to leave out far ones
  Eigen::VectorXd radii_;
  double largest_ = 0.0;
  Eigen::Index last_ = 0;
};

// How deep the surface of `mesh` lies in `other`: its vertices and its crossings with the lines.
double depth_in(const TriangleMesh& mesh, const std::vector<std::vector<double>>& crossed,
                const TriangleMesh& other, const std::vector<std::vector<double>>& other_crossed,
                const Lines& lines) {
  Farthest farthest(other);
  for (int i = 0; i < kLines; ++i)
    for (int j = 0; j < kLines; ++j) {
      const auto line =
          std::size_t{kLines} * static_cast<std::size_t>(i) + static_cast<std::size_t>(j);
      const Eigen::Vector2d at = lines.at(i, j);
      for (const double z : crossed[line])
        if (inside(other_crossed[line], z)) farthest.look({at[0], at[1], z});
    }
  for (const auto& vertex : mesh.vertices.colwise()) {
    std::vector<double> line;
    double z = 0.0;
    for (Eigen::Index t = 0; t < other.size(); ++t)
      if (crosses(other, t, vertex.head<2>(), z)) line.push_back(z);
    std::sort(line.begin(), line.end());
    if (inside(line, vertex[2])) farthest.look(vertex);
  }
  return farthest.distance();
}

TriangleMesh turned(TriangleMesh mesh) {
  mesh.vertices =
      Eigen::Quaterniond(0.8, 0.31, -0.37, 0.36).normalized().toRotationMatrix() * mesh.vertices;
  return mesh;
}

}  // namespace

MeshOverlap mesh_overlap(const TriangleMesh& a, const TriangleMesh& b) {
  const TriangleMesh first = turned(a), second = turned(b);
  const Lines lines = lines_through_both(first.vertices, second.vertices);
  MeshOverlap overlap;
  if (!(lines.step.minCoeff() > 0.0)) return overlap;
  const std::vector<std::vector<double>> in_first = crossings(first, lines),
                                         in_second = crossings(second, lines);
  for (std::size_t line = 0; line < in_first.size(); ++line)
    overlap.volume += lines.step.prod() * common_length(in_first[line], in_second[line]);
  overlap.depth = std::max(depth_in(first, in_first, second, in_second, lines),
                           depth_in(second, in_second, first, in_first, lines));
  return overlap;
}

}  // namespace mortise::reference
