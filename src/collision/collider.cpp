// SPDX-License-Identifier: GPL-3.0-or-later
// Trees first, the truncated sum where they leave it open; derivation in docs/math.md.
#include "mortise/collision/collider.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "collision/ball_tree.hpp"
#include "collision/gap_state.hpp"
#include "mortise/collision/radial_instrument.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"

namespace mortise {
namespace {

// The spectra's error, 1e-7 each, with room: relative to the largest overlap by Cauchy and Schwarz.
constexpr double kSpectrumError = 1e-6;

// Few balls whose union, grown by `slack`, holds all balls: those that no kept and grown one holds,
// from the largest down. Sums of fewer balls count less of the body twice.
CollisionBody thinned(const CollisionBody& body, double slack) {
  const Eigen::Matrix4Xd& balls = body.balls.points;
  std::vector<Eigen::Index> order(static_cast<std::size_t>(balls.cols())), kept;
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index i, Eigen::Index j) { return balls(3, i) > balls(3, j); });
  for (const Eigen::Index i : order)
    if (std::none_of(kept.begin(), kept.end(), [&](Eigen::Index j) {
          return (balls.col(i) - balls.col(j)).head<3>().norm() + balls(3, i) <=
                 balls(3, j) + slack;
        }))
      kept.push_back(i);
  return {{balls(Eigen::all, kept), body.balls.weights(kept)}, body.cover + slack};
}

BodyDensity grown(const CollisionBody& body, double by) {
  Knots knots = body.balls;
  knots.weights.setOnes();
  return density_of_knots(knots, RadialKernel{}, body.cover + by);
}

// Int a(x) b(T x) dx is at most the product of the roots of Int a^2 and Int b^2, at every pose.
double largest_overlap(const BodyDensity& a, const BodyDensity& b) {
  return std::sqrt(ball_energy(a) * ball_energy(b));
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
  double tree_band = 0.0, sum_band = std::numeric_limits<double>::infinity();
  double growth = 0.0, threshold = 0.0, sum_error = 0.0;  // threshold of the exact sum
  std::unique_ptr<GapFunction> gap;

  State(const CollisionBody& fixed_body, const CollisionBody& moving_body,
        const ColliderOptions& asked)
      : fixed(fixed_body.balls.points, fixed_body.cover),
        moving(moving_body.balls.points, moving_body.cover),
        options(asked),
        tree_band(fixed_body.cover + moving_body.cover) {}
  void choose_growth(const CollisionBody& fixed_body, const CollisionBody& moving_body);
};

// The growth x0 with the least band 2 x0 + x1, by trial: small ones drown in the sum's own error,
// large ones are a band by themselves.
void Collider::State::choose_growth(const CollisionBody& fixed_body,
                                    const CollisionBody& moving_body) {
  const double reach =
      bounding_ball(grown(fixed_body, 0.0)).radius + bounding_ball(grown(moving_body, 0.0)).radius;
  for (const double share : {0.04, 0.06, 0.09, 0.13, 0.19, 0.28}) {
    const double x0 = share * reach, slack = 0.7 * x0;
    const BodyDensity a = grown(thinned(fixed_body, slack), x0),
                      b = grown(thinned(moving_body, slack), x0);
    // Twice the grown reach keeps the obstacle's images apart; then room for the kernel's stop
    // radius.
    const double box = 2.0 * (bounding_ball(a).radius + bounding_ball(b).radius) + 0.2 * reach;
    const RadialInstrument kernel(bandwidth_of(options.modes, box));
    auto trial = std::make_unique<GapFunction>(
        a, b,
        GapOptions{.max_modes = options.modes,
                   .box = box,
                   .oversampling = options.oversampling,
                   .window = [&](const Eigen::Vector3d& w) { return kernel.transform(w.norm()); },
                   .threads = options.threads});
    const double most = largest_overlap(a, b);
    const double error = kSpectrumError * most, inside = kernel.lens(x0) - error;
    double x1 = 0.0;
    while (x1 < 4.0 * reach && most * kernel.outside(x1) + error >= inside) x1 += reach / 200.0;
    const bool certain = x1 < 4.0 * reach;
    const double band =
        certain ? 2.0 * (x0 + slack) + x1 + tree_band : std::numeric_limits<double>::infinity();
    if (gap == nullptr || band < sum_band) {
      gap = std::move(trial);
      sum_band = band, growth = x0, threshold = inside;
      sum_error = gap->sum_error_bound();
    }
  }
}

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
  state_ = std::make_unique<State>(fixed, moving, options);
  state_->choose_growth(fixed, moving);
}

Collider::~Collider() = default;
Collider::Collider(Collider&&) noexcept = default;
Collider& Collider::operator=(Collider&&) noexcept = default;

Collision Collider::operator()(const RigidMotion& pose) const {
  const State& s = *state_;
  Collision answer;
  const BallTree::Verdict verdict =
      s.options.tree_steps > 0 ? BallTree::compare(s.fixed, s.moving, pose, s.options.tree_steps)
                               : BallTree::Verdict::kStopped;
  const bool known = verdict == BallTree::Verdict::kApart || verdict == BallTree::Verdict::kMeet;
  if (s.options.with_gap || !known) answer.gap = (*s.gap)(pose);
  if (known) {
    answer.contact = verdict == BallTree::Verdict::kMeet ? Contact::kYes : Contact::kNo;
    answer.by = DecidedBy::kTree;
    return answer;
  }
  answer.by = DecidedBy::kSum;
  double value = answer.gap.value;
  if (std::abs(value - s.threshold) <= s.sum_error) {
    // Too close for single precision. Where the trees have said how close, that is all one needs.
    if (verdict == BallTree::Verdict::kBetween) {
      answer.by = DecidedBy::kTree;
      return answer;
    }
    value = s.gap->exact(pose).value;
  }
  answer.contact = value < s.threshold ? Contact::kNo : Contact::kBand;
  if (answer.contact == Contact::kBand && verdict == BallTree::Verdict::kBetween)
    answer.by = DecidedBy::kTree;
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
const GapFunction& Collider::gap_function() const noexcept { return *state_->gap; }

}  // namespace mortise
