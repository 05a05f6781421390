// SPDX-License-Identifier: GPL-3.0-or-later
// Covering radius and gradient of rotation sets with symmetry.
#include "symmetric_set.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "mortise/core/rigid_motion.hpp"

namespace mortise {
namespace {

using Eigen::Index;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::Vector4d;

// Half-edge of the cube cells start from, in balls. A wider cell has the cube's radius, still far
// too large to be kept.
constexpr double kWidestCell = 1.9;

Vector4d coordinates(const Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }

}  // namespace

Quaterniond displaced(const Quaterniond& p, const Vector3d& d) {
  return (p * Quaterniond(1.0, d.x(), d.y(), d.z())).normalized();
}

SymmetricSet::SymmetricSet(Rotations left, Rotations right, std::size_t representatives)
    : left_(std::move(left)), right_(std::move(right)) {
  const double members = static_cast<double>(left_.size() * right_.size() * representatives);
  ball_ = std::cbrt(0.75 * std::numbers::pi / members);
}

SymmetricSet::Value SymmetricSet::evaluate(const Rotations& p, double power) {
  refresh(p);
  struct Term {
    Index member;
    double log_radius;
    Vector3d slope;  // of R_v along the member's displacement
  };
  std::vector<Term> terms;
  Value value;
  for (std::size_t i = 0; i < p.size(); ++i) {
    cut(p, i);
    if (cell_.covering_angle() > value.radius) {
      value.radius = cell_.covering_angle();
      value.deepest = displaced(p[i], cell_.farthest_corner());
    }
    const auto& faces = cell_.faces();
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (const Vector3d& y : faces[f].ring) {
        std::size_t on[3] = {f, 0, 0};
        int count = 1;
        bool first = true;
        for (std::size_t k = 0; k < faces.size() && first && count < 3; ++k) {
          if (k == f || std::abs(faces[k].normal.dot(y) - faces[k].height) > 1e-10) continue;
          first = k > f;
          on[count++] = k;
        }
        if (!first || count < 3) continue;
        Eigen::Matrix4d nearest;
        nearest.col(0) << 1.0, 0.0, 0.0, 0.0;
        for (int k = 0; k < 3; ++k) nearest.col(k + 1) = near_[faces[on[k]].neighbour];
        const Vector4d mu = nearest.inverse() * Vector4d(1.0, y.x(), y.y(), y.z());
        const double share = mu(0) / mu.sum();
        const double length = y.norm();
        if (!std::isfinite(share)) continue;
        terms.push_back({static_cast<Index>(i), std::log(std::atan(length)),
                         -std::clamp(share, -4.0, 4.0) / (std::atan(length) * length) * y});
      }
  }
  double top = -1e300;
  for (const Term& t : terms) top = std::max(top, t.log_radius);
  double sum = 0.0;
  value.gradient = Eigen::VectorXd::Zero(3 * static_cast<Index>(p.size()));
  for (const Term& t : terms) {
    const double weight = std::exp(power * (t.log_radius - top));
    sum += weight;
    // Four cells share the corner and each is counted; moving one member moves the corner in all
    // four.
    value.gradient.segment<3>(3 * t.member) += 4.0 * weight * t.slope;
  }
  value.f = top + std::log(sum) / power;
  value.gradient /= sum;
  return value;
}

void SymmetricSet::refresh(const Rotations& p) {
  const double margin = 0.4 * ball_;
  bool fresh = listed_.size() == p.size();
  for (std::size_t i = 0; fresh && i < p.size(); ++i)
    fresh = rotation_angle(listed_[i], p[i]) < margin;  // margin / 2 as quaternions
  if (fresh) return;
  listed_ = p;
  const double reach_cos = std::cos(2.0 * kWidestCell * ball_ + 2.0 * margin);
  lists_.assign(p.size(), {});
  for (std::size_t j = 0; j < p.size(); ++j)
    for (std::size_t r = 0; r < right_.size(); ++r) {
      const Quaterniond pr = p[j] * right_[r];
      for (std::size_t l = 0; l < left_.size(); ++l) {
        const Vector4d copy = coordinates(left_[l] * pr);
        for (std::size_t i = 0; i < p.size(); ++i)
          if (std::abs(copy.dot(coordinates(p[i]))) > reach_cos && (i != j || l + r > 0))
            lists_[i].push_back({l, r, j});
      }
    }
}

void SymmetricSet::cut(const Rotations& p, std::size_t i) {
  near_.clear();
  const Quaterniond back = p[i].conjugate();
  for (const Copy& c : lists_[i]) {
    const Vector4d n = coordinates(back * (left_[c.left] * p[c.point] * right_[c.right]));
    near_.push_back(n(0) < 0.0 ? Vector4d(-n) : n);
  }
  std::sort(near_.begin(), near_.end(), [](const auto& a, const auto& b) { return a(0) > b(0); });
  // A wider cell than this is clipped by the cube: it then has the cube's radius, still far too
  // large to be kept.
  cell_.reset(kWidestCell * ball_);
  for (std::size_t k = 0; k < near_.size(); ++k) cell_.cut(near_[k], static_cast<Index>(k));
}

}  // namespace mortise
