// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Mating of two parts: search, polish, judge the contact, cluster, rank.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>

#include "mortise/core/knots.hpp"
#include "mortise/core/pose.hpp"
#include "mortise/parts/solid.hpp"
#include "mortise/parts/triangle_mesh.hpp"
#include "mortise/rotations/rotation_set.hpp"
#include "mortise/search/rotation_search.hpp"

namespace mortise {

/// A part as mating needs it: its surface, and what answers distance and inclusion.
struct MatePart {
  TriangleMesh mesh;
  std::shared_ptr<const Solid> solid;
};

/// Restricts the rotations to those that carry an axis of the moving part onto one of the fixed
/// part, either way round.
struct MateAxis {
  Eigen::Vector3d fixed = Eigen::Vector3d::UnitZ();   ///< input frame; any length but 0
  Eigen::Vector3d moving = Eigen::Vector3d::UnitZ();  ///< input frame; any length but 0
};

/// All lengths are fractions of the smaller part's diameter: scaling both parts changes nothing.
struct MateOptions {
  int rotations = 600;  ///< size of the rotation set, or turns about the axis; >= 1
  int aligned = 600;    ///< most rotations added that lay flat faces of the parts against each
                        ///< other, two at once; >= 0
  int turns = 60;       ///< turns added about each axis of turned faces that is laid along one of
                        ///< the other part; >= 0
  std::optional<MateAxis> axis = {};  ///< turn about this only; none = all of SO(3)
  double spacing = 0.02;              ///< of the search's grid; > 0
  double most_cells = 6e5;   ///< of the search's box, about: beyond it spacing and skin grow; > 0
  int per_rotation = 12;     ///< best translations kept at each rotation; >= 1
  double separation = 0.03;  ///< least distance between translations kept at one rotation; >= 0
  double skin = 0.03;        ///< r0, thickness of the double skin; > 0
  double penalty = 3.0;      ///< lambda, what the core weighs against the skin; > 1
  double feature = 3.0;      ///< emphasis on tips and hollows over flat faces (sampled_field.hpp);
                             ///< >= 0
  double skeletal = 0.0;     ///< weight of a second channel, the parts' skeletal densities, beside
                             ///< the double skin's 1; >= 0, 0 = none. Needs solids of meshes
  double detail = 0.01;      ///< grid step of the parts' distances, for judging contact; > 0
  double tolerance = 0.005;  ///< distance up to which surfaces are in contact; > 0
  double flat = 1.0;     ///< what contact that pushes one way counts, as far as contact that holds
                         ///< backs it; 0 to 1
  double overlap = 3.0;  ///< what an area of penetration one tolerance deep costs against an area
                         ///< of contact; >= 0
  int samples = 3000;    ///< points on the smaller surface; >= 100
  int polished = 100;    ///< placements polished to the end; >= 1
  int poses = 100;       ///< reported; >= 1
  double cluster_radius = 0.02;  ///< placements whose RMSD to a better one is below are dropped
  int threads = 0;               ///< 0 = all cores; never changes the result
};

/// "fast", "default" or "thorough". @throws InputError for any other name, listing these
[[nodiscard]] MateOptions mate_preset(const std::string& name);

/// The options as one JSON object, for the run file.
[[nodiscard]] std::string to_json(const MateOptions& options);

/// One mating run that can be stopped and taken up again.
class Mating {
 public:
  /// @throws InputError if a part has no surface or no inside, an option is out of range, or the
  /// skeletal channel is asked for and a solid is no MeshSolid
  Mating(const MatePart& fixed, const MatePart& moving, const MateOptions& options = {});
  ~Mating();
  Mating(Mating&&) noexcept;
  Mating& operator=(Mating&&) noexcept;

  /// The exhaustive part: run(), done(), candidates() and resume() of it.
  [[nodiscard]] RotationSearch& search();
  [[nodiscard]] const RotationSet& rotations() const;
  [[nodiscard]] const Knots& fixed_knots() const;   ///< input frame
  [[nodiscard]] const Knots& moving_knots() const;  ///< input frame
  /// The length that the options' fractions refer to.
  [[nodiscard]] double smaller_diameter() const;

  /// Judges, polishes and ranks what the search has found so far: best first, at most
  /// options.poses. Channels "contact" and "penetration" are areas relative to the smaller surface;
  /// the score is their sum. Of the contact's area C, F = |sum of its normals by area| pushes one
  /// way and H = C - F holds: the channel is H + flat H F / (H + F). A face laid on another has
  /// H = 0.
  [[nodiscard]] PoseList rank() const;

  /// The score and channels of one placement, as rank() gives them.
  [[nodiscard]] Pose judge(const RigidMotion& moving_in_fixed) const;
  /// A placement polished as rank() polishes its best.
  [[nodiscard]] RigidMotion polish(const RigidMotion& moving_in_fixed) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mortise
