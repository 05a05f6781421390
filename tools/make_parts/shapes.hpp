// SPDX-License-Identifier: GPL-3.0-or-later
// Solids the sample parts are put together from; lengths in mm.
#pragma once

#include <Eigen/Core>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <vector>

namespace mortise::parts_maker {

inline const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

TopoDS_Shape box(const Eigen::Vector3d& low, const Eigen::Vector3d& high);
/// From `base` along `axis` (any length) for `height`.
TopoDS_Shape cylinder(const Eigen::Vector3d& base, const Eigen::Vector3d& axis, double radius,
                      double height);
/// Along +z from `base`, radius `low` there and `high` at the top.
TopoDS_Shape cone(const Eigen::Vector3d& base, double low, double high, double height);
TopoDS_Shape ball(const Eigen::Vector3d& centre, double radius);
/// A closed polygon in space, swept by `sweep`.
TopoDS_Shape prism(const std::vector<Eigen::Vector3d>& polygon, const Eigen::Vector3d& sweep);
/// A regular polygon around the z axis through `base`: distance of the flats from it, first
/// corner's angle.
TopoDS_Shape regular_prism(int sides, double flat_radius, double first_corner,
                           const Eigen::Vector3d& base, double height);

TopoDS_Shape fuse(const TopoDS_Shape& a, const TopoDS_Shape& b);
TopoDS_Shape cut(const TopoDS_Shape& a, const TopoDS_Shape& b);
TopoDS_Shape common(const TopoDS_Shape& a, const TopoDS_Shape& b);

}  // namespace mortise::parts_maker
