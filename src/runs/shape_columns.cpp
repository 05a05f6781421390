// SPDX-License-Identifier: GPL-3.0-or-later
// Truncation and sensitivity of shape scores.
#include "runs/shape_columns.hpp"

#include <algorithm>
#include <limits>

#include "mortise/scoring/shape_scores.hpp"

namespace mortise {

std::vector<MetricColumn> shape_columns(const Channel& channel, const PoseList& poses,
                                        const std::vector<FoundPose>& found,
                                        const ShapeColumnsOptions& options) {
  const std::size_t count = std::min(options.count, poses.poses.size());
  std::vector<MetricColumn> columns;
  for (const char* name : {"shape_low_pass", "shape_spread", "shape_offset_slope"})
    columns.push_back(
        {name, std::vector<double>(poses.poses.size(), std::numeric_limits<double>::quiet_NaN())});
  if (count == 0) return columns;
  std::vector<RigidMotion> starts, ends;
  std::vector<double> scores;
  for (std::size_t i = 0; i < count; ++i) {
    starts.push_back(found[i].moving_in_fixed);
    scores.push_back(found[i].score);
    ends.push_back(poses.poses[i].moving_in_fixed);
  }
  LowPassedScoresOptions low_passed{.low_pass = {.cutoff = options.cutoff},
                                    .radius_tolerance = options.radius_tolerance,
                                    // coarser than the default: what that leaves out is in the
                                    // spread's column, and takes a third of the time
                                    .spacing = 0.375 / options.cutoff,
                                    .threads = options.threads};
  const std::vector<Truncation> truncation = score_truncation(channel, starts, scores, low_passed);
  // The score is smooth in the offset: the difference's own error is some 1e-3 of the slope.
  const double step = 0.02 / options.cutoff;
  low_passed.offsets = {-step, step};
  const Eigen::MatrixXd near = low_passed_scores(channel, ends, low_passed);
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    columns[0].values[i] = options.weight * truncation[i].low_pass;
    columns[1].values[i] = options.weight * truncation[i].spread;
    columns[2].values[i] = options.weight * (near(1, at) - near(0, at)) / (2.0 * step);
  }
  return columns;
}

}  // namespace mortise
