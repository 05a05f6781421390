// SPDX-License-Identifier: GPL-3.0-or-later
// Crossing triangles by CGAL's box sweep and exact predicates.
#include "parts/self_intersections.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <Eigen/Geometry>
#include <algorithm>

namespace mortise::parts {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Box = CGAL::Box_intersection_d::Box_d<double, 3, CGAL::Box_intersection_d::ID_NONE>;

/// A triangle's bounding box.
class IndexedBox : public Box {
 public:
  using ID = std::size_t;  // the name CGAL asks for
  IndexedBox() = default;
  IndexedBox(int triangle, const CGAL::Bbox_3& box) : Box(box), triangle_(triangle) {}
  [[nodiscard]] int triangle() const { return triangle_; }
  [[nodiscard]] ID id() const { return static_cast<ID>(triangle_); }

 private:
  int triangle_ = -1;
};

struct EnoughFound {};

class Test {
 public:
  explicit Test(const Surface& surface) : surface_(surface) {}

  [[nodiscard]] bool cross(int i, int j) const {
    std::array<int, 3> a = surface_.triangles[static_cast<std::size_t>(i)];
    std::array<int, 3> b = surface_.triangles[static_cast<std::size_t>(j)];
    // Common points to the front of both.
    std::size_t shared = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto same = std::find(b.begin() + static_cast<std::ptrdiff_t>(shared), b.end(), a[k]);
      if (same == b.end()) continue;
      std::swap(b[shared], *same);
      std::swap(a[shared], a[k]);
      ++shared;
    }
    if (shared == 3) return true;
    if (shared == 2) return folded(a, b);
    if (shared == 1) {
      return CGAL::do_intersect(triangle(a), Kernel::Segment_3(point(b[1]), point(b[2]))) ||
             CGAL::do_intersect(triangle(b), Kernel::Segment_3(point(a[1]), point(a[2])));
    }
    return CGAL::do_intersect(triangle(a), triangle(b));
  }

 private:
  [[nodiscard]] Kernel::Point_3 point(int v) const {
    const Eigen::Vector3d& p = surface_.points[static_cast<std::size_t>(v)];
    return {p.x(), p.y(), p.z()};
  }
  [[nodiscard]] Kernel::Triangle_3 triangle(const std::array<int, 3>& t) const {
    return {point(t[0]), point(t[1]), point(t[2])};
  }
  /// Two triangles with an edge in common cross only if they lie on each other.
  [[nodiscard]] bool folded(const std::array<int, 3>& a, const std::array<int, 3>& b) const {
    return CGAL::coplanar(point(a[0]), point(a[1]), point(a[2]), point(b[2])) &&
           CGAL::coplanar_orientation(point(a[0]), point(a[1]), point(a[2]), point(b[2])) ==
               CGAL::POSITIVE;
  }

  const Surface& surface_;
};

}  // namespace

Crossings find_crossings(const Surface& surface, long most) {
  std::vector<IndexedBox> boxes;
  boxes.reserve(surface.triangles.size());
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const auto& t = surface.triangles[i];
    Eigen::Vector3d low = surface.points[static_cast<std::size_t>(t[0])];
    Eigen::Vector3d high = low;
    for (const int v : t) {
      low = low.cwiseMin(surface.points[static_cast<std::size_t>(v)]);
      high = high.cwiseMax(surface.points[static_cast<std::size_t>(v)]);
    }
    boxes.emplace_back(static_cast<int>(i),
                       CGAL::Bbox_3(low.x(), low.y(), low.z(), high.x(), high.y(), high.z()));
  }
  const Test test(surface);
  Crossings found;
  int first = -1;
  try {
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(),
                                  [&](const IndexedBox& a, const IndexedBox& b) {
                                    if (!test.cross(a.triangle(), b.triangle())) return;
                                    if (found.pairs == most) throw EnoughFound{};
                                    ++found.pairs;
                                    const int lower = std::min(a.triangle(), b.triangle());
                                    if (first < 0 || lower < first) first = lower;
                                  });
  } catch (const EnoughFound&) {
    found.more = true;
  }
  if (first >= 0) {
    for (const int v : surface.triangles[static_cast<std::size_t>(first)])
      found.first += surface.points[static_cast<std::size_t>(v)] / 3.0;
  }
  return found;
}

}  // namespace mortise::parts
