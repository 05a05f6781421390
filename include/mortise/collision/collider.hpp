// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Certified answers to whether two bodies collide: yes, no, or too close to say.
#pragma once

#include <memory>
#include <span>

#include "mortise/collision/collision_body.hpp"
#include "mortise/collision/gap_function.hpp"
#include "mortise/core/rigid_motion.hpp"

namespace mortise {

enum class Contact {
  kNo,    ///< the interiors are certainly apart
  kYes,   ///< they certainly overlap
  kBand,  ///< neither is certain; see Collider::band
};

/// What settled it.
enum class DecidedBy { kTree, kSum };

struct Collision {
  Contact contact = Contact::kBand;
  DecidedBy by = DecidedBy::kTree;
  int modes = 0;  ///< of the sum, looked at before it was settled; 0 if the trees settled it
  GapValue gap;   ///< of the bodies' densities, by ColliderOptions::modes; zero unless asked for
};

struct ColliderOptions {
  int modes = 4096;           ///< of the truncated sums; >= 200
  double oversampling = 3.0;  ///< see GapOptions
  /// Pairs of balls looked at before only the sum is left; 0 = the sum alone. Where both margins
  /// are 0 there is no limit, so that answers are exact.
  int tree_steps = 20000;
  bool with_gap = false;  ///< fill in Collision::gap for every pose
  int threads = 0;        ///< for the making
};

/// The trees certify, the sum narrows. A pair of sphere trees finds certain misses (the balls that
/// hold the bodies are apart) and certain hits (a ball within one body meets one within the other:
/// [FC, Thm. 2] with that ball for U): nearly every answer is theirs. Where neither shows within
/// the steps allowed, the gap function of the balls grown by x0, smoothed by a nonnegative kernel,
/// is compared with what it is at least in every collision [FC, Lemma 2, Thm. 6], which tells
/// bodies far apart from others; it stops as soon as a bound on the modes left out allows it
/// (GapFunction::reject). The sum takes seconds to make and is made when first
/// needed, by a pose or by a question below. Derivation in docs/math.md. Immutable; serves any
/// number of threads.
class Collider {
 public:
  /// @throws InputError on bad knots or options
  Collider(const CollisionBody& fixed, const CollisionBody& moving,
           const ColliderOptions& options = {});
  ~Collider();
  Collider(Collider&&) noexcept;
  Collider& operator=(Collider&&) noexcept;

  /// @throws InputError unless the motion is finite with a unit quaternion
  [[nodiscard]] Collision operator()(const RigidMotion& moving_in_fixed) const;
  /// @throws InputError if the counts differ or on such a motion
  void evaluate(std::span<const RigidMotion> poses, std::span<Collision> answers,
                int threads = 0) const;

  /// What an answer kBand means: the bodies overlap or are closer than this, if it is by the trees
  /// tree_band(), the sum of the margins, if by the sum sum_band(), which may be infinite.
  [[nodiscard]] double tree_band() const noexcept;
  [[nodiscard]] double sum_band() const;
  [[nodiscard]] double growth() const;                    ///< x0
  [[nodiscard]] double threshold() const;                 ///< V below it: certainly apart
  [[nodiscard]] const GapFunction& gap_function() const;  ///< of the grown balls

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace mortise
