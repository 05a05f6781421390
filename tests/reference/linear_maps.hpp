// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What score maps give, slowly: potentials by pair sums at the corners of each point's cell,
/// linear along each axis between them, in double precision.
#pragma once

#include <cmath>

#include "mortise/scoring/score_maps.hpp"

namespace mortise::reference {

struct LinearMaps {
  TypedPoints fixed;
  ContactPotential potential;
  ShapeTerms shape;  ///< no points = none
  double spacing = 1.0;
  Eigen::Vector3d low = Eigen::Vector3d::Zero();  ///< a grid point

  /// Contacts of type `type`, and shape of `shape_weights`, at x.
  [[nodiscard]] double at(const Eigen::Vector3d& x, int type,
                          const Eigen::VectorXd& shape_weights) const {
    double sum = 0.0;
    for (Eigen::Index i = 0; type >= 0 && i < fixed.points.cols(); ++i) {
      const double d = (fixed.points.col(i) - x).norm();
      if (fixed.types[i] < 0 || d >= kContactRange) continue;
      sum += potential.near(fixed.types[i], type) * near_contact(d) +
             potential.far(fixed.types[i], type) * far_contact(d);
    }
    for (Eigen::Index i = 0; i < shape.points.cols(); ++i)
      for (Eigen::Index q = 0; q < shape_weights.size(); ++q)
        sum += shape_weights[q] * shape.weights[i] *
               shape.kernels[q][shape.kernel_of[i]]((shape.points.col(i) - x).squaredNorm());
    return sum;
  }

  /// Value, gradient and torque about the moved `centre` of points with types and weights (Q x N).
  [[nodiscard]] PlacedScore slope(const TypedPoints& moving, const Eigen::MatrixXd& shape_weights,
                                  const Eigen::Vector3d& centre, const RigidMotion& pose) const {
    PlacedScore score;
    for (Eigen::Index n = 0; n < moving.points.cols(); ++n) {
      const Eigen::Vector3d moved = pose * moving.points.col(n).eval();
      const Eigen::Vector3d u = (moved - low) / spacing;
      const Eigen::Vector3d cell = u.array().floor(), t = u - cell;
      Eigen::Vector3d force = Eigen::Vector3d::Zero();
      double value = 0.0;
      for (int corner = 0; corner < 8; ++corner) {
        const Eigen::Vector3d step(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
        const double f = at(low + spacing * (cell + step), moving.types[n], shape_weights.col(n));
        Eigen::Vector3d w, slope;
        for (int d = 0; d < 3; ++d) {
          w[d] = step[d] > 0.0 ? t[d] : 1.0 - t[d];
          slope[d] = step[d] > 0.0 ? 1.0 : -1.0;
        }
        value += f * w.prod();
        for (int d = 0; d < 3; ++d) force[d] += f * slope[d] * w[(d + 1) % 3] * w[(d + 2) % 3];
      }
      score.value += value;
      score.force += force / spacing;
      score.torque += (moved - pose * centre).cross(force / spacing);
    }
    return score;
  }
};

}  // namespace mortise::reference
