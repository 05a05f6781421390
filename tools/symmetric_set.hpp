// SPDX-License-Identifier: GPL-3.0-or-later
// A rotation set with symmetry, its covering radius and a smooth stand-in for it with a gradient.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "rotations/voronoi_cell.hpp"

namespace mortise {

using Rotations = std::vector<Eigen::Quaterniond>;

/// p turned a little: p (1, d) normalised; d in the tangent frame p i, p j, p k.
[[nodiscard]] Eigen::Quaterniond displaced(const Eigen::Quaterniond& p, const Eigen::Vector3d& d);

/// The set { g p h : g in `left`, p a representative, h in `right` }, left and right groups.
/// Multiplications from either side are isometries of SO(3), so only the Voronoi cells of the
/// representatives are needed.
class SymmetricSet {
 public:
  SymmetricSet(Rotations left, Rotations right, std::size_t representatives);

  /// Radius, as the angle of unit quaternions, of a ball of the cells' mean volume (in flat space).
  [[nodiscard]] double ball() const { return ball_; }

  struct Value {
    double f = 0.0;
    double radius = 0.0;         ///< covering radius, rotation angle
    Eigen::Quaterniond deepest;  ///< a rotation that far from the set
    Eigen::VectorXd gradient;    ///< of f, by the displacements of all representatives
  };

  /// f = (1 / power) log sum_v R_v^power over the corners v of the representatives' cells, R_v the
  /// distance of a corner from the member as an angle of quaternions: the logarithm of half the
  /// covering radius as the power grows.
  ///
  /// If a corner v is the combination sum_k mu_k p_k of its four nearest members, a displacement d
  /// of member i changes R_v by -(mu_i / sum mu) d.u, u the direction from it to v (differentiate
  /// v.p_k = cos R and v.v = 1).
  [[nodiscard]] Value evaluate(const Rotations& p, double power);

 private:
  struct Copy {
    std::size_t left, right, point;
  };

  void refresh(const Rotations& p);
  void cut(const Rotations& p, std::size_t i);

  Rotations left_, right_;
  double ball_ = 0.0;
  Rotations listed_;                      // the representatives the lists were made for
  std::vector<std::vector<Copy>> lists_;  // members near enough to cut a representative's cell
  std::vector<Eigen::Vector4d>
      near_;  // those of one cell, seen from its representative, nearest first
  VoronoiCell cell_;
};

}  // namespace mortise
