// SPDX-License-Identifier: GPL-3.0-or-later
// Parts and motions in local frames.
#include "scoring/local_part.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

class LocalSolid : public Solid {
 public:
  LocalSolid(std::shared_ptr<const Solid> solid, LocalFrame frame)
      : solid_(std::move(solid)), frame_(std::move(frame)) {}

  [[nodiscard]] Eigen::AlignedBox3d bounds() const override {
    const Eigen::AlignedBox3d box = solid_->bounds();
    return {Eigen::Vector3d((box.min() - frame_.centre) / frame_.unit),
            Eigen::Vector3d((box.max() - frame_.centre) / frame_.unit)};
  }
  [[nodiscard]] Eigen::VectorXd signed_distance(const Eigen::Matrix3Xd& points,
                                                double band) const override {
    return solid_->signed_distance(frame_.to_input(points), band * frame_.unit) / frame_.unit;
  }

 private:
  std::shared_ptr<const Solid> solid_;
  LocalFrame frame_;
};

}  // namespace

Eigen::Matrix3Xd LocalFrame::to_local(const Eigen::Matrix3Xd& points) const {
  return (points.colwise() - centre) / unit;
}

Eigen::Matrix3Xd LocalFrame::to_input(const Eigen::Matrix3Xd& points) const {
  return (unit * points).colwise() + centre;
}

Part local_part(const Part& part, const LocalFrame& frame) {
  if (!(frame.unit > 0.0) || !std::isfinite(frame.unit) || !frame.centre.allFinite())
    throw InputError("mate: expected parts of finite extent, found a diameter of " +
                     std::to_string(frame.unit));
  Part local{part.mesh, std::make_shared<LocalSolid>(part.solid, frame)};
  local.mesh.vertices = frame.to_local(part.mesh.vertices);
  return local;
}

RigidMotion local_motion(const LocalFrame& fixed, const LocalFrame& moving,
                         const RigidMotion& motion) {
  return {motion.rotation, (motion * moving.centre - fixed.centre) / fixed.unit};
}

RigidMotion input_motion(const LocalFrame& fixed, const LocalFrame& moving,
                         const RigidMotion& motion) {
  return {motion.rotation,
          fixed.centre + fixed.unit * motion.translation - motion.rotation * moving.centre};
}

}  // namespace mortise
