// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The contact of two parts at one placement: an energy to descend, and how good the fit is.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <utility>

#include "mortise/core/rigid_motion.hpp"
#include "mortise/parts/sample_surface.hpp"
#include "scoring/distance_field.hpp"

namespace mortise {

/// One part as its placements are judged by.
struct ContactBody {
  ContactBody(const SurfaceSamples& samples, DistanceField distance, const Eigen::Vector3d& middle);

  Eigen::Matrix3Xf points;   ///< of the surface, input frame
  Eigen::Matrix3Xf normals;  ///< outward
  double area;               ///< of the whole surface
  DistanceField field;
  Eigen::Vector3d centre;  ///< of the bounding box
  double reach;            ///< largest distance of a sample from the centre
};

/// Energy of a placement and its derivatives with regard to a twist (v, w) of the moving body
/// about a centre: x' = x + v + w x (x - centre) / length.
struct ContactEnergy {
  double value = 0.0;
  Eigen::Matrix<double, 6, 1> gradient = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::Matrix<double, 6, 6> curvature =
      Eigen::Matrix<double, 6, 6>::Zero();  ///< positive semidefinite part (Gauss and Newton's)
};

/// How well two surfaces lie on each other within a tolerance.
struct ContactFit {
  double contact = 0.0;    ///< area in contact, mean of both sides
  double one_sided = 0.0;  ///< of it, what pushes the moving body one way: |sum of normals by area|
  double penetration = 0.0;  ///< area in penetration, each piece times its depth in tolerances
};

/// Judges placements of one moving body against one fixed body. Immutable, thread safe; copies
/// share the bodies.
///
/// With a clearance c the moving body counts as grown by c all round: every distance d between the
/// two is taken as d - c, so that surfaces a gap of c apart are in contact and nearer ones
/// penetrate.
class ContactPair {
 public:
  ContactPair(ContactBody fixed, ContactBody moving)
      : fixed_(std::make_shared<const ContactBody>(std::move(fixed))),
        moving_(std::make_shared<const ContactBody>(std::move(moving))) {}

  /// The same bodies at another clearance. The bodies' fields must reach that much further.
  [[nodiscard]] ContactPair with_clearance(double clearance) const {
    ContactPair pair = *this;
    pair.clearance_ = clearance;
    return pair;
  }

  /// sum over the samples of both bodies of a phi(d / sigma), d the distance to the other body:
  ///
  ///   phi(u) = -exp(-u^2 / 2) for u >= 0,   -1 + penalty (sqrt(1 + u^2) - 1) for u < 0.
  ///
  /// Once differentiable at 0; grows linearly with depth. Divided by the smaller surface's area.
  /// @param sample_fraction  samples used, as a fraction of all
  /// @param centre   of the twists, fixed frame; @param length  that makes angles lengths
  [[nodiscard]] ContactEnergy energy(const RigidMotion& moving_in_fixed, double sigma,
                                     double penalty, double sample_fraction,
                                     const Eigen::Vector3d& centre, double length) const;

  [[nodiscard]] ContactFit fit(const RigidMotion& moving_in_fixed, double tolerance,
                               double sample_fraction) const;

  /// Levenberg and Marquardt's steps down the energy; the result's energy is never above the
  /// start's.
  [[nodiscard]] RigidMotion descend(const RigidMotion& start, double sigma, double penalty,
                                    double sample_fraction, int steps) const;

  [[nodiscard]] const ContactBody& fixed() const { return *fixed_; }
  [[nodiscard]] const ContactBody& moving() const { return *moving_; }
  /// The smaller of the two surfaces' areas.
  [[nodiscard]] double smaller_area() const { return std::min(fixed_->area, moving_->area); }

 private:
  /// Calls use(side, x, n, d, g) for the samples that lie within the other body's grid: x, the
  /// sample's normal n, and the other body's distance d less the clearance and its gradient g, in
  /// the fixed frame; side = +1 for moving samples, -1 for fixed ones.
  template <class Use>
  void for_each(const RigidMotion& motion, double sample_fraction, const Use& use) const;

  std::shared_ptr<const ContactBody> fixed_, moving_;
  double clearance_ = 0.0;
};

}  // namespace mortise
