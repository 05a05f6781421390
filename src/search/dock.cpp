// SPDX-License-Identifier: GPL-3.0-or-later
// Docking of two molecules: search, rescore, cluster, rank.
#include "mortise/search/dock.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "mortise/core/errors.hpp"
#include "mortise/molecules/to_knots.hpp"
#include "mortise/search/cluster.hpp"

namespace mortise {
namespace {

void check_options(const DockOptions& o) {
  const auto refuse = [](const std::string& what) { throw InputError("dock: " + what); };
  if (o.rotations < 1) refuse("rotations must be >= 1, got " + std::to_string(o.rotations));
  if (!(o.radius > 0.0)) refuse("radius must be > 0, got " + std::to_string(o.radius));
  if (o.poses < 1) refuse("poses must be >= 1, got " + std::to_string(o.poses));
  if (!(o.cluster_radius >= 0.0))
    refuse("cluster radius must be >= 0, got " + std::to_string(o.cluster_radius));
}

// Best first; equal scores in the order of the search, so that the ranking is one and the same
// everywhere.
template <class Score>
std::vector<std::size_t> ranking(std::size_t count, const Score& score) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return score(a) > score(b); });
  return order;
}

}  // namespace

DockOptions dock_preset(const std::string& name) {
  DockOptions options;
  if (name == "default") return options;
  if (name == "fast") {
    options.search.spacing = 3.5;
    return options;
  }
  if (name == "thorough") {
    options.rotations = 54000;
    options.search.per_rotation = 2;
    return options;
  }
  throw InputError("preset '" + name + "' is not one of fast, default, thorough");
}

std::string to_json(const DockOptions& o) {
  const nlohmann::ordered_json json = {
      {"rotations", o.rotations},
      {"spacing", o.search.spacing},
      {"cutoff", o.search.cutoff},
      {"per_rotation", o.search.per_rotation},
      {"separation", o.search.separation},
      {"spread_width", o.search.spread_width},
      {"offset", o.double_skin.offset},
      {"penalty", o.double_skin.penalty},
      {"radius", o.radius},
      {"propensity", o.propensity},
      {"rescore", o.rescore},
      {"poses", o.poses},
      {"cluster_radius", o.cluster_radius},
  };
  return json.dump();
}

struct Docking::Impl {
  DockOptions options;
  Molecule fixed, moving;
  Knots fixed_knots, moving_knots;
  RotationSet rotations;
  std::unique_ptr<RotationSearch> search;
};

Docking::Docking(const Molecule& fixed, const Molecule& moving, const DockOptions& options)
    : impl_(std::make_unique<Impl>()) {
  check_options(options);
  impl_->options = options;
  impl_->fixed = fixed;
  impl_->moving = moving;
  const ToKnotsOptions knots{
      .radius = options.radius, .propensity = options.propensity, .threads = options.threads};
  impl_->fixed_knots = to_knots(fixed, knots);
  impl_->moving_knots = to_knots(moving, knots);
  impl_->rotations = rotation_set(options.rotations, RotationMethod::kAuto, options.threads);
  SearchOptions search = options.search;
  search.threads = options.threads;
  impl_->search = std::make_unique<RotationSearch>(
      std::vector<Channel>{
          double_skin_channel(impl_->fixed_knots, impl_->moving_knots, options.double_skin)},
      impl_->rotations.quaternions, search);
}

Docking::~Docking() = default;
Docking::Docking(Docking&&) noexcept = default;
Docking& Docking::operator=(Docking&&) noexcept = default;

RotationSearch& Docking::search() { return *impl_->search; }
const RotationSet& Docking::rotations() const { return impl_->rotations; }
const Knots& Docking::fixed_knots() const { return impl_->fixed_knots; }
const Knots& Docking::moving_knots() const { return impl_->moving_knots; }

PoseList Docking::rank() const {
  const std::vector<Candidate> candidates = impl_->search->candidates();
  PoseList all{{"shape"}, {}};
  all.poses.reserve(candidates.size());
  for (const Candidate& c : candidates) {
    Pose pose;
    pose.moving_in_fixed = impl_->search->moving_in_fixed(c);
    pose.score = c.score;
    pose.channels = {pose.score};
    pose.rotation_index = c.rotation_index;
    all.poses.push_back(std::move(pose));
  }
  const std::vector<std::size_t> order =
      ranking(all.poses.size(), [&](std::size_t i) { return all.poses[i].score; });
  std::vector<RigidMotion> motions;
  motions.reserve(order.size());
  for (const std::size_t i : order) motions.push_back(all.poses[i].moving_in_fixed);
  const Clusters clusters =
      cluster_poses(motions, impl_->moving_knots.points.topRows<3>(),
                    {.radius = impl_->options.cluster_radius,
                     .max_clusters = static_cast<std::size_t>(impl_->options.poses)});
  PoseList best{all.channel_names, {}};
  for (const std::size_t f : clusters.founders) {
    best.poses.push_back(all.poses[order[f]]);
    best.poses.back().cluster = static_cast<int>(best.poses.size()) - 1;
  }
  return best;
}

}  // namespace mortise
