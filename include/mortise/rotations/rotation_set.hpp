// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Sets of rotations that sample SO(3) evenly: the rotations a search visits.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>
#include <string>
#include <vector>

namespace mortise {

/// How a set of rotations is made.
enum class RotationMethod {
  kAuto,            ///< the stored set if there is one of this size, else super-Fibonacci
  kSuperFibonacci,  ///< super-Fibonacci spirals (Alexa 2022); any count
  kHopf,            ///< HEALPix sphere times circle (Yershova et al. 2010); some counts
  kIcosahedral      ///< stored unions of icosahedral cosets, optimised here; stored counts only
};

/// Rotations that sample SO(3), with how well they cover it.
struct RotationSet {
  Eigen::Matrix4Xd quaternions;  ///< 4 x N: rows w, x, y, z; unit length, canonical (w >= 0)
  RotationMethod method = RotationMethod::kAuto;  ///< what made the set; never kAuto once made
  double covering_radius =
      0.0;  ///< largest angle from any rotation to its nearest in the set; radians

  [[nodiscard]] Eigen::Index size() const noexcept { return quaternions.cols(); }
  [[nodiscard]] Eigen::Quaterniond rotation(Eigen::Index i) const {
    return {quaternions(0, i), quaternions(1, i), quaternions(2, i), quaternions(3, i)};
  }
};

/// Largest count that rotation_set() makes.
inline constexpr Eigen::Index kMaxRotations = 10'000'000;

/// Makes `count` rotations and measures their covering radius; the same bytes for any number of
/// threads.
///
/// @param count    how many, 1 to kMaxRotations; not every method makes every count
/// @param method   kAuto takes the best there is for this count
/// @param threads  for the measurement; 0 = all cores
/// @throws InputError if the count is out of range or the method cannot make it (the message says
/// which it can) Time O(N log N): about 0.01 ms of one core per rotation; none for stored sets,
/// which bring their radius.
[[nodiscard]] RotationSet rotation_set(Eigen::Index count,
                                       RotationMethod method = RotationMethod::kAuto,
                                       int threads = 0);

/// Super-Fibonacci spirals on the unit quaternions: `count` columns, canonical.
/// M. Alexa, Super-Fibonacci Spirals: Fast, Low-Discrepancy Sampling of SO(3), CVPR 2022,
/// Algorithm 1.
/// @throws InputError unless 1 <= count <= kMaxRotations
[[nodiscard]] Eigen::Matrix4Xd super_fibonacci_rotations(Eigen::Index count);

/// The Hopf fibration of SO(3) over the 12 n^2 pixels of HEALPix, m turns about each direction:
/// `count` columns, canonical, n and m chosen so that both are as evenly fine as the count allows
/// (m = 6 n is best: 72 n^3 rotations). A. Yershova et al., Generating Uniform Incremental Grids on
/// SO(3) Using the Hopf Fibration, IJRR 2010.
/// @throws InputError unless count = 12 n^2 m with 3 n <= m <= 12 n; the message names the nearest
/// such counts
[[nodiscard]] Eigen::Matrix4Xd hopf_rotations(Eigen::Index count);

/// The sizes of the stored sets, ascending: what RotationMethod::kIcosahedral makes.
[[nodiscard]] std::vector<Eigen::Index> stored_rotation_counts();

/// "super-fibonacci" and so on: the names the command line takes and files hold.
[[nodiscard]] std::string rotation_method_name(RotationMethod method);

/// The method of this name. @throws InputError listing the names if there is none
[[nodiscard]] RotationMethod rotation_method(const std::string& name);

}  // namespace mortise
