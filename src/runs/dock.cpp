// SPDX-License-Identifier: GPL-3.0-or-later
// Docking of two molecules: search, rescore, cluster, rank.
#include "mortise/runs/dock.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>

#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"
#include "mortise/molecules/contact_types.hpp"
#include "mortise/molecules/radii.hpp"
#include "mortise/molecules/to_knots.hpp"
#include "mortise/poses/cluster.hpp"
#include "mortise/poses/polish.hpp"
#include "mortise/scoring/contact_potential.hpp"
#include "mortise/scoring/score_maps.hpp"
#include "mortise/scoring/shape_kernel.hpp"

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
    options.search.per_rotation = 2;
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
      {"potential", o.potential},
      {"polish", o.polish},
      {"poses", o.poses},
      {"cluster_radius", o.cluster_radius},
  };
  return json.dump();
}

struct Docking::Impl {
  DockOptions options;
  Knots fixed_knots, moving_knots;
  RotationSet rotations;
  std::unique_ptr<RotationSearch> search;
  ContactPotential potential;
  TypedPoints moving_points;
  std::optional<ScoreMaps> maps;       // with options.rescore or options.polish
  std::optional<PlacedPoints> placed;  // with options.polish

  void make_maps(const Molecule& fixed, const Channel& shape);
  void polish(std::vector<Pose>& poses) const;
  [[nodiscard]] PoseList best_of_clusters(const PoseList& all, std::size_t count) const;
};

void Docking::Impl::make_maps(const Molecule& fixed, const Channel& shape) {
  TypedPoints points{atom_positions(fixed), contact_types(fixed)};
  if (!options.rescore) {  // maps of the shape alone
    points.types.setConstant(-1);
    moving_points.types.setConstant(-1);
    potential = {1.0, Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, 0)};
  }
  const ScoreMapsOptions map_options{.threads = options.threads};
  if (!options.polish) {
    maps.emplace(points, potential, map_options);
    return;
  }
  const TabulatedKernel kernel =
      shape_kernel(shape, options.radius, options.radius, {.cutoff = options.search.cutoff});
  // The channel's weights are i w, so that a pair counts -w w'.
  maps.emplace(points, potential, fixed_knots.points.topRows<3>(),
               -potential.shape * fixed_knots.weights.real(), kernel, map_options);
  placed.emplace(moving_points, moving_knots.points.topRows<3>(), moving_knots.weights.real());
}

// Moves the poses and leaves them the scores by which they were found: ranking by the score at the
// end favours the wrong poses that had most to gain (docs/ranking.md).
void Docking::Impl::polish(std::vector<Pose>& poses) const {
  std::vector<RigidMotion> starts;
  starts.reserve(poses.size());
  for (const Pose& pose : poses) starts.push_back(pose.moving_in_fixed);
  const std::vector<PolishedPose> polished =
      polish_poses([&](const RigidMotion& m) { return maps->smooth_score(*placed, m); },
                   {placed->centre, placed->gyration}, starts, {.threads = options.threads});
  for (std::size_t i = 0; i < poses.size(); ++i)
    poses[i].moving_in_fixed = polished[i].moving_in_fixed;
}

// Ranks the poses and keeps the best of each cluster, `count` at most.
PoseList Docking::Impl::best_of_clusters(const PoseList& all, std::size_t count) const {
  const std::vector<std::size_t> order =
      ranking(all.poses.size(), [&](std::size_t i) { return all.poses[i].score; });
  std::vector<RigidMotion> motions;
  motions.reserve(order.size());
  for (const std::size_t i : order) motions.push_back(all.poses[i].moving_in_fixed);
  const Clusters clusters =
      cluster_poses(motions, moving_knots.points.topRows<3>(),
                    {.radius = options.cluster_radius, .max_clusters = count});
  PoseList best{all.channel_names, {}};
  for (const std::size_t f : clusters.founders) {
    best.poses.push_back(all.poses[order[f]]);
    best.poses.back().cluster = static_cast<int>(best.poses.size()) - 1;
  }
  return best;
}

Docking::Docking(const Molecule& fixed, const Molecule& moving, const DockOptions& options)
    : impl_(std::make_unique<Impl>()) {
  check_options(options);
  impl_->options = options;
  const ToKnotsOptions knots{
      .radius = options.radius, .propensity = options.propensity, .threads = options.threads};
  impl_->fixed_knots = to_knots(fixed, knots);
  impl_->moving_knots = to_knots(moving, knots);
  impl_->rotations = rotation_set(options.rotations, RotationMethod::kAuto, options.threads);
  SearchOptions search = options.search;
  search.threads = options.threads;
  const Channel shape =
      double_skin_channel(impl_->fixed_knots, impl_->moving_knots, options.double_skin);
  impl_->search = std::make_unique<RotationSearch>(std::vector<Channel>{shape},
                                                   impl_->rotations.quaternions, search);
  if (!options.rescore && !options.polish) return;
  if (options.rescore)
    impl_->potential = options.potential.empty()
                           ? fitted_contact_potential()
                           : read_contact_potential(options.potential, kContactTypes);
  impl_->moving_points = {atom_positions(moving), contact_types(moving)};
  impl_->make_maps(fixed, shape);
}

Docking::~Docking() = default;
Docking::Docking(Docking&&) noexcept = default;
Docking& Docking::operator=(Docking&&) noexcept = default;

RotationSearch& Docking::search() { return *impl_->search; }
const RotationSet& Docking::rotations() const { return impl_->rotations; }
const Knots& Docking::fixed_knots() const { return impl_->fixed_knots; }
const Knots& Docking::moving_knots() const { return impl_->moving_knots; }

PoseList Docking::rank() const {
  const Impl& run = *impl_;
  const std::vector<Candidate> candidates = run.search->candidates();
  const double shape_factor = run.options.rescore ? run.potential.shape : 1.0;
  PoseList all{{"shape"}, std::vector<Pose>(candidates.size())};
  if (run.options.rescore) all.channel_names.emplace_back("contact");
  const auto score = [&](std::size_t i) {
    const Candidate& c = candidates[i];
    Pose& pose = all.poses[i];
    pose.moving_in_fixed = run.search->moving_in_fixed(c);
    pose.rotation_index = c.rotation_index;
    pose.channels = {shape_factor * c.score};
    if (run.options.rescore)
      pose.channels.push_back(run.maps->score(run.moving_points, pose.moving_in_fixed));
    pose.score = std::accumulate(pose.channels.begin(), pose.channels.end(), 0.0);
  };
  // Pieces large enough that handing them out costs nothing.
  constexpr std::size_t kPiece = 256;
  parallel_for((candidates.size() + kPiece - 1) / kPiece, run.options.threads,
               [&](std::size_t piece, int) {
                 const std::size_t end = std::min(candidates.size(), (piece + 1) * kPiece);
                 for (std::size_t i = piece * kPiece; i < end; ++i) score(i);
               });
  const auto count = static_cast<std::size_t>(run.options.poses);
  if (!run.options.polish) return run.best_of_clusters(all, count);
  PoseList best = run.best_of_clusters(all, count + count / 4);  // some will fall together
  run.polish(best.poses);
  return run.best_of_clusters(best, count);
}

}  // namespace mortise
