// SPDX-License-Identifier: GPL-3.0-or-later
// The Voronoi cell of one rotation among others, as a convex polyhedron under the gnomonic
// projection.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "mortise/rotations/rotation_index.hpp"

namespace mortise {

/// conj(a) b for quaternions as columns (w, x, y, z).
[[nodiscard]] Eigen::Vector4d relative_rotation(const Eigen::Vector4d& a, const Eigen::Vector4d& b);

/// A convex polyhedron around the origin of R^3, cut down half-space by half-space. Its points y
/// stand for the rotations q (1, y) / |(1, y)|: at angle 2 atan |y| from q, which lies at the
/// origin.
class VoronoiCell {
 public:
  struct Face {
    Eigen::Vector3d normal;             ///< unit, outward
    double height;                      ///< distance of the plane from the origin
    Eigen::Index neighbour;             ///< label given to cut(); -1 for the starting cube
    std::vector<Eigen::Vector3d> ring;  ///< corners in order round the face
  };

  /// Half-edge of the largest starting cube: what reaches it counts as reaching rotations by pi.
  static constexpr double kFarthest = 1e6;

  /// Back to the cube |y_i| <= half_edge. A cube not much larger than the cell keeps its corners'
  /// digits.
  void reset(double half_edge);

  /// Keeps what is nearer to q than to q r, r = `relative` as (w, x, y, z); either sign is another
  /// neighbour.
  void cut(const Eigen::Vector4d& relative, Eigen::Index neighbour);

  [[nodiscard]] const std::vector<Face>& faces() const { return faces_; }
  [[nodiscard]] double farthest() const { return farthest_; }  ///< largest |y|
  [[nodiscard]] Eigen::Vector3d farthest_corner() const;
  [[nodiscard]] double covering_angle() const;  ///< largest rotation angle from q; radians

 private:
  void order_section(const Eigen::Vector3d& normal);

  std::vector<Face> faces_;
  std::vector<Eigen::Vector3d> ring_, section_;  // scratch of cut()
  std::vector<std::pair<double, Eigen::Vector3d>> turns_;
  double slack_ = 0.0;
  double farthest_ = 0.0;
};

/// Cuts the cell of the set's column `member` out of SO(3); `index` is the index of the same
/// columns.
void cut_cell(const Eigen::Matrix4Xd& quaternions, const RotationIndex& index, Eigen::Index member,
              VoronoiCell& cell);

}  // namespace mortise
