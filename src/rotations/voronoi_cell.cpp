// SPDX-License-Identifier: GPL-3.0-or-later
// Clipping Voronoi cells of rotations.
#include "rotations/voronoi_cell.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mortise {
namespace {

// Grows with the angle of (x, y) from -2 to 2, without trigonometry.
double pseudo_angle(double x, double y) {
  const double p = x / (std::abs(x) + std::abs(y));
  return y < 0.0 ? p - 1.0 : 1.0 - p;
}

}  // namespace

Eigen::Vector4d relative_rotation(const Eigen::Vector4d& a, const Eigen::Vector4d& b) {
  const Eigen::Vector3d u = a.tail<3>();
  const Eigen::Vector3d v = b.tail<3>();
  Eigen::Vector4d r;
  r << a.dot(b), a(0) * v - b(0) * u - u.cross(v);
  return r;
}

void VoronoiCell::reset(double half_edge) {
  // Corners this near a plane lie on it: rounding must not decide. It makes no cell too small.
  slack_ = 1e-12 * std::max(1.0, 1e-3 * half_edge);
  faces_.resize(6);
  for (int f = 0; f < 6; ++f) {
    const int axis = f / 2;
    const double side = f % 2 == 0 ? 1.0 : -1.0;
    Face& face = faces_[f];
    face.normal = side * Eigen::Vector3d::Unit(axis);
    face.height = half_edge;
    face.neighbour = -1;
    face.ring.resize(4);
    for (int c = 0; c < 4; ++c) {
      Eigen::Vector3d& corner = face.ring[c];
      corner(axis) = side * half_edge;
      corner((axis + 1) % 3) = (c == 0 || c == 3 ? 1.0 : -1.0) * half_edge;
      corner((axis + 2) % 3) = (c < 2 ? 1.0 : -1.0) * half_edge;
    }
  }
  farthest_ = std::sqrt(3.0) * half_edge;
}

// Puts the corners of the new face in order round it and drops repeated ones: each edge cut gives
// two.
void VoronoiCell::order_section(const Eigen::Vector3d& normal) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const auto& y : section_) centre += y;
  centre /= static_cast<double>(section_.size());
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.cross(u);
  turns_.clear();
  for (const auto& y : section_)
    turns_.emplace_back(pseudo_angle((y - centre).dot(u), (y - centre).dot(v)), y);
  std::sort(turns_.begin(), turns_.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  const auto same = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return (a - b).cwiseAbs().maxCoeff() <= 4.0 * slack_;
  };
  section_.clear();
  for (const auto& [turn, y] : turns_)
    if (section_.empty() || !same(section_.back(), y)) section_.push_back(y);
  while (section_.size() > 1 && same(section_.front(), section_.back())) section_.pop_back();
}

void VoronoiCell::cut(const Eigen::Vector4d& relative, Eigen::Index neighbour) {
  // x is nearer to q than to p where (q - p).x > 0; with x ~ q (1, y) and p = q (c, s): s.y < 1 -
  // c.
  const Eigen::Vector3d s = relative.tail<3>();
  const double sine = s.norm();
  if (sine < 1e-14) return;  // the same rotation again, or its other quaternion
  const Eigen::Vector3d normal = s / sine;
  // (1 - c) / sine without cancellation: the tangent of half the quaternions' angle
  const double height = relative(0) > 0.0 ? sine / (1.0 + relative(0)) : (1.0 - relative(0)) / sine;
  if (height >= farthest_) return;

  const auto above = [&](const Eigen::Vector3d& y) { return normal.dot(y) - height; };
  const bool cuts = std::any_of(faces_.begin(), faces_.end(), [&](const Face& face) {
    return std::any_of(face.ring.begin(), face.ring.end(),
                       [&](const auto& y) { return above(y) > slack_; });
  });
  if (!cuts) return;

  section_.clear();
  for (Face& face : faces_) {
    ring_.clear();
    for (std::size_t i = 0; i < face.ring.size(); ++i) {
      const Eigen::Vector3d& a = face.ring[i];
      const Eigen::Vector3d& b = face.ring[i + 1 < face.ring.size() ? i + 1 : 0];
      const double da = above(a);
      const double db = above(b);
      if (da <= slack_) ring_.push_back(a);
      if (std::abs(da) <= slack_) section_.push_back(a);
      if ((da < -slack_ && db > slack_) || (da > slack_ && db < -slack_)) {
        ring_.emplace_back(a + (b - a) * (da / (da - db)));
        section_.push_back(ring_.back());
      }
    }
    face.ring.swap(ring_);
  }
  faces_.erase(std::remove_if(faces_.begin(), faces_.end(),
                              [](const Face& face) { return face.ring.size() < 3; }),
               faces_.end());
  if (!section_.empty()) order_section(normal);
  if (section_.size() >= 3) faces_.push_back({normal, height, neighbour, section_});

  double farthest_sq = 0.0;
  for (const Face& face : faces_)
    for (const auto& y : face.ring) farthest_sq = std::max(farthest_sq, y.squaredNorm());
  farthest_ = std::sqrt(farthest_sq);
}

Eigen::Vector3d VoronoiCell::farthest_corner() const {
  Eigen::Vector3d corner = Eigen::Vector3d::Zero();
  for (const Face& face : faces_)
    for (const auto& y : face.ring)
      if (y.squaredNorm() > corner.squaredNorm()) corner = y;
  return corner;
}

double VoronoiCell::covering_angle() const {
  return farthest_ >= kFarthest ? std::numbers::pi : 2.0 * std::atan(farthest_);
}

void cut_cell(const Eigen::Matrix4Xd& quaternions, const RotationIndex& index, Eigen::Index member,
              VoronoiCell& cell) {
  struct Neighbour {
    Eigen::Vector4d relative;
    Eigen::Index label;
  };
  const Eigen::Vector4d q = quaternions.col(member);
  const Eigen::Quaterniond centre(q(0), q(1), q(2), q(3));
  // Twice the radius of a ball of the cells' mean volume, doubled; a cell that needs more asks
  // again.
  double reach = 6.0 * std::cbrt(0.75 * std::numbers::pi / static_cast<double>(index.size()));
  double half_edge = std::min(reach, VoronoiCell::kFarthest);
  std::vector<Neighbour> near;
  for (;;) {
    near.clear();
    const bool all = reach >= std::numbers::pi;
    for (const Eigen::Index i : index.within(centre, reach)) {
      if (i == member) continue;
      const Eigen::Vector4d relative = relative_rotation(q, quaternions.col(i));
      near.push_back({relative(0) < 0.0 ? Eigen::Vector4d(-relative) : relative, i});
      if (all) near.push_back({-near.back().relative, i});  // the far quaternion may count too
    }
    std::sort(near.begin(), near.end(), [](const Neighbour& a, const Neighbour& b) {
      return a.relative(0) > b.relative(0) || (a.relative(0) == b.relative(0) && a.label < b.label);
    });
    cell.reset(half_edge);
    for (const Neighbour& n : near) cell.cut(n.relative, n.label);
    const bool boxed = cell.farthest() >= half_edge && half_edge < VoronoiCell::kFarthest;
    // Whoever cuts off a point at angle a from q lies within 2 a of q.
    const double needed = 4.0 * std::atan(cell.farthest());
    if (!boxed && (all || needed <= reach)) return;
    if (boxed) half_edge = std::min(16.0 * half_edge, VoronoiCell::kFarthest);
    if (!all) reach = std::max(reach, 1.0001 * needed);
  }
}

}  // namespace mortise
