// SPDX-License-Identifier: GPL-3.0-or-later
// Principal axes by the eigenvectors of the second moments.
#include "mortise/core/principal_frame.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "mortise/core/errors.hpp"

namespace mortise {

RigidMotion principal_frame(const Eigen::Matrix3Xd& points) {
  if (points.cols() == 0) throw InputError("principal_frame: expected at least one point");
  const Eigen::Vector3d mean = points.rowwise().mean();
  const Eigen::Matrix3Xd centred = points.colwise() - mean;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
      centred.lazyProduct(centred.transpose()));
  Eigen::Matrix3d axes;
  for (int d = 0; d < 2; ++d) {
    Eigen::Vector3d axis = solver.eigenvectors().col(2 - d);
    const Eigen::ArrayXd along = centred.transpose() * axis;
    const double third = along.cube().sum();
    Eigen::Index largest = 0;
    axis.cwiseAbs().maxCoeff(&largest);
    const double lead = std::abs(third) > 1e-9 * along.abs().cube().sum() ? third : axis[largest];
    axes.row(d) = (lead < 0.0 ? -axis : axis).transpose();
  }
  axes.row(2) = axes.row(0).cross(axes.row(1));
  RigidMotion frame{canonical(Eigen::Quaterniond(axes)), Eigen::Vector3d::Zero()};
  const Eigen::Matrix3Xd turned = frame * points;
  frame.translation = -0.5 * (turned.rowwise().minCoeff() + turned.rowwise().maxCoeff());
  return frame;
}

}  // namespace mortise
