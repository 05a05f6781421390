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
  GapValue gap;  ///< of the grown bodies, smoothed; zero unless asked for
};

struct ColliderOptions {
  int modes = 4096;           ///< of the truncated sum
  double oversampling = 3.0;  ///< see GapOptions
  int tree_steps = 20000;  ///< pairs of balls looked at before the sum has to decide; 0 = sum alone
  bool with_gap = false;   ///< fill in Collision::gap for every pose
  int threads = 0;         ///< for the making
};

/// Two ways in one: a pair of sphere trees finds certain misses (grown balls apart) and certain
/// hits (a ball within one body meets one within the other: [FC, Thm. 2] with that ball for U);
/// where neither shows within the steps allowed, the gap function of the bodies grown by x0,
/// smoothed by a nonnegative kernel, is compared with what it is at least in every collision [FC,
/// Lemma 2, Thm. 6]. Derivation in docs/math.md. Immutable; serves any number of threads.
class Collider {
 public:
  /// @throws InputError on bad knots or options
  Collider(const CollisionBody& fixed, const CollisionBody& moving,
           const ColliderOptions& options = {});
  ~Collider();
  Collider(Collider&&) noexcept;
  Collider& operator=(Collider&&) noexcept;

  [[nodiscard]] Collision operator()(const RigidMotion& moving_in_fixed) const;
  /// @throws InputError if the counts differ
  void evaluate(std::span<const RigidMotion> poses, std::span<Collision> answers,
                int threads = 0) const;

  /// What an answer kBand means: by the trees, the bodies as described by their balls are closer
  /// than the sum of the covers; by the sum, closer than this (or they overlap).
  [[nodiscard]] double tree_band() const noexcept;
  [[nodiscard]] double sum_band() const noexcept;
  [[nodiscard]] double growth() const noexcept;     ///< x0
  [[nodiscard]] double threshold() const noexcept;  ///< V below it: certainly apart
  [[nodiscard]] const GapFunction& gap_function() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace mortise
