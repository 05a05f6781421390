// SPDX-License-Identifier: GPL-3.0-or-later
// Scores and moves of parts by their contact.
#include "scoring/part_scorer.hpp"

#include <algorithm>

#include "mortise/core/threads.hpp"

namespace mortise {
namespace {

constexpr std::size_t kPiece = 16;  // poses handed to a thread at a time

// change(local motion) of every pose.
template <class Change>
MovePoses each_local(std::shared_ptr<const PartPair> parts, Change change) {
  return [parts = std::move(parts), change = std::move(change)](
             const std::vector<RigidMotion>& poses, int threads) {
    std::vector<RigidMotion> moved(poses.size());
    parallel_for((poses.size() + kPiece - 1) / kPiece, threads, [&](std::size_t piece, int) {
      const std::size_t end = std::min(poses.size(), (piece + 1) * kPiece);
      for (std::size_t i = piece * kPiece; i < end; ++i)
        moved[i] = parts->to_input(change(parts->to_local(poses[i])));
    });
    return moved;
  };
}

}  // namespace

std::array<double, 2> PartScorer::local_columns(const RigidMotion& motion) const {
  const ContactFit fit = parts_->pair.fit(motion, options_.tolerance, options_.sample_fraction);
  const double area = parts_->pair.smaller_area();
  const double held = std::max(0.0, fit.contact - fit.one_sided);
  const double backed = fit.contact > 0.0 ? held * fit.one_sided / (held + fit.one_sided) : 0.0;
  return {(held + options_.one_sided_weight * backed) / area,
          -options_.penetration_weight * fit.penetration / area};
}

Eigen::MatrixXd PartScorer::score(const std::vector<RigidMotion>& poses, int threads) const {
  Eigen::MatrixXd columns(2, static_cast<Eigen::Index>(poses.size()));
  parallel_for((poses.size() + kPiece - 1) / kPiece, threads, [&](std::size_t piece, int) {
    const std::size_t end = std::min(poses.size(), (piece + 1) * kPiece);
    for (std::size_t i = piece * kPiece; i < end; ++i) {
      const auto [contact, penetration] = local_columns(parts_->to_local(poses[i]));
      columns.col(static_cast<Eigen::Index>(i)) << contact, penetration;
    }
  });
  return columns;
}

MovePoses approach_contact(std::shared_ptr<const PartPair> parts,
                           std::shared_ptr<const PartScorer> judge, double tolerance) {
  const ContactPair& pair = parts->pair;
  return each_local(
      std::move(parts), [&pair, judge = std::move(judge), tolerance](const RigidMotion& start) {
        // From afar a wide energy finds the way, from near by it may lose it: both are tried.
        const RigidMotion wide = pair.descend(pair.descend(start, 6.0 * tolerance, 1.0, 0.1, 5),
                                              3.0 * tolerance, 1.0, 0.15, 5);
        const RigidMotion narrow = pair.descend(start, 2.0 * tolerance, 1.0, 0.15, 6);
        return judge->local_score(wide) >= judge->local_score(narrow) ? wide : narrow;
      });
}

MovePoses polish_contact(std::shared_ptr<const PartPair> parts,
                         std::shared_ptr<const PartScorer> judge, double tolerance) {
  const ContactPair& pair = parts->pair;
  return each_local(
      std::move(parts), [&pair, judge = std::move(judge), tolerance](const RigidMotion& start) {
        // Descending the energy may lose in the score: the best of all stages is what counts.
        struct Width {
          double sigma, penalty;
        };
        constexpr Width kWidths[] = {{4.0, 2.0}, {2.0, 2.0}, {1.0, 2.0}, {0.5, 3.0}};
        RigidMotion motion = start;
        RigidMotion best = start;
        double best_score = judge->local_score(start);
        for (const Width& width : kWidths) {
          motion = pair.descend(motion, width.sigma * tolerance, width.penalty, 1.0, 8);
          const double here = judge->local_score(motion);
          if (here > best_score) {
            best = motion;
            best_score = here;
          }
        }
        return best;
      });
}

}  // namespace mortise
