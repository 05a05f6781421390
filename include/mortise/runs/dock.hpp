// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Docking of two bodies: search, rescore, polish, cluster, rank.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "mortise/affinity/double_skin.hpp"
#include "mortise/molecules/read_molecule.hpp"
#include "mortise/runs/option_row.hpp"
#include "mortise/runs/search_plan.hpp"
#include "mortise/search/rotation_search.hpp"
#include "mortise/store/body.hpp"

namespace mortise {

/// The defaults are what ranks best per second on the training pairs: docs/ranking.md.
struct DockOptions {
  int rotations = 3600;  ///< size of the rotation set; >= 1
  SearchOptions search = {};
  DoubleSkinOptions double_skin = {};
  double radius = 1.8;  ///< of every heavy atom's knot, angstrom; 0 = each atom's own (radii.hpp)
  double merge_buried = 0.0;  ///< buried atoms are merged into balls up to this radius, angstrom
                              ///< (merge_buried.hpp); 0 = one knot per atom
  double propensity = 0.7;    ///< how much residues' interface propensities change the weights of
                              ///< exposed side chains; >= 0
  int ball_grid = 32;   ///< of a body that is a part: nodes along its longest side, by which it is
                        ///< taken apart into balls; 2 to 1024
  bool rescore = true;  ///< rank by shape plus contact potential instead of shape alone
  std::string potential =
      {};              ///< file of the contact potential; empty = fitted_contact_potential()
  bool polish = true;  ///< move the best poses uphill on their score (polish.hpp); those that come
                       ///< within the cluster radius of a better one are dropped
  int poses = 2000;    ///< poses reported, at most; >= 1
  double cluster_radius =
      3.0;  ///< poses whose ligand RMSD to a better one is below are dropped, angstrom; 0 = none
  int described = 100;  ///< best poses whose shape score's truncation error and sensitivity to an
                        ///< offset are worked out, as columns of the run; >= 0
  ReadMoleculeOptions read = {};  ///< what is taken from structure files
  std::optional<std::uint64_t> random_start =
      {};           ///< seed of a random motion that the moving body is given first: up to 50
                    ///< angstrom per axis; poses refer to the file as it is. None = as it is
  int threads = 0;  ///< 0 = all cores; never changes the result
};

/// "fast", "default" or "thorough". @throws InputError for any other name, listing these
[[nodiscard]] DockOptions dock_preset(const std::string& name);

/// Every option but threads, in the order of the help.
[[nodiscard]] std::span<const OptionRow<DockOptions>> dock_option_rows();

/// The options as one JSON object, for the run file; and back.
/// @throws InputError if this program does not know all of them
[[nodiscard]] std::string to_json(const DockOptions& options);
[[nodiscard]] DockOptions parse_dock_options(const std::string& json);

/// What a docking searches and how it ranks. Channels "shape" and, with options.rescore, "contact";
/// they and the score are those of the place where the search found the pose, before polish.
///
/// Any body will do: atoms are balls, parts are taken apart into balls. The contact potential knows
/// atoms alone.
/// @throws InputError if a molecule has no heavy atom or an option is out of range
[[nodiscard]] SearchPlan plan_dock(const Body& receptor, const Body& ligand,
                                   const DockOptions& options = {});

/// Docks: searches and ranks.
/// @throws InputError as plan_dock(); std::exception of `watch` passed on
[[nodiscard]] Run dock(const Body& receptor, const Body& ligand, const DockOptions& options = {},
                       const RunWatch& watch = {});

}  // namespace mortise
