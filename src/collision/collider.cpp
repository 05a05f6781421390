// SPDX-License-Identifier: GPL-3.0-or-later
// Trees first, the truncated sum where they leave it open; derivation in docs/math.md.
#include "mortise/collision/collider.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <mutex>
#include <string>
#include <vector>

#include "collision/ball_tree.hpp"
#include "collision/gap_state.hpp"
#include "mortise/collision/radial_instrument.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"
#include "mortise/parts/uncontained_balls.hpp"

namespace mortise {
namespace {

// The spectra's error, 1e-7 each, with room, and that of the window's table: relative to the
// largest overlap by Cauchy and Schwarz.
constexpr double kSpectrumError = 1e-6 + RadialInstrument::kTransformError;

// Few balls whose union, grown by `slack`, holds all balls. Sums of fewer balls count less of the
// body twice.
BodyDensity thinned(const CollisionBody& body, double slack, double by) {
  const Eigen::Matrix4Xd& balls = body.balls.points;
  const std::vector<Eigen::Index> kept = uncontained_balls(balls, slack);
  const Knots knots{balls(Eigen::all, kept),
                    Eigen::VectorXcd::Ones(static_cast<Eigen::Index>(kept.size()))};
  return density_of_knots(knots, RadialKernel{}, slack + by);
}

BodyDensity as_it_is(const CollisionBody& body) {
  if (body.density.size() > 0) return body.density;
  Knots knots = body.balls;
  knots.weights.setOnes();
  return density_of_knots(knots);
}

// Int a(x) b(T x) dx is at most the product of the roots of Int a^2 and Int b^2, at every pose.
double largest_overlap(const BodyDensity& a, const BodyDensity& b) {
  return std::sqrt(ball_energy(a) * ball_energy(b));
}

// The least |w| that a series of so many modes, w and -w together, may lack: the first lattice
// shell that it does not hold as a whole.
double bandwidth_of(int modes, double box) {
  const int held = 2 * ((modes + 1) / 2) - 1;
  const int reach = static_cast<int>(std::cbrt(held)) + 2;  // that cube holds more
  std::vector<int> shells(static_cast<std::size_t>(reach * reach) + 1, 0);
  for (int x = -reach; x <= reach; ++x)
    for (int y = -reach; y <= reach; ++y)
      for (int z = -reach; z <= reach; ++z)
        if (const int n = x * x + y * y + z * z; n <= reach * reach) ++shells[n];
  std::size_t first = 0;
  for (int sum = 0; first < shells.size() && sum + shells[first] <= held; ++first)
    sum += shells[first];
  return std::sqrt(static_cast<double>(first)) / box;
}

// The certified cut-off of the grown bodies' smoothed gap function.
struct Cut {
  std::unique_ptr<GapFunction> gap;
  double band = std::numeric_limits<double>::infinity();
  double growth = 0.0, threshold = 0.0, sum_error = 0.0;  // threshold of the exact sum
};

}  // namespace

struct Collider::State {
  CollisionBody fixed_body, moving_body;
  BallTree fixed, moving;
  ColliderOptions options;
  std::unique_ptr<GapFunction> values;  // of the bodies, if asked for
  mutable Cut known_cut;
  mutable std::once_flag cut_known;

  State(const CollisionBody& f, const CollisionBody& m, const ColliderOptions& asked)
      : fixed_body(f),
        moving_body(m),
        fixed(f.balls.points, f.margin),
        moving(m.balls.points, m.margin),
        options(asked) {}
  [[nodiscard]] double tree_band() const { return fixed_body.margin + moving_body.margin; }
  [[nodiscard]] std::int64_t steps() const {
    constexpr std::int64_t kEndless = std::numeric_limits<std::int64_t>::max();
    return tree_band() > 0.0 ? options.tree_steps : kEndless;
  }
  // Seconds of work that few need: the trees settle most poses.
  [[nodiscard]] const Cut& cut() const {
    std::call_once(cut_known, [&] { known_cut = least_band(); });
    return known_cut;
  }
  [[nodiscard]] Cut least_band() const;
};

// The growth x0 with the least band 2 x0 + x1, by trial: small ones drown in the sum's own error,
// large ones are a band by themselves.
Cut Collider::State::least_band() const {
  Cut best;
  const double reach = bounding_ball(thinned(fixed_body, 0.0, 0.0)).radius +
                       bounding_ball(thinned(moving_body, 0.0, 0.0)).radius;
  for (const double share : {0.04, 0.06, 0.09, 0.13, 0.19, 0.28}) {
    const double x0 = share * reach, slack = 0.7 * x0;
    const BodyDensity a = thinned(fixed_body, slack, x0), b = thinned(moving_body, slack, x0);
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
        certain ? 2.0 * (x0 + slack) + x1 + tree_band() : std::numeric_limits<double>::infinity();
    if (best.gap == nullptr || band < best.band) {
      const double sum_error = trial->sum_error_bound();
      best = {std::move(trial), band, x0, inside, sum_error};
    }
  }
  return best;
}

Collider::Collider(const CollisionBody& fixed, const CollisionBody& moving,
                   const ColliderOptions& options) {
  for (const CollisionBody* body : {&fixed, &moving}) {
    check_knots(body->balls, "Collider");
    if (!(body->margin >= 0.0) || !std::isfinite(body->margin))
      throw InputError("Collider: margin must be >= 0, got " + std::to_string(body->margin));
  }
  if (options.modes < 200)  // below, lattice points in a ball are too unlike its volume
    throw InputError("Collider: modes must be >= 200, got " + std::to_string(options.modes));
  if (options.tree_steps < 0)
    throw InputError("Collider: tree_steps must be >= 0, got " +
                     std::to_string(options.tree_steps));
  state_ = std::make_unique<State>(fixed, moving, options);
  if (options.with_gap)
    state_->values = std::make_unique<GapFunction>(as_it_is(fixed), as_it_is(moving),
                                                   GapOptions{.max_modes = options.modes,
                                                              .oversampling = options.oversampling,
                                                              .threads = options.threads});
}

Collider::~Collider() = default;
Collider::Collider(Collider&&) noexcept = default;
Collider& Collider::operator=(Collider&&) noexcept = default;

Collision Collider::operator()(const RigidMotion& moving_in_fixed) const {
  check_motion(moving_in_fixed, "Collider");
  const State& s = *state_;
  const RigidMotion pose{moving_in_fixed.rotation.normalized(), moving_in_fixed.translation};
  using Verdict = BallTree::Verdict;
  Collision answer;
  if (s.values != nullptr) answer.gap = (*s.values)(pose);
  const Verdict verdict = s.options.tree_steps > 0
                              ? BallTree::compare(s.fixed, s.moving, pose, s.steps())
                              : Verdict::kStopped;
  if (verdict == Verdict::kApart || verdict == Verdict::kMeet) {
    answer.contact = verdict == Verdict::kMeet ? Contact::kYes : Contact::kNo;
    return answer;
  }
  // Balls that meet, but no inner ones: how close that is, is all there is to say. The sum could
  // say no only where they do not meet.
  if (verdict != Verdict::kStopped) return answer;
  answer.by = DecidedBy::kSum;
  const Cut& cut = s.cut();
  const GapFunction::Rejection sum = cut.gap->reject(pose, cut.threshold);
  answer.modes = sum.modes;
  // With all modes summed the bound is the value plus its error, so the value itself is above the
  // threshold where the bound is by more than two errors; between, double precision decides.
  if (sum.rejected || (sum.bound <= cut.threshold + 2.0 * cut.sum_error &&
                       cut.gap->exact(pose).value < cut.threshold))
    answer.contact = Contact::kNo;
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

double Collider::tree_band() const noexcept { return state_->tree_band(); }
double Collider::sum_band() const { return state_->cut().band; }
double Collider::growth() const { return state_->cut().growth; }
double Collider::threshold() const { return state_->cut().threshold; }
const GapFunction& Collider::gap_function() const { return *state_->cut().gap; }

}  // namespace mortise
