// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of interface descriptions, pose by pose.
#include "mortise/report/interface_columns.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "mortise/core/errors.hpp"

namespace mortise {

std::vector<MetricColumn> interface_columns(const std::vector<InterfaceDescription>& descriptions,
                                            const std::vector<std::size_t>& chosen,
                                            std::size_t poses) {
  if (descriptions.size() != chosen.size())
    throw InputError("interface_columns: expected one description per chosen pose, found " +
                     std::to_string(descriptions.size()) + " for " + std::to_string(chosen.size()));
  for (const std::size_t pose : chosen)
    if (pose >= poses)
      throw InputError("interface_columns: expected indices of " + std::to_string(poses) +
                       " poses, found " + std::to_string(pose));
  std::vector<MetricColumn> columns;
  const auto add = [&](const char* name, auto value) {
    MetricColumn column{name, {}};
    column.values.assign(poses, std::numeric_limits<double>::quiet_NaN());
    for (std::size_t k = 0; k < chosen.size(); ++k)
      column.values[chosen[k]] = static_cast<double>(value(descriptions[k]));
    columns.push_back(std::move(column));
  };
  using Interface = InterfaceDescription;
  add("interface_area", [](const Interface& d) { return d.interface_area(); });
  add("buried_area", [](const Interface& d) { return d.buried_area; });
  add("contacts", [](const Interface& d) { return d.residue_contacts.size(); });
  add("hydrogen_bonds", [](const Interface& d) { return d.hydrogen_bonds.size(); });
  add("clashes", [](const Interface& d) { return d.clashes; });
  add("sc", [](const Interface& d) { return d.shape.sc; });
  return columns;
}

std::vector<MetricColumn> interface_columns(const MolecularInterface& interface,
                                            const PoseList& poses, std::size_t count, int threads) {
  std::vector<std::size_t> chosen(std::min(count, poses.poses.size()));
  std::iota(chosen.begin(), chosen.end(), std::size_t{0});
  std::vector<RigidMotion> motions;
  motions.reserve(chosen.size());
  for (const std::size_t i : chosen) motions.push_back(poses.poses[i].moving_in_fixed);
  return interface_columns(describe_poses(interface, motions, threads), chosen, poses.poses.size());
}

}  // namespace mortise
