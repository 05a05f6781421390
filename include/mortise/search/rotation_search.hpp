// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The exhaustive search: every translation on a grid at every rotation of a set.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "mortise/affinity/channel.hpp"
#include "mortise/core/pose.hpp"
#include "mortise/core/progress.hpp"
#include "mortise/core/rigid_motion.hpp"
#include "mortise/search/candidate.hpp"

namespace mortise {

/// How the moving body's fields are summed, knots of unequal radii included.
enum class SearchLift {
  kCompressed,  ///< a few 3D sums, the radii compressed (kernels/compressed_radius.hpp)
  k4d,  ///< one 4D sum with the cone's series [SD, Sec. 2.2, 2.5]: nothing compressed, spreading
        ///< within the tolerance, at some twenty times the time
};

struct SearchOptions {
  double spacing = 3.0;  ///< grid step, length unit of the bodies; > 0
  double cutoff =
      0.25;  ///< frequency where the Hann low-pass reaches zero, cycles per length unit; > 0. May
             ///< lie beyond the grid's Nyquist frequency, which then cuts the window short
  int per_rotation = 4;     ///< best translations kept at each rotation; >= 1
  double separation = 5.0;  ///< least distance between translations kept at one rotation; >= 0
  bool summits =
      false;  ///< keep local maxima of the score alone, none on the slope of a better one
  int spread_width = 4;  ///< grid cells per axis that a knot is spread over, 2 to 8
  double radius_tolerance =
      3e-3;  ///< error allowed of a knot's transform where radii are many, relative to its largest
             ///< value (kernels/compressed_radius.hpp); 1e-8 to 0.1. One radius has none
  SearchLift lift = SearchLift::kCompressed;
  std::vector<double> offsets = {
      0.0};         ///< added to the moving body's radii, length unit; each gives scores and
                    ///< candidates of its own at little cost; all radii must stay > 0
  int threads = 0;  ///< 0 = all cores; never changes the result
};

/// Carries the fixed body's input coordinates to the frame in which RotationSearch places and turns
/// the moving body: the principal frame of the fixed knots of all channels.
/// @throws InputError if there is no channel
[[nodiscard]] RigidMotion search_frame(const std::vector<Channel>& channels);

/// The rotation loop of docs/math.md: rotate the moving knots, spread them, transform, multiply
/// with the fixed body's spectrum, transform back, keep the best translations.
///
/// The result does not depend on the number of threads, nor on how often the search was stopped and
/// resumed.
class RotationSearch {
 public:
  /// @param channels   at least one
  /// @param rotations  4 x N unit quaternions (w, x, y, z): of the moving body, about its centre,
  /// into the search frame
  /// @throws InputError if a channel is bad, there is no rotation or an option is out of range
  RotationSearch(const std::vector<Channel>& channels, const Eigen::Matrix4Xd& rotations,
                 const SearchOptions& options = {});
  ~RotationSearch();
  RotationSearch(RotationSearch&&) noexcept;
  RotationSearch& operator=(RotationSearch&&) noexcept;

  /// Searches the rotations that are not done yet. Returns true when all are; false if `progress`
  /// asked to stop, which it may about every tenth of a second, with the search in a state to save.
  bool run(const ProgressCallback& progress = {});

  /// Per rotation: 1 if searched.
  [[nodiscard]] const std::vector<std::uint8_t>& done() const;
  /// Candidates of the rotations done, by rotation and offset, best first within these.
  [[nodiscard]] std::vector<Candidate> candidates() const;
  /// Takes up where another search of the same inputs and options stopped. @throws InputError if
  /// they do not fit
  void resume(const std::vector<std::uint8_t>& done, const std::vector<Candidate>& candidates);

  /// search_frame() of the channels.
  [[nodiscard]] const RigidMotion& search_from_fixed() const;
  /// Moves the moving body's centre to the origin; no rotation.
  [[nodiscard]] const RigidMotion& search_from_moving() const;
  /// The candidate as the motion from the moving body's input frame to the fixed body's.
  [[nodiscard]] RigidMotion moving_in_fixed(const Candidate& candidate) const;

  [[nodiscard]] const std::array<int, 3>& grid_size() const;
  [[nodiscard]] double spacing() const;
  /// Scores of all translations at one rotation (row of the set) and offset, x slowest: what the
  /// loop sees, for tests and pictures. Entry (i, j, k) is the score with the moving body's centre
  /// at translation_of(i, j, k).
  [[nodiscard]] std::vector<float> score_grid(Eigen::Index rotation, int offset_index = 0);
  [[nodiscard]] Eigen::Vector3d translation_of(int i, int j, int k) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mortise
