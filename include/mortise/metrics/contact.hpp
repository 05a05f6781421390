// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How two parts touch at one placement, from their exact distances.
#pragma once

#include <Eigen/Core>

#include "mortise/core/rigid_motion.hpp"
#include "mortise/parts/solid.hpp"
#include "mortise/parts/triangle_mesh.hpp"

namespace mortise {

struct ContactOptions {
  double tolerance = 0.005;   ///< gap or depth up to which surfaces are in contact; fraction of the
                              ///< smaller part's diameter; > 0
  double resolution = 0.015;  ///< side of the smallest cells that the penetration's volume is
                              ///< summed over; fraction of the smaller part's diameter; > 0
  int samples = 5000;         ///< points on the smaller surface; >= 100
  int threads = 0;            ///< 0 = all cores; never changes the result
};

/// Lengths, areas and volumes in the parts' unit and its powers; directions in the fixed frame.
struct ContactReport {
  double contact_area = 0.0;        ///< facing surfaces within the tolerance, mean of both sides
  double penetration_volume = 0.0;  ///< of what both parts fill
  double penetration_depth = 0.0;   ///< largest depth of a surface point in the other part
  Eigen::Vector3d pull_direction =
      Eigen::Vector3d::Zero();  ///< the way out: unit; 0 where nothing touches
  double pull_blocked = 0.0;    ///< share of the contact that stands against it, 0 to 1: 0 = free,
                                ///< large = the parts hold each other
};

/// Measures one placement.
///
/// The depth is exact at the samples. The volume is summed over an octree: cells are dropped or
/// taken whole where a distance says so, and in the smallest cells both boundaries are taken as
/// flat. That errs by a cell's volume times the share of these cells that an edge crosses. The way
/// out is the direction u that minimises the sum over the contact of
/// max(0, -u.m)^2, m the fixed surface's outward normal.
/// @throws InputError if a mesh has no surface or an option is out of range
/// Time: some 10^5 distance queries.
[[nodiscard]] ContactReport measure_contact(const TriangleMesh& fixed_mesh, const Solid& fixed,
                                            const TriangleMesh& moving_mesh, const Solid& moving,
                                            const RigidMotion& moving_in_fixed,
                                            const ContactOptions& options = {});

/// The penetration's volume alone. @param cell  side of the smallest cells, length unit; > 0
[[nodiscard]] double penetration_volume(const Solid& fixed, const Solid& moving,
                                        const RigidMotion& moving_in_fixed, double cell,
                                        int threads = 0);

}  // namespace mortise
