// SPDX-License-Identifier: GPL-3.0-or-later
// Contact energy, fit and descent.
#include "scoring/contact_pair.hpp"

#include <algorithm>
#include <cmath>

#include "core/solve_symmetric.hpp"
#include "mortise/core/rotation_vector.hpp"

namespace mortise {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

Eigen::Index count_of(const ContactBody& body, double sample_fraction) {
  const Eigen::Index all = body.points.cols();
  return std::clamp<Eigen::Index>(
      static_cast<Eigen::Index>(sample_fraction * static_cast<double>(all)), 1, all);
}

// The twist about `centre`, then the motion.
RigidMotion twisted(const RigidMotion& motion, const Vector6& twist, const Eigen::Vector3d& centre,
                    double length) {
  const Eigen::Quaterniond q = rotation_from_vector(twist.tail<3>() / length);
  return compose({q, centre - q * centre + twist.head<3>()}, motion);
}

}  // namespace

ContactBody::ContactBody(const SurfaceSamples& samples, DistanceField distance,
                         const Eigen::Vector3d& middle)
    : points(samples.points.cast<float>()),
      normals(samples.normals.cast<float>()),
      area(samples.area),
      field(std::move(distance)),
      centre(middle),
      reach((samples.points.colwise() - middle).colwise().norm().maxCoeff()) {}

template <class Use>
void ContactPair::for_each(const RigidMotion& motion, double sample_fraction,
                           const Use& use) const {
  const Eigen::Matrix3f R = motion.rotation.toRotationMatrix().cast<float>();
  const Eigen::Vector3f t = motion.translation.cast<float>();
  const auto clearance = static_cast<float>(clearance_);
  Eigen::Vector3f gradient;
  const Eigen::Index moving_count = count_of(*moving_, sample_fraction);
  const double moving_area = moving_->area / static_cast<double>(moving_count);
  for (Eigen::Index i = 0; i < moving_count; ++i) {
    const Eigen::Vector3f x = R * moving_->points.col(i) + t;
    const float d = fixed_->field.at(x, gradient);
    if (d < DistanceField::kFar)
      use(1.0F, x, Eigen::Vector3f(R * moving_->normals.col(i)), d - clearance, gradient,
          moving_area);
  }
  const Eigen::Matrix3f back = R.transpose();
  const Eigen::Vector3f centre = (motion * moving_->centre).cast<float>();
  const auto reach_sq = static_cast<float>(std::pow(1.1 * moving_->reach + clearance_, 2));
  const Eigen::Index fixed_count = count_of(*fixed_, sample_fraction);
  const double fixed_area = fixed_->area / static_cast<double>(fixed_count);
  for (Eigen::Index i = 0; i < fixed_count; ++i) {
    const Eigen::Vector3f x = fixed_->points.col(i);
    if ((x - centre).squaredNorm() > reach_sq) continue;
    const float d = moving_->field.at(back * (x - t), gradient);
    if (d < DistanceField::kFar)
      use(-1.0F, x, Eigen::Vector3f(fixed_->normals.col(i)), d - clearance,
          Eigen::Vector3f(R * gradient), fixed_area);
  }
}

ContactEnergy ContactPair::energy(const RigidMotion& motion, double sigma, double penalty,
                                  double sample_fraction, const Eigen::Vector3d& centre,
                                  double length) const {
  ContactEnergy e;
  const auto inverse = static_cast<float>(1.0 / sigma);
  const Eigen::Vector3f c = centre.cast<float>();
  const auto per_length = static_cast<float>(1.0 / length);
  for_each(motion, sample_fraction,
           [&](float side, const Eigen::Vector3f& x, const Eigen::Vector3f&, float d,
               const Eigen::Vector3f& g, double area) {
             const float u = d * inverse;
             if (u > 5.0F) return;
             double slope = 0.0;   // phi'(u) / sigma
             double weight = 0.0;  // phi'(u) / u / sigma^2, > 0
             if (u >= 0.0F) {
               const double bell = std::exp(-0.5 * u * u);
               e.value -= area * bell;
               weight = bell * inverse * inverse;
             } else {
               const double root = std::sqrt(1.0 + static_cast<double>(u) * u);
               e.value += area * (penalty * (root - 1.0) - 1.0);
               weight = penalty / root * inverse * inverse;
             }
             slope = weight * d;
             Eigen::Matrix<float, 6, 1> jacobian;
             jacobian.head<3>() = side * g;
             jacobian.tail<3>() = (side * per_length) * (x - c).cross(g);
             const Vector6 j = jacobian.cast<double>();
             e.gradient += (area * slope) * j;
             e.curvature.triangularView<Eigen::Lower>() += (area * weight) * j * j.transpose();
           });
  const double scale = 1.0 / smaller_area();
  e.value *= scale;
  e.gradient *= scale;
  e.curvature *= scale;
  e.curvature.triangularView<Eigen::StrictlyUpper>() = e.curvature.transpose();
  return e;
}

ContactFit ContactPair::fit(const RigidMotion& motion, double tolerance,
                            double sample_fraction) const {
  ContactFit result;
  Eigen::Vector3d push = Eigen::Vector3d::Zero();
  const auto inverse = static_cast<float>(1.0 / tolerance);
  constexpr float kDeepest = 8.0F;  // tolerances: deeper counts no more
  for_each(motion, sample_fraction,
           [&](float side, const Eigen::Vector3f&, const Eigen::Vector3f& n, float d,
               const Eigen::Vector3f& g, double area) {
             const float u = d * inverse;
             if (u > 4.0F) return;
             if (u < 0.0F) result.penetration += 0.5 * area * std::min(-u, kDeepest);
             const float facing = -n.dot(g);
             if (facing <= 0.0F || u < -4.0F) return;
             const double weight =
                 0.5 * area * std::exp(-0.5 * static_cast<double>(u) * u) * facing;
             push += (weight * side) * n.cast<double>();
             result.contact += weight;
           });
  result.one_sided = push.norm();
  return result;
}

RigidMotion ContactPair::descend(const RigidMotion& start, double sigma, double penalty,
                                 double sample_fraction, int steps) const {
  RigidMotion best = start;
  const double length = 0.5 * moving_->reach;
  Eigen::Vector3d centre = best * moving_->centre;
  ContactEnergy here = energy(best, sigma, penalty, sample_fraction, centre, length);
  double damping = 1e-2;
  for (int step = 0; step < steps; ++step) {
    const double size = here.curvature.diagonal().maxCoeff();
    if (!(size > 0.0)) break;
    Eigen::MatrixXd damped = here.curvature;
    damped.diagonal().array() += damping * size;
    Vector6 move = -detail::solve_symmetric(damped, here.gradient);
    // A step of more than some sigma leaves what the model knows.
    const double longest = std::max(move.head<3>().norm(), 2.0 * move.tail<3>().norm());
    if (longest > 3.0 * sigma) move *= 3.0 * sigma / longest;
    const RigidMotion there = twisted(best, move, centre, length);
    const Eigen::Vector3d there_centre = there * moving_->centre;
    const ContactEnergy next = energy(there, sigma, penalty, sample_fraction, there_centre, length);
    if (next.value < here.value) {
      const double gain = here.value - next.value;
      best = there;
      centre = there_centre;
      here = next;
      damping = std::max(1e-4, damping * 0.3);
      if (gain < 1e-7 * std::abs(here.value)) break;
    } else {
      damping *= 8.0;
      if (damping > 1e4) break;
    }
  }
  return best;
}

}  // namespace mortise
