// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Docking of two molecules: search, rescore, cluster, rank.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mortise/affinity/double_skin.hpp"
#include "mortise/core/pose.hpp"
#include "mortise/molecules/molecule.hpp"
#include "mortise/rotations/rotation_set.hpp"
#include "mortise/search/rotation_search.hpp"

namespace mortise {

/// The defaults are what ranks best per second on the training pairs: docs/ranking.md.
struct DockOptions {
  int rotations = 3600;  ///< size of the rotation set; >= 1
  SearchOptions search = {};
  DoubleSkinOptions double_skin = {};
  double radius = 1.8;      ///< of every heavy atom's knot, angstrom; > 0
  double propensity = 0.7;  ///< how much residues' interface propensities change the weights of
                            ///< exposed side chains; >= 0
  bool rescore = true;      ///< rank by shape plus contact potential instead of shape alone
  std::string potential =
      {};              ///< file of the contact potential; empty = fitted_contact_potential()
  bool polish = true;  ///< move the best poses uphill on their score (polish.hpp); those that come
                       ///< within the cluster radius of a better one are dropped
  int poses = 2000;    ///< poses reported, at most; >= 1
  double cluster_radius =
      3.0;  ///< poses whose ligand RMSD to a better one is below are dropped, angstrom; 0 = none
  int threads = 0;  ///< 0 = all cores; never changes the result
};

/// "fast", "default" or "thorough". @throws InputError for any other name, listing these
[[nodiscard]] DockOptions dock_preset(const std::string& name);

/// The options as one JSON object, for the run file.
[[nodiscard]] std::string to_json(const DockOptions& options);

/// One docking run that can be stopped and taken up again.
class Docking {
 public:
  /// @throws InputError if a molecule has no heavy atom or an option is out of range
  Docking(const Molecule& fixed, const Molecule& moving, const DockOptions& options = {});
  ~Docking();
  Docking(Docking&&) noexcept;
  Docking& operator=(Docking&&) noexcept;

  /// The exhaustive part: run(), done(), candidates() and resume() of it.
  [[nodiscard]] RotationSearch& search();
  [[nodiscard]] const RotationSet& rotations() const;
  [[nodiscard]] const Knots& fixed_knots() const;   ///< input frame
  [[nodiscard]] const Knots& moving_knots() const;  ///< input frame

  /// Ranks what the search has found so far: best first, at most options.poses.
  /// Channels: "shape", and with options.rescore "contact"; they and the score are those of the
  /// place where the search found the pose, before polish.
  [[nodiscard]] PoseList rank() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mortise
