// SPDX-License-Identifier: GPL-3.0-or-later
// The exponential map of SO(3).
#include "mortise/core/rotation_vector.hpp"

namespace mortise {

Eigen::Quaterniond rotation_from_vector(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  return angle > 0.0 ? Eigen::Quaterniond(Eigen::AngleAxisd(angle, vector / angle))
                     : Eigen::Quaterniond::Identity();
}

}  // namespace mortise
