// SPDX-License-Identifier: GPL-3.0-or-later
// Circles of probe centres, clipped by the other balls.
#include "metrics/probe_arcs.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace mortise::detail {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// Takes the angles [low, high] away from all arcs.
void cut(std::vector<ProbeArc>& arcs, double low, double high, std::int32_t owner,
         std::vector<ProbeArc>& scratch) {
  scratch.clear();
  for (const ProbeArc& arc : arcs) {
    if (arc.from_owner < 0) {  // the full circle
      scratch.push_back({high, low + kTurn, owner, owner});
      continue;
    }
    const double turns = kTurn * std::floor((low - arc.from) / kTurn);
    const double begin = low - turns, end = high - turns;  // begin in [from, from + 2 pi)
    ProbeArc first = arc, second = arc;
    if (end - kTurn > arc.from) {
      first.from = end - kTurn;
      first.from_owner = owner;
    }
    if (begin < first.to) {
      first.to = begin;
      first.to_owner = owner;
    }
    if (first.from < first.to) scratch.push_back(first);
    if (end < arc.to) {
      second.from = end;
      second.from_owner = owner;
      scratch.push_back(second);
    }
  }
  arcs.swap(scratch);
}

}  // namespace

Eigen::Vector3d ProbeCircle::radial(double angle) const {
  return std::cos(angle) * e1 + std::sin(angle) * e2;
}

bool probe_circle(const GrownBalls& balls, std::int32_t i, std::int32_t j, ProbeCircle& circle) {
  const Eigen::Vector3d step = balls.centres.col(j) - balls.centres.col(i);
  const double d_sq = step.squaredNorm(), d = std::sqrt(d_sq);
  const double Ri = balls.radii[i], Rj = balls.radii[j];
  if (d >= Ri + Rj || d <= std::abs(Ri - Rj)) return false;
  circle.from_i = (d_sq + Ri * Ri - Rj * Rj) / (2.0 * d);
  circle.from_j = d - circle.from_i;
  const double radius_sq = Ri * Ri - circle.from_i * circle.from_i;
  if (!(radius_sq > 0.0)) return false;
  circle.radius = std::sqrt(radius_sq);
  circle.axis = step / d;
  circle.centre = balls.centres.col(i) + circle.from_i * circle.axis;
  Eigen::Index smallest = 0;
  circle.axis.cwiseAbs().minCoeff(&smallest);
  circle.e1 = circle.axis.cross(Eigen::Vector3d::Unit(smallest)).normalized();
  circle.e2 = circle.axis.cross(circle.e1);
  return true;
}

std::vector<ProbeArc> free_arcs(const GrownBalls& balls, const ProbeCircle& circle, std::int32_t i,
                                std::int32_t j, const std::vector<std::int32_t>& others) {
  std::vector<ProbeArc> arcs{{0.0, kTurn, -1, -1}}, scratch;
  for (const std::int32_t k : others) {
    if (k == i || k == j) continue;
    const Eigen::Vector3d v = balls.centres.col(k) - circle.centre;
    const double R = balls.radii[k], reach = R + circle.radius;
    const double v_sq = v.squaredNorm();
    if (v_sq >= reach * reach) continue;
    // Ball k cuts the circle's plane in a disc of radius s, its centre at distance w.
    const double height = v.dot(circle.axis);
    const double s_sq = R * R - height * height;
    if (s_sq <= 0.0) continue;
    const double w_sq = v_sq - height * height, w = std::sqrt(std::max(0.0, w_sq));
    const double above = circle.radius * circle.radius + w_sq - s_sq;
    const double scale = 2.0 * circle.radius * w;  // cos(half of the angle hidden) = above / scale
    if (above >= scale) continue;                  // the circle lies outside the disc
    if (above <= -scale) return {};                // within
    const double middle = std::atan2(v.dot(circle.e2), v.dot(circle.e1));
    const double half = std::acos(above / scale);
    cut(arcs, middle - half, middle + half, k, scratch);
    if (arcs.empty()) break;
  }
  return arcs;
}

}  // namespace mortise::detail
