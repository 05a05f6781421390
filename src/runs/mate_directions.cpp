// SPDX-License-Identifier: GPL-3.0-or-later
// Directions of faces and the rotations that align them.
#include "runs/mate_directions.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "mortise/core/rigid_motion.hpp"
#include "mortise/core/rotation_vector.hpp"

namespace mortise {
namespace {

struct Bin {
  Eigen::Vector3d normal;  // mean, unit
  double area;
};

// Normals gathered in cells about half a degree wide, by decreasing area.
std::vector<Bin> normal_bins(const TriangleMesh& mesh) {
  std::map<std::array<int, 3>, Eigen::Vector3d> cells;
  for (Eigen::Index t = 0; t < mesh.size(); ++t) {
    const Eigen::Vector3d a = mesh.vertices.col(mesh.triangles(0, t));
    const Eigen::Vector3d b = mesh.vertices.col(mesh.triangles(1, t));
    const Eigen::Vector3d c = mesh.vertices.col(mesh.triangles(2, t));
    const Eigen::Vector3d n = 0.5 * (b - a).cross(c - a);
    if (!(n.norm() > 0.0)) continue;
    const Eigen::Vector3d u = 100.0 * n.normalized();
    auto& cell =
        cells
            .try_emplace({static_cast<int>(std::lround(u[0])), static_cast<int>(std::lround(u[1])),
                          static_cast<int>(std::lround(u[2]))},
                         Eigen::Vector3d::Zero())
            .first->second;
    cell += n;
  }
  std::vector<Bin> bins;
  bins.reserve(cells.size());
  for (const auto& [key, sum] : cells) bins.push_back({sum.normalized(), sum.norm()});
  std::stable_sort(bins.begin(), bins.end(),
                   [](const Bin& a, const Bin& b) { return a.area > b.area; });
  return bins;
}

struct Axis {
  Eigen::Vector3d direction;
  double area;
};

// The axis near `guess` whose ring of normals is best, or area 0 if they do not go all around it.
Axis turned_about(const std::vector<Bin>& bins, const Eigen::Vector3d& guess) {
  constexpr int kSectors = 24;
  constexpr double kOff = 0.03;  // sine: facets of a turned face lie this close to the ring
  Axis axis{guess, 0.0};
  for (int sweep = 0; sweep < 2; ++sweep) {
    const Eigen::Vector3d x = axis.direction.unitOrthogonal();
    const Eigen::Vector3d y = axis.direction.cross(x);
    std::array<double, kSectors> sectors = {};
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    double area = 0.0;
    for (const Bin& bin : bins) {
      if (std::abs(bin.normal.dot(axis.direction)) > kOff) continue;
      const double angle = std::atan2(bin.normal.dot(y), bin.normal.dot(x));
      sectors[static_cast<std::size_t>((angle / (2.0 * std::numbers::pi) + 1.0) * kSectors) %
              kSectors] += bin.area;
      spread += bin.area * bin.normal * bin.normal.transpose();
      area += bin.area;
    }
    const auto filled = std::count_if(sectors.begin(), sectors.end(),
                                      [&](double s) { return s > 0.1 * area / kSectors; });
    if (filled < kSectors * 3 / 8) return {guess, 0.0};
    axis.area = area;
    axis.direction = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
  }
  return axis;
}

bool parallel(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double degrees) {
  return std::abs(a.dot(b)) > std::cos(degrees * std::numbers::pi / 180.0);
}

// Carries m1 to f1 and m2 as near to f2 as can be.
Eigen::Quaterniond laying(const Eigen::Vector3d& f1, const Eigen::Vector3d& f2,
                          const Eigen::Vector3d& m1, const Eigen::Vector3d& m2) {
  const auto frame = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    Eigen::Matrix3d f;
    f.col(0) = a;
    f.col(2) = a.cross(b).normalized();
    f.col(1) = f.col(2).cross(a);
    return f;
  };
  return canonical(Eigen::Quaterniond(Eigen::Matrix3d(frame(f1, f2) * frame(m1, m2).transpose())));
}

class RotationList {
 public:
  void add(const Eigen::Quaterniond& q) {
    constexpr double kSame = 0.017;  // a degree
    for (const Eigen::Quaterniond& old : rotations_)
      if (rotation_angle(old, q) < kSame) return;
    rotations_.push_back(q);
  }
  [[nodiscard]] std::size_t size() const { return rotations_.size(); }
  [[nodiscard]] Eigen::Matrix4Xd quaternions() const {
    Eigen::Matrix4Xd result(4, static_cast<Eigen::Index>(rotations_.size()));
    for (std::size_t i = 0; i < rotations_.size(); ++i) {
      const Eigen::Quaterniond& q = rotations_[i];
      result.col(static_cast<Eigen::Index>(i)) << q.w(), q.x(), q.y(), q.z();
    }
    return result;
  }

 private:
  std::vector<Eigen::Quaterniond> rotations_;
};

}  // namespace

Directions find_directions(const TriangleMesh& mesh) {
  const std::vector<Bin> bins = normal_bins(mesh);
  double total = 0.0;
  for (const Bin& bin : bins) total += bin.area;

  std::vector<Axis> axes;
  const std::size_t lead = std::min<std::size_t>(bins.size(), 40);
  std::vector<Eigen::Vector3d> tried;
  for (std::size_t i = 0; i < lead; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Eigen::Vector3d cross = bins[i].normal.cross(bins[j].normal);
      if (cross.norm() < 0.1) continue;
      const Eigen::Vector3d guess = cross.normalized();
      if (std::any_of(tried.begin(), tried.end(),
                      [&](const Eigen::Vector3d& t) { return parallel(t, guess, 1.0); }))
        continue;
      tried.push_back(guess);
      const Axis axis = turned_about(bins, guess);
      if (axis.area < 0.04 * total) continue;
      const auto same = std::find_if(axes.begin(), axes.end(), [&](const Axis& a) {
        return parallel(a.direction, axis.direction, 5.0);
      });
      if (same == axes.end())
        axes.push_back(axis);
      else if (axis.area > same->area)
        *same = axis;
    }
  std::stable_sort(axes.begin(), axes.end(),
                   [](const Axis& a, const Axis& b) { return a.area > b.area; });

  Directions found;
  for (std::size_t i = 0; i < std::min<std::size_t>(axes.size(), 3); ++i)
    found.axes.push_back(axes[i].direction);
  for (std::size_t i = 0; i < std::min<std::size_t>(bins.size(), 200); ++i) {
    if (found.normals.size() == 16) break;
    const Eigen::Vector3d& n = bins[i].normal;
    if (std::any_of(found.normals.begin(), found.normals.end(),
                    [&](const Eigen::Vector3d& f) { return f.dot(n) > 0.9986; }))
      continue;
    double area = 0.0;
    for (const Bin& bin : bins)
      if (bin.normal.dot(n) > 0.9997) area += bin.area;
    // A facet of a turned face is no flat face.
    const bool facet = std::any_of(axes.begin(), axes.end(), [&](const Axis& a) {
      return std::abs(n.dot(a.direction)) < 0.03 && area < 0.15 * a.area;
    });
    if (area >= 0.01 * total && !facet) found.normals.push_back(n);
  }
  return found;
}

Eigen::Matrix4Xd aligned_rotations(const Directions& fixed, const Directions& moving, int turns,
                                   int most) {
  // Of one kind of direction only those of the other part's kind can fall into place.
  struct Direction {
    Eigen::Vector3d along;
    bool axis;
    std::size_t place;  // by area
  };
  const auto all = [](const Directions& d, double sign) {
    std::vector<Direction> result;
    for (std::size_t i = 0; i < d.normals.size(); ++i)
      result.push_back({sign * d.normals[i], false, i});
    for (std::size_t i = 0; i < d.axes.size(); ++i)
      for (const double way : {1.0, -1.0}) result.push_back({way * d.axes[i], true, i});
    return result;
  };
  const std::vector<Direction> f = all(fixed, -1.0);  // faces in contact look at each other
  const std::vector<Direction> m = all(moving, 1.0);
  struct Match {
    std::size_t cost;
    Eigen::Quaterniond rotation;
  };
  std::vector<Match> matches;
  constexpr double kSameAngle = 0.03;
  for (const Direction& f1 : f)
    for (const Direction& m1 : m) {
      if (f1.axis != m1.axis) continue;
      for (const Direction& f2 : f) {
        const double cosine = f1.along.dot(f2.along);
        if (std::abs(cosine) > 0.94) continue;
        for (const Direction& m2 : m) {
          if (f2.axis != m2.axis) continue;
          // Rounding may carry the product of a direction with itself past 1.
          const double moving_cosine = std::clamp(m1.along.dot(m2.along), -1.0, 1.0);
          if (std::abs(std::acos(moving_cosine) - std::acos(cosine)) > kSameAngle) continue;
          matches.push_back({f1.place + f2.place + m1.place + m2.place,
                             laying(f1.along, f2.along, m1.along, m2.along)});
        }
      }
    }
  std::stable_sort(matches.begin(), matches.end(),
                   [](const Match& a, const Match& b) { return a.cost < b.cost; });
  RotationList list;
  for (const Match& match : matches) {
    if (list.size() >= static_cast<std::size_t>(most)) break;
    list.add(match.rotation);
  }
  for (const Eigen::Vector3d& to : fixed.axes)
    for (const Eigen::Vector3d& from : moving.axes)
      for (const double way : {1.0, -1.0}) {
        const Eigen::Quaterniond lay = rotation_between(from, way * to);
        for (int i = 0; i < turns; ++i)
          list.add(canonical(
              Eigen::Quaterniond(Eigen::AngleAxisd(2.0 * std::numbers::pi * i / turns, to)) * lay));
      }
  return list.quaternions();
}

}  // namespace mortise
