// SPDX-License-Identifier: GPL-3.0-or-later
// Reads poses column by column, whatever else the table holds.
#include "pose_csv.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <limits>
#include <sstream>

#include "mortise/core/errors.hpp"
#include "mortise/store/atomic_file.hpp"
#include "mortise/store/csv.hpp"

namespace mortise::app {
namespace {

constexpr std::array<const char*, 7> kColumns = {"qw", "qx", "qy", "qz", "tx", "ty", "tz"};

}  // namespace

std::vector<RigidMotion> read_pose_csv(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  if (!file) throw FileError(path, "cannot be read");
  if (!std::getline(file, line)) throw FileError(path, "is empty; expected a head with qw ... tz");
  const std::vector<std::string> head = csv_cells(line);
  std::array<std::size_t, 7> place = {};
  for (std::size_t c = 0; c < kColumns.size(); ++c) {
    while (place[c] < head.size() && head[place[c]] != kColumns[c]) ++place[c];
    if (place[c] == head.size())
      throw FileError(path, 1, std::string("expected a column ") + kColumns[c]);
  }
  std::vector<RigidMotion> poses;
  for (long number = 2; std::getline(file, line); ++number) {
    if (line.empty() || line == "\r") continue;
    const std::vector<std::string> fields = csv_cells(line);
    std::array<double, 7> v = {};
    for (std::size_t c = 0; c < v.size(); ++c) {
      const std::string text = place[c] < fields.size() ? fields[place[c]] : "";
      const auto result = std::from_chars(text.data(), text.data() + text.size(), v[c]);
      if (result.ec != std::errc() || result.ptr != text.data() + text.size() ||
          !std::isfinite(v[c]))
        throw FileError(
            path, number,
            std::string("expected a number for ") + kColumns[c] + ", got \"" + text + '"');
    }
    RigidMotion pose{Eigen::Quaterniond(v[0], v[1], v[2], v[3]), {v[4], v[5], v[6]}};
    if (!(std::abs(pose.rotation.norm() - 1.0) < 1e-3))
      throw FileError(
          path, number,
          "expected a quaternion of norm 1, got norm " + std::to_string(pose.rotation.norm()));
    pose.rotation = canonical(pose.rotation);
    poses.push_back(pose);
  }
  return poses;
}

void write_pose_csv(const std::string& path, const std::vector<RigidMotion>& poses) {
  std::ostringstream text;
  text << "qw,qx,qy,qz,tx,ty,tz\n" << std::setprecision(std::numeric_limits<double>::max_digits10);
  for (const RigidMotion& pose : poses)
    text << pose.rotation.w() << ',' << pose.rotation.x() << ',' << pose.rotation.y() << ','
         << pose.rotation.z() << ',' << pose.translation[0] << ',' << pose.translation[1] << ','
         << pose.translation[2] << '\n';
  write_file_atomically(path, text.str());
}

}  // namespace mortise::app
