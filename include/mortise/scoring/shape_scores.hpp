// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A channel's score of given poses outside the search: exact, low-passed, at several offsets, and
/// what separates the search's score from the exact one.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mortise/affinity/channel.hpp"
#include "mortise/core/rigid_motion.hpp"
#include "mortise/kernels/low_pass.hpp"

namespace mortise {

struct ExactScoresOptions {
  std::vector<double> offsets = {0.0};  ///< added to the moving radii, which must stay > 0
  int threads = 0;                      ///< 0 = all cores; never changes the result
};

/// Re sum_ij c_i d_j K(d_ij; r_i, r_j + o) over all pairs within the channel's range: the score
/// without grid, low-pass or compression, K from channel.pair by tables (error 1e-5 of K(0)).
///
/// Of two bodies of 2,000 and 1,500 atoms about 60 us a pose and offset.
/// @return offsets x poses
/// @throws InputError if the channel has no pair function, a pose is not finite, or an offset is
/// bad
[[nodiscard]] Eigen::MatrixXd exact_scores(const Channel& channel,
                                           const std::vector<RigidMotion>& moving_in_fixed,
                                           const ExactScoresOptions& options = {});

struct LowPassedScoresOptions {
  LowPass low_pass = {};  ///< of the search, with a finite cutoff > 0
  std::vector<double> offsets = {0.0};
  double radius_tolerance = 3e-3;  ///< as of the search
  double spacing = 0.0;  ///< of the maps, length unit; 0 = a quarter of the low-pass' shortest wave
  int threads = 0;       ///< 0 = all cores; never changes the result
};

/// The score with the low-pass, as the search would have it on an infinitely fine grid: from maps
/// of the fixed body, interpolated by cubics. The difference of two near offsets over their
/// distance is the sensitivity of a pose's score to the offset.
///
/// Time: maps once, then microseconds a pose. Memory 4 bytes a map and node; as many maps as terms
/// of the moving radii times offsets.
/// @return offsets x poses
/// @throws InputError as above, or if the maps would take more than 8 GiB
[[nodiscard]] Eigen::MatrixXd low_passed_scores(const Channel& channel,
                                                const std::vector<RigidMotion>& moving_in_fixed,
                                                const LowPassedScoresOptions& options);

/// Why a score found by the search differs from the exact one of its pose:
/// |score - exact| <= low_pass + spread.
struct Truncation {
  double exact = 0.0;     ///< exact_scores()
  double low_pass = 0.0;  ///< |low-passed - exact|: what the low-pass takes or adds
  double spread = 0.0;    ///< |score - low-passed|: spreading on the unenlarged grid, the window's
                          ///< end at the grid's Nyquist frequency, the place between grid points,
                          ///< and what maps and pair tables leave out
};

/// Both parts for each pose as the search found it (not polished) and its score; no estimate, but
/// evaluated at the very pose.
/// @param scores  the channel's, one per pose
/// @throws InputError as above, or if counts differ or more than one offset is given
[[nodiscard]] std::vector<Truncation> score_truncation(
    const Channel& channel, const std::vector<RigidMotion>& moving_in_fixed,
    const std::vector<double>& scores, const LowPassedScoresOptions& options);

}  // namespace mortise
