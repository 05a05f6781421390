// SPDX-License-Identifier: GPL-3.0-or-later
// Shape complementarity of two bodies whose surfaces are made once and moved.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "metrics/dot_cells.hpp"
#include "metrics/near_pairs.hpp"
#include "mortise/core/rigid_motion.hpp"
#include "mortise/metrics/molecular_surface.hpp"
#include "mortise/metrics/shape_complementarity.hpp"

namespace mortise::detail {

// Throws InputError unless all are > 0 and finite.
void check_complementarity_options(const ComplementarityOptions& options);

// One body's surface, in its own frame.
class DottedBody {
 public:
  DottedBody(const Eigen::Matrix3Xd& centres, const Eigen::VectorXd& radii,
             const ComplementarityOptions& options);

  // The trimmed interface with a partner whose N grown balls stand at `partners`, in this body's
  // frame: columns of dots().
  [[nodiscard]] std::vector<std::int32_t> interface(const Neighbours& neighbours,
                                                    const Eigen::Matrix3Xd& partners,
                                                    const Eigen::VectorXd& partner_grown) const;

  [[nodiscard]] const SurfaceDots& dots() const { return dots_; }
  [[nodiscard]] const Eigen::Matrix3Xd& centres() const { return centres_; }
  [[nodiscard]] const Eigen::VectorXd& grown() const { return places_.grown; }

 private:
  Eigen::Matrix3Xd centres_;
  SurfaceDots dots_;
  ProbePlaces places_;  // of the probes that touch the dots
  DotCells cells_;      // of the dots, for trimming
};

// Sc in a pose. `fixed_in_moving`: the fixed body's centres in the moving body's frame;
// `moving_in_fixed`: the other way round.
[[nodiscard]] Complementarity complementarity(const DottedBody& fixed, const DottedBody& moving,
                                              const RigidMotion& motion, const NearPairs& pairs,
                                              const Eigen::Matrix3Xd& fixed_in_moving,
                                              const Eigen::Matrix3Xd& moving_in_fixed,
                                              double weight);

}  // namespace mortise::detail
