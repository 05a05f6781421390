// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Parts' scores: contact that holds, less what penetrates; and the moves towards it.
#pragma once

#include <array>
#include <memory>

#include "mortise/scoring/pose_scorer.hpp"
#include "scoring/contact_pair.hpp"
#include "scoring/local_part.hpp"

namespace mortise {

/// Two parts about their own centres, in units of the smaller part's diameter.
struct PartPair {
  LocalFrame fixed_frame, moving_frame;
  ContactPair pair;

  [[nodiscard]] RigidMotion to_local(const RigidMotion& moving_in_fixed) const {
    return local_motion(fixed_frame, moving_frame, moving_in_fixed);
  }
  [[nodiscard]] RigidMotion to_input(const RigidMotion& local) const {
    return input_motion(fixed_frame, moving_frame, local);
  }
};

struct PartScoreOptions {
  double tolerance = 0.005;       ///< distance up to which surfaces are in contact, diameters; > 0
  double sample_fraction = 1.0;   ///< of the surface points that are looked at
  double one_sided_weight = 1.0;  ///< see PartScorer; 0 to 1
  double penetration_weight = 3.0;  ///< what an area of penetration one tolerance deep costs
                                    ///< against an area of contact; >= 0
};

/// Columns "contact" and "penetration", areas relative to the smaller surface.
///
/// Of the contact's area C, F = |sum of its normals by area| pushes one way and H = C - F holds:
/// the column is H + one_sided_weight H F / (H + F). A face laid on another has H = 0.
class PartScorer : public PoseScorer {
 public:
  PartScorer(std::shared_ptr<const PartPair> parts, const PartScoreOptions& options)
      : parts_(std::move(parts)), options_(options) {}

  [[nodiscard]] std::vector<std::string> columns() const override {
    return {"contact", "penetration"};
  }
  [[nodiscard]] Eigen::MatrixXd score(const std::vector<RigidMotion>& poses,
                                      int threads) const override;

  /// Both columns of a placement in local frames.
  [[nodiscard]] std::array<double, 2> local_columns(const RigidMotion& motion) const;
  /// Their sum.
  [[nodiscard]] double local_score(const RigidMotion& motion) const {
    const auto [contact, penetration] = local_columns(motion);
    return contact + penetration;
  }

 private:
  std::shared_ptr<const PartPair> parts_;
  PartScoreOptions options_;
};

/// Down the contact energy from where the search left off, wide first or narrow: whichever ends
/// better by `judge`.
[[nodiscard]] MovePoses approach_contact(std::shared_ptr<const PartPair> parts,
                                         std::shared_ptr<const PartScorer> judge, double tolerance);

/// Down the contact energy through ever narrower widths; the best stage by `judge` counts, never
/// worse than the start.
[[nodiscard]] MovePoses polish_contact(std::shared_ptr<const PartPair> parts,
                                       std::shared_ptr<const PartScorer> judge, double tolerance);

}  // namespace mortise
