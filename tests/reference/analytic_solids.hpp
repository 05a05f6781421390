// SPDX-License-Identifier: GPL-3.0-or-later
// Solids whose distance is a formula, and their unions.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "mortise/parts/solid.hpp"

namespace mortise::reference {

// A solid by its box and its distance at one point.
template <typename Distance>
class Formula final : public Solid {
 public:
  Formula(const Eigen::AlignedBox3d& box, Distance distance)
      : box_(box), distance_(std::move(distance)) {}

  [[nodiscard]] Eigen::AlignedBox3d bounds() const override { return box_; }

  [[nodiscard]] Eigen::VectorXd signed_distance(const Eigen::Matrix3Xd& points,
                                                double /*band*/) const override {
    Eigen::VectorXd result(points.cols());
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      result[i] = distance_(Eigen::Vector3d(points.col(i)));
    return result;
  }

 private:
  Eigen::AlignedBox3d box_;
  Distance distance_;
};

template <typename Distance>
std::shared_ptr<const Solid> solid(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                                   Distance distance) {
  return std::make_shared<Formula<Distance>>(Eigen::AlignedBox3d(low, high), std::move(distance));
}

class Union final : public Solid {
 public:
  explicit Union(std::vector<std::shared_ptr<const Solid>> solids) : solids_(std::move(solids)) {}

  [[nodiscard]] Eigen::AlignedBox3d bounds() const override {
    Eigen::AlignedBox3d box;
    for (const auto& solid : solids_) box.extend(solid->bounds());
    return box;
  }

  [[nodiscard]] Eigen::VectorXd signed_distance(const Eigen::Matrix3Xd& points,
                                                double band) const override {
    Eigen::VectorXd result = solids_.front()->signed_distance(points, band);
    for (std::size_t i = 1; i < solids_.size(); ++i)
      result = result.cwiseMin(solids_[i]->signed_distance(points, band)).eval();
    return result;
  }

 private:
  std::vector<std::shared_ptr<const Solid>> solids_;
};

inline std::shared_ptr<const Solid> make_ball(const Eigen::Vector3d& center, double radius) {
  return solid((center.array() - radius).matrix(), (center.array() + radius).matrix(),
               [=](const Eigen::Vector3d& p) { return (p - center).norm() - radius; });
}

/// The axis-parallel box between two corners, low < high.
inline std::shared_ptr<const Solid> make_box(const Eigen::Vector3d& low,
                                             const Eigen::Vector3d& high) {
  const Eigen::Vector3d center = 0.5 * (low + high), half = 0.5 * (high - low);
  return solid(low, high, [=](const Eigen::Vector3d& p) {
    const Eigen::Vector3d beyond = (p - center).cwiseAbs() - half;
    return beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0);
  });
}

/// All points within `radius` of the segment from a to b.
inline std::shared_ptr<const Solid> make_capsule(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                                 double radius) {
  const Eigen::Vector3d axis = b - a;
  const double length_sq = axis.squaredNorm();
  return solid((a.cwiseMin(b).array() - radius).matrix(), (a.cwiseMax(b).array() + radius).matrix(),
               [=](const Eigen::Vector3d& p) {
                 const double t =
                     length_sq > 0.0 ? std::clamp((p - a).dot(axis) / length_sq, 0.0, 1.0) : 0.0;
                 return (p - a - t * axis).norm() - radius;
               });
}

/// All points within `tube` of the circle of `radius` about the z axis through the centre.
inline std::shared_ptr<const Solid> make_torus(const Eigen::Vector3d& center, double radius,
                                               double tube) {
  const Eigen::Vector3d half(radius + tube, radius + tube, tube);
  return solid(center - half, center + half, [=](const Eigen::Vector3d& p) {
    const Eigen::Vector3d d = p - center;
    return std::hypot(d.head<2>().norm() - radius, d.z()) - tube;
  });
}

/// The union of solids. Outside exact; inside where solids overlap the depth is that in the deepest
/// of them, a lower bound.
inline std::shared_ptr<const Solid> unite(std::vector<std::shared_ptr<const Solid>> solids) {
  return std::make_shared<Union>(std::move(solids));
}

}  // namespace mortise::reference
