// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The known placements of pairs of parts, with the motions that leave a mate as good as it was.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mortise/core/rigid_motion.hpp"

namespace mortise {

enum class SymmetryKind {
  kTurn,   ///< any angle about an axis
  kFold,   ///< `order` equal turns about an axis
  kScrew,  ///< a turn with the slide that a thread gives it
  kSlide,  ///< along a direction
  kBall,   ///< any rotation about a point
  kRoll,   ///< a gear's: orbit about one axis while spinning about another
};

/// A family of motions of the fixed body's frame that carry a true placement to a true one.
struct Symmetry {
  SymmetryKind kind = SymmetryKind::kTurn;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();         ///< on the axis, or the ball's centre
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();    ///< of the axis, or of the slide; unit
  Eigen::Vector3d moving_point = Eigen::Vector3d::Zero();  ///< roll: on the axis of the spin
  Eigen::Vector3d moving_direction = Eigen::Vector3d::UnitZ();  ///< roll: of that axis; unit
  int order = 1;                                                ///< fold: members; >= 1
  double pitch = 0.0;  ///< screw: slide along `direction` per whole turn, length unit
  double ratio = 0.0;  ///< roll: spin per orbit
  double from = 0.0;   ///< first angle (radians) or slide (length unit); not for fold and ball
  double to = 0.0;     ///< last one
};

/// How many numbers choose a member: 0 for a fold, 3 (a rotation vector) for a ball, else 1.
[[nodiscard]] int parameter_count(const Symmetry& symmetry);

/// The member at an angle, a slide or a rotation vector; of a fold the member number parameters[0].
/// Parameters are not held to [from, to].
/// @param parameters  at least 1 number, 3 for a ball
[[nodiscard]] RigidMotion member(const Symmetry& symmetry, const double* parameters);

/// Where a moving body belongs: every S1 S2 ... Sn `moving_in_fixed` with Si a member of family i.
struct TrueMate {
  std::string name;
  std::string fixed;            ///< stem of the fixed part's file
  std::string moving;           ///< stem of the moving part's file
  double clearance = 0.0;       ///< relative to the feature's size; 0 where the file does not say
  RigidMotion moving_in_fixed;  ///< of the files' input frames
  std::vector<Symmetry> symmetries;
};

/// Reads a truth file, of many pairs or of one alone (docs/formats.md). @throws FileError naming
/// the pair and the field at fault
[[nodiscard]] std::vector<TrueMate> read_true_mates(const std::string& path);

/// The mate of these two stems, or of the one name if `name` is given, or the file's only one if it
/// names no parts.
/// @throws InputError listing the pairs if there is none, or several and no name
[[nodiscard]] TrueMate find_true_mate(const std::vector<TrueMate>& mates, const std::string& fixed,
                                      const std::string& moving, const std::string& name = {});

}  // namespace mortise
