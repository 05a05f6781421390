// SPDX-License-Identifier: GPL-3.0-or-later
// Trees first, the truncated sum where they leave it open; derivation in docs/math.md.
#include "mortise/collision/collider.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "collision/ball_tree.hpp"
#include "mortise/collision/radial_instrument.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"

namespace mortise {
namespace {

// The most that sum_i 1_{ball i} is anywhere: a place in ball i is in no ball that does not meet
// it.
double multiplicity(const BodyDensity& density) {
  int most = 0;
  for (Eigen::Index i = 0; i < density.size(); ++i) {
    int count = 0;
    for (Eigen::Index j = 0; j < density.size(); ++j)
      count += (density.points.col(i) - density.points.col(j)).norm() <
                       density.radii[i] + density.radii[j]
                   ? 1
                   : 0;
    most = std::max(most, count);
  }
  return most;
}

double volume(const BodyDensity& density) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < density.size(); ++i) sum += density.kernel.volume(density.radii[i]);
  return sum;
}

BodyDensity grown(const CollisionBody& body, double by) {
  Knots knots = body.balls;
  knots.weights.setOnes();
  return density_of_knots(knots, RadialKernel{}, body.cover + by);
}

// Largest |w| of the ball of lattice points that a series of so many modes holds: a little less
// than what the volume says, so that no mode within it is missing.
double bandwidth_of(int modes, double box) {
  return 0.96 * std::cbrt(modes * 0.75 / 3.14159265358979) / box;
}

}  // namespace

struct Collider::State {
  BallTree fixed, moving;
  ColliderOptions options;
  double tree_band = 0.0, sum_band = 0.0, growth = 0.0, threshold = 0.0, reach = 0.0;
  GapFunction gap;
};

namespace {

struct Plan {
  double growth = 0.0, band = std::numeric_limits<double>::infinity();
};

// The growth with the least promised band, before the errors of the sum are known.
Plan plan_growth(const CollisionBody& fixed, const CollisionBody& moving, double reach, int modes) {
  Plan best;
  for (double share = 0.02; share < 0.6; share *= 1.2) {
    const double x0 = share * reach;
    const RadialInstrument kernel(bandwidth_of(modes, 2.0 * (reach + 2.0 * x0)));
    const BodyDensity a = grown(fixed, x0), b = grown(moving, x0);
    const double most = std::min(volume(a) * multiplicity(b), volume(b) * multiplicity(a));
    const double inside = kernel.lens(x0);
    double x1 = 0.0;
    const double limit = 4.0 * reach, step = reach / 200.0;
    while (x1 < limit && most * kernel.outside(x1) >= 0.8 * inside) x1 += step;
    if (x1 < limit && 2.0 * x0 + x1 < best.band) best = {x0, 2.0 * x0 + x1};
  }
  if (best.growth == 0.0) best.growth = 0.3 * reach;  // too few modes: no band is promised
  return best;
}

}  // namespace

Collider::Collider(const CollisionBody& fixed, const CollisionBody& moving,
                   const ColliderOptions& options) {
  for (const CollisionBody* body : {&fixed, &moving}) {
    check_knots(body->balls, "Collider");
    if (!(body->cover >= 0.0) || !std::isfinite(body->cover))
      throw InputError("Collider: cover must be >= 0, got " + std::to_string(body->cover));
  }
  if (options.modes < 200)  // below, lattice points in a ball are too unlike its volume
    throw InputError("Collider: modes must be >= 200, got " + std::to_string(options.modes));
  if (options.tree_steps < 0)
    throw InputError("Collider: tree_steps must be >= 0, got " +
                     std::to_string(options.tree_steps));
  const double reach =
      bounding_ball(grown(fixed, 0.0)).radius + bounding_ball(grown(moving, 0.0)).radius;
  const Plan plan = plan_growth(fixed, moving, reach, options.modes);
  const BodyDensity a = grown(fixed, plan.growth), b = grown(moving, plan.growth);
  // Grown bodies, and room for the kernel's reach beyond where their balls part.
  const double grown_reach = bounding_ball(a).radius + bounding_ball(b).radius;
  const double room = std::isfinite(plan.band) ? plan.band : 0.0;
  const double box = 2.0 * grown_reach + std::max(0.0, room - 2.0 * plan.growth);
  const RadialInstrument kernel(bandwidth_of(options.modes, box));
  GapFunction gap(a, b,
                  {.max_modes = options.modes,
                   .box = box,
                   .oversampling = options.oversampling,
                   .window = [&](const Eigen::Vector3d& w) { return kernel.transform(w.norm()); },
                   .threads = options.threads});
  const double error = gap.sum_error_bound(), inside = kernel.lens(plan.growth);
  double band = std::numeric_limits<double>::infinity();
  const double most = std::min(volume(a) * multiplicity(b), volume(b) * multiplicity(a));
  for (double x1 = 0.0; x1 < 4.0 * reach; x1 += reach / 200.0)
    if (most * kernel.outside(x1) + error < inside - error) {
      band = 2.0 * plan.growth + x1 + fixed.cover + moving.cover;
      break;
    }
  state_ = std::make_unique<State>(State{BallTree(fixed.balls.points, fixed.cover),
                                         BallTree(moving.balls.points, moving.cover), options,
                                         fixed.cover + moving.cover, band, plan.growth,
                                         inside - error, reach, std::move(gap)});
}

Collider::~Collider() = default;
Collider::Collider(Collider&&) noexcept = default;
Collider& Collider::operator=(Collider&&) noexcept = default;

Collision Collider::operator()(const RigidMotion& pose) const {
  const State& s = *state_;
  Collision answer;
  bool known = false;
  if (s.options.tree_steps > 0) {
    answer.by = DecidedBy::kTree;
    switch (BallTree::compare(s.fixed, s.moving, pose, s.options.tree_steps)) {
      case BallTree::Verdict::kApart:
        answer.contact = Contact::kNo, known = true;
        break;
      case BallTree::Verdict::kMeet:
        answer.contact = Contact::kYes, known = true;
        break;
      case BallTree::Verdict::kBetween:
      case BallTree::Verdict::kStopped:
        break;
    }
  }
  if (s.options.with_gap || !known) answer.gap = s.gap(pose);
  if (!known) {
    answer.by = DecidedBy::kSum;
    answer.contact = answer.gap.value < s.threshold ? Contact::kNo : Contact::kBand;
  }
  return answer;
}

void Collider::evaluate(std::span<const RigidMotion> poses, std::span<Collision> answers,
                        int threads) const {
  if (poses.size() != answers.size())
    throw InputError("Collider::evaluate: " + std::to_string(poses.size()) + " poses, room for " +
                     std::to_string(answers.size()) + " answers");
  constexpr std::size_t kBatch = 64;
  parallel_for((poses.size() + kBatch - 1) / kBatch, threads, [&](std::size_t batch, int) {
    for (std::size_t i = batch * kBatch; i < std::min(poses.size(), (batch + 1) * kBatch); ++i)
      answers[i] = (*this)(poses[i]);
  });
}

double Collider::tree_band() const noexcept { return state_->tree_band; }
double Collider::sum_band() const noexcept { return state_->sum_band; }
double Collider::growth() const noexcept { return state_->growth; }
double Collider::threshold() const noexcept { return state_->threshold; }
const GapFunction& Collider::gap_function() const noexcept { return state_->gap; }

}  // namespace mortise
