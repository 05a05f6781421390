// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Mating of two parts: search, polish, judge the contact, cluster, rank.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mortise/runs/option_row.hpp"
#include "mortise/runs/search_plan.hpp"
#include "mortise/store/body.hpp"

namespace mortise {

/// Restricts the rotations to those that carry an axis of the moving part onto one of the fixed
/// part, either way round.
struct MateAxis {
  Eigen::Vector3d fixed = Eigen::Vector3d::UnitZ();   ///< input frame; any length but 0
  Eigen::Vector3d moving = Eigen::Vector3d::UnitZ();  ///< input frame; any length but 0
};

/// What the search scores.
enum class PartKnots {
  kNodes,  ///< the double skin sampled at the nodes of a grid (sampled_field.hpp)
  kBalls,  ///< a spherical decomposition, overlaps divided among the balls (double_skin.hpp)
};

/// Lengths are fractions of the smaller part's diameter where nothing else is said: scaling both
/// parts changes nothing.
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
  PartKnots knots = PartKnots::kNodes;
  std::vector<double> clearances =
      {};  ///< gaps between facing surfaces to search for, all in one search, **length unit of the
           ///< files**; rising, each >= 0, at most kMostClearances, none above a quarter of the
           ///< smaller part's diameter. Need knots that are balls. Empty = parts that touch
  double ball_step = 0.02;      ///< grid step of the decomposition into balls; > 0
  double ball_mu = 0.25;        ///< its mu (DecomposeOptions::protrusion); 0 to 1
  double ball_largest = 0.04;   ///< radius of a ball, at most; > 0
  double ball_penalty = 2.0;    ///< what a ball's core weighs against the ball with its skin, by
                                ///< volume: lambda (r / (r + r0))^3; > 0
  double ball_expansion = 0.5;  ///< balls grow by this part of half a grid cell's diagonal; 0 to 1
  double distance_spacing = 0.01;   ///< grid step of the parts' distances, for judging contact; > 0
  double tolerance = 0.005;         ///< distance up to which surfaces are in contact; > 0
  double one_sided_weight = 1.0;    ///< what contact that pushes one way counts, as far as contact
                                    ///< that holds backs it; 0 to 1
  double penetration_weight = 3.0;  ///< what an area of penetration one tolerance deep costs
                                    ///< against an area of contact; >= 0
  int samples = 3000;               ///< points on the smaller surface; >= 100
  int polished = 100;               ///< placements polished to the end; >= 1
  int poses = 100;                  ///< reported; >= 1
  double cluster_radius = 0.02;     ///< placements whose RMSD to a better one is below are dropped
  int check = 10;                   ///< best poses whose contact is measured exactly; >= 0
  double deviation = 0.0;   ///< of a STEP file's tessellation, length unit of the file; 0 = the
                            ///< reader's default
  bool allow_open = false;  ///< accept parts that cannot be closed; inside goes by winding number
  std::optional<std::uint64_t> random_start =
      {};           ///< seed of a random motion that the moving part is given first: up to half
                    ///< its diameter per axis; poses refer to the file as it is. None = as it is
  int threads = 0;  ///< 0 = all cores; never changes the result
};

/// Clearances that one search takes, at most.
inline constexpr int kMostClearances = 50;

/// The name of the column and, with offset_scores(), of the figures that clearances give.
inline constexpr const char* kClearance = "clearance";

/// "fast", "default" or "thorough". @throws InputError for any other name, listing these
[[nodiscard]] MateOptions mate_preset(const std::string& name);

/// Every option but threads, in the order of the help.
[[nodiscard]] std::span<const OptionRow<MateOptions>> mate_option_rows();

/// The options as one JSON object, for the run file; and back.
/// @throws InputError if this program does not know all of them
[[nodiscard]] std::string to_json(const MateOptions& options);
[[nodiscard]] MateOptions parse_mate_options(const std::string& json);

/// What a mating searches and how it ranks. Poses are judged by columns "contact" and
/// "penetration": areas relative to the smaller surface; the score is their sum. Of the contact's
/// area C, F = |sum of its normals by area| pushes one way and H = C - F holds: the column is
/// H + one_sided_weight H F / (H + F). A face laid on another has H = 0.
///
/// Further columns, of the best options.check poses, are measured exactly (metrics/contact.hpp):
/// contact_area, penetration_volume, penetration_depth, pull_blocked, pull_x, pull_y, pull_z.
///
/// With clearances the moving part counts as grown by each of them in turn: a mate that leaves a
/// gap c on all sides scores at clearance c as one without a gap does at 0. The search grows its
/// balls (SearchOptions::offsets), the ranking takes c off every distance. Each clearance's
/// candidates are ranked by themselves; the list has the best of all, one of each cluster, with the
/// column "clearance"; the figures of offset_scores() say how well each clearance fits.
/// contact_area then counts surfaces up to clearance and tolerance apart; what penetrates is
/// measured on the parts as they are.
///
/// Any body will do: of balls, and of a molecule's atoms, the union is the part.
/// @throws InputError if a part has no surface or no inside, the two files give different units, an
/// option is out of range, clearances are asked for without balls, or the skeletal channel is asked
/// for and a body is no mesh
[[nodiscard]] SearchPlan plan_mate(const Body& fixed, const Body& moving,
                                   const MateOptions& options = {});

/// Mates: searches and ranks.
/// @throws InputError as plan_mate(); std::exception of `watch` passed on
[[nodiscard]] Run mate(const Body& fixed, const Body& moving, const MateOptions& options = {},
                       const RunWatch& watch = {});

}  // namespace mortise
