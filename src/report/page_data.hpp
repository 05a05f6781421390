// SPDX-License-Identifier: GPL-3.0-or-later
// What the page shows, as JSON; web/page/data.js reads it.
#pragma once

#include <Eigen/Core>
#include <string>

#include "mortise/report/bodies.hpp"
#include "mortise/report/clusters.hpp"

namespace mortise::detail {

// @param frequency  touch_frequency() of the best frequency_poses poses
[[nodiscard]] std::string page_data(const Run& run, const ReportBodies& bodies,
                                    const ReportClusters& clusters,
                                    const Eigen::VectorXd& frequency, int frequency_poses);

// "1hpv_receptor" of "some/where/1hpv_receptor.pdb.gz#2:A".
[[nodiscard]] std::string body_name(const BodyRecord& body);

}  // namespace mortise::detail
