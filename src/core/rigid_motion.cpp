// SPDX-License-Identifier: GPL-3.0-or-later
// Composition, inverse and canonical form of rigid motions.
#include "mortise/core/rigid_motion.hpp"

#include <cmath>
#include <string>

#include "mortise/core/errors.hpp"

namespace mortise {

void check_motion(const RigidMotion& motion, const char* who) {
  const double norm = motion.rotation.norm();
  // Written so that NaN fails too.
  if (!(std::abs(norm - 1.0) <= 1e-6) || !motion.translation.allFinite())
    throw InputError(
        std::string(who) + ": expected a finite motion with a unit quaternion, got norm " +
        std::to_string(norm) + " and translation " + std::to_string(motion.translation.x()) + ", " +
        std::to_string(motion.translation.y()) + ", " + std::to_string(motion.translation.z()));
}

Eigen::Quaterniond canonical(const Eigen::Quaterniond& q) {
  Eigen::Quaterniond unit = q.normalized();
  const double lead = unit.w() != 0.0   ? unit.w()
                      : unit.x() != 0.0 ? unit.x()
                      : unit.y() != 0.0 ? unit.y()
                                        : unit.z();
  if (lead < 0.0) unit.coeffs() = -unit.coeffs();
  return unit;
}

RigidMotion compose(const RigidMotion& a, const RigidMotion& b) {
  return {canonical(a.rotation * b.rotation), a.rotation * b.translation + a.translation};
}

RigidMotion inverse(const RigidMotion& m) {
  const Eigen::Quaterniond back = m.rotation.conjugate();
  return {canonical(back), -(back * m.translation)};
}

double rotation_angle(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  const Eigen::Quaterniond d = a.conjugate() * b;
  return 2.0 * std::atan2(d.vec().norm(), std::abs(d.w()));  // accurate near 0 as acos is not
}

}  // namespace mortise
