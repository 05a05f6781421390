// SPDX-License-Identifier: GPL-3.0-or-later
// Poses from and to CSV.
#pragma once

#include <string>
#include <vector>

#include "mortise/core/rigid_motion.hpp"

namespace mortise::app {

/// Poses of a CSV file whose head names columns qw, qx, qy, qz, tx, ty, tz (others are skipped), as
/// `mortise export --format csv` writes them. @throws FileError
[[nodiscard]] std::vector<RigidMotion> read_pose_csv(const std::string& path);

/// @throws FileError if the file cannot be written
void write_pose_csv(const std::string& path, const std::vector<RigidMotion>& poses);

}  // namespace mortise::app
