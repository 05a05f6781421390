// SPDX-License-Identifier: GPL-3.0-or-later
// What the page shows, as JSON; web/page/data.js reads it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>

#include "mortise/report/bodies.hpp"
#include "mortise/report/clusters.hpp"

namespace mortise::detail {

// What became of a part on its way to the page.
struct PagePart {
  Eigen::Index triangles = 0;  // in the file
  double deviation = 0.0;      // of the part shown
};

// @param bodies     as the page shows them
// @param parts      fixed, moving
// @param frequency  touch_frequency() of the best frequency_poses poses
[[nodiscard]] std::string page_data(const Run& run, const ReportBodies& bodies,
                                    const std::array<PagePart, 2>& parts,
                                    const ReportClusters& clusters,
                                    const Eigen::VectorXd& frequency, int frequency_poses);

// "1hpv_receptor" of "some/where/1hpv_receptor.pdb.gz#2:A".
[[nodiscard]] std::string body_name(const BodyRecord& body);

}  // namespace mortise::detail
