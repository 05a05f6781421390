// SPDX-License-Identifier: GPL-3.0-or-later
// Mating of two parts: knots and channels, the search, judging what it finds.
#include "mortise/runs/mate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "mortise/affinity/sampled_field.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"
#include "mortise/parts/diameter.hpp"
#include "mortise/parts/mesh_solid.hpp"
#include "mortise/parts/sample_surface.hpp"
#include "mortise/parts/skeletal_density.hpp"
#include "mortise/poses/cluster.hpp"
#include "runs/local_part.hpp"
#include "runs/mate_directions.hpp"
#include "scoring/mate_contact.hpp"

namespace mortise {
namespace {

void check_options(const MateOptions& o) {
  const auto refuse = [](const std::string& what) { throw InputError("mate: " + what); };
  const auto positive = [&](const char* name, double value) {
    if (!(value > 0.0) || !std::isfinite(value))
      refuse(std::string(name) + " must be > 0 and finite, got " + std::to_string(value));
  };
  if (o.rotations < 1) refuse("rotations must be >= 1, got " + std::to_string(o.rotations));
  if (o.aligned < 0 || o.turns < 0)
    refuse("aligned and turns must be >= 0, got " + std::to_string(o.aligned) + " and " +
           std::to_string(o.turns));
  positive("spacing", o.spacing);
  positive("most cells", o.most_cells);
  positive("skin", o.skin);
  positive("detail", o.detail);
  positive("tolerance", o.tolerance);
  const auto not_negative = [&](const char* name, double value) {
    if (!(value >= 0.0) || !std::isfinite(value))
      refuse(std::string(name) + " must be >= 0 and finite, got " + std::to_string(value));
  };
  if (!(o.penalty > 1.0) || !std::isfinite(o.penalty))
    refuse("penalty must be > 1 and finite, got " + std::to_string(o.penalty));
  not_negative("feature", o.feature);
  not_negative("skeletal", o.skeletal);
  not_negative("overlap", o.overlap);
  not_negative("separation", o.separation);
  not_negative("cluster radius", o.cluster_radius);
  if (!(o.flat >= 0.0 && o.flat <= 1.0))
    refuse("flat must be 0 to 1, got " + std::to_string(o.flat));
  if (o.samples < 100) refuse("samples must be >= 100, got " + std::to_string(o.samples));
  if (o.polished < 1) refuse("polished must be >= 1, got " + std::to_string(o.polished));
  if (o.poses < 1) refuse("poses must be >= 1, got " + std::to_string(o.poses));
  if (o.axis && !(o.axis->fixed.norm() > 0.0 && o.axis->moving.norm() > 0.0 &&
                  o.axis->fixed.allFinite() && o.axis->moving.allFinite()))
    refuse("an axis must be finite and not 0");
}

// Nodes of a lattice over the field's grid and the distances there, carried to the input frame.
Knots skin_knots(const char* name, const LocalFrame& frame, const DistanceField& field,
                 const SampledSkinOptions& options) {
  const Eigen::Vector3d low = field.low();
  const Eigen::Vector3d extent = field.high() - low;
  std::vector<Eigen::Vector3d> nodes;
  std::vector<double> distances;
  Eigen::Vector3f gradient;
  for (double x = 0.5 * options.spacing; x < extent[0]; x += options.spacing)
    for (double y = 0.5 * options.spacing; y < extent[1]; y += options.spacing)
      for (double z = 0.5 * options.spacing; z < extent[2]; z += options.spacing) {
        const Eigen::Vector3d node = low + Eigen::Vector3d(x, y, z);
        const float d = field.at(node.cast<float>(), gradient);
        if (d > options.offset + options.spacing) continue;  // and kFar
        nodes.push_back(node);
        distances.push_back(d);
      }
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i)
    points.col(static_cast<Eigen::Index>(i)) = nodes[i];
  Knots knots;
  try {
    knots = sample_double_skin(points,
                               Eigen::Map<const Eigen::VectorXd>(
                                   distances.data(), static_cast<Eigen::Index>(distances.size())),
                               options);
  } catch (const InputError& e) {
    throw InputError(
        std::string("mate: the ") + name + " part at a grid step of " +
        std::to_string(options.spacing) + " of the smaller part's diameter: " + e.what() +
        "; take a finer step (spacing), and let the grid have more cells " + "(most cells)");
  }
  knots.points.topRows<3>() = frame.to_input(knots.points.topRows<3>());
  knots.points.row(3) *= frame.unit;
  return knots;
}

// The skeletal density [HA, Eq. 2-3] at the nodes of the skin: a field like any other, so that it
// turns exactly and no spectrum is interpolated.
Knots skeletal_knots(const MatePart& part, const Knots& skin, const MateOptions& options) {
  const auto* solid = dynamic_cast<const MeshSolid*>(part.solid.get());
  if (solid == nullptr)
    throw InputError("Mating: the skeletal channel needs parts whose solids are MeshSolid");
  return {skin.points,
          skeletal_density_at(*solid, skin.points.topRows<3>(),
                              {.penalty = options.penalty, .threads = options.threads})};
}

// `count` turns about the fixed axis, for each way round that the moving axis can lie along it;
// into the search frame.
RotationSet axial_rotations(const MateAxis& axis, int count,
                            const Eigen::Quaterniond& search_from_fixed) {
  RotationSet set;
  set.quaternions.resize(4, 2 * Eigen::Index{count});
  const Eigen::Vector3d to = axis.fixed.normalized();
  for (int way = 0; way < 2; ++way) {
    const Eigen::Vector3d onto = way == 0 ? to : Eigen::Vector3d(-to);
    const auto lay = Eigen::Quaterniond::FromTwoVectors(axis.moving.normalized(), onto);
    for (int i = 0; i < count; ++i) {
      const Eigen::Quaterniond q = canonical(
          search_from_fixed *
          Eigen::Quaterniond(Eigen::AngleAxisd(2.0 * std::numbers::pi * i / count, to)) * lay);
      set.quaternions.col(Eigen::Index{way} * count + i) << q.w(), q.x(), q.y(), q.z();
    }
  }
  set.covering_radius = std::numbers::pi / count;
  return set;
}

// Best first; equal values in the order given, so that the ranking is the same everywhere.
std::vector<std::size_t> ranking(const std::vector<double>& score) {
  std::vector<std::size_t> order(score.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return score[a] > score[b]; });
  return order;
}

struct Placed {
  RigidMotion motion;
  std::int32_t rotation = -1;
};

}  // namespace

struct Mating::Impl {
  MateOptions options;
  LocalFrame fixed_frame, moving_frame;
  static constexpr double unit = 1.0;  // smaller diameter, in the frames of `pair`
  std::unique_ptr<ContactPair> pair;   // of the parts about their own centres
  Knots fixed_knots, moving_knots;
  RotationSet rotations;
  std::unique_ptr<RotationSearch> search;

  // Contact and penetration of a placement as shares of the smaller surface. Contact whose normals
  // cancel holds a part; what pushes it one way, as a face laid on another does, can be left by
  // moving away. It counts as far as the rest backs it: half their harmonic mean.
  [[nodiscard]] std::array<double, 2> channels(const RigidMotion& motion, double tolerance,
                                               double share, double overlap) const {
    const ContactFit fit = pair->fit(motion, tolerance, share);
    const double area = pair->smaller_area();
    const double held = std::max(0.0, fit.contact - fit.one_sided);
    const double backed = fit.contact > 0.0 ? held * fit.one_sided / (held + fit.one_sided) : 0.0;
    return {(held + options.flat * backed) / area, -overlap * fit.penetration / area};
  }

  // Of a placement that is not polished yet: the grid's step alone makes it penetrate, so that
  // costs less.
  [[nodiscard]] double rough_score(const RigidMotion& motion, double tolerance,
                                   double share) const {
    const auto [contact, penetration] =
        channels(motion, tolerance, share, std::min(1.0, options.overlap));
    return contact + penetration;
  }

  [[nodiscard]] double score(const RigidMotion& motion) const {
    const auto [contact, penetration] =
        channels(motion, options.tolerance * unit, 1.0, options.overlap);
    return contact + penetration;
  }

  [[nodiscard]] RigidMotion polish(const RigidMotion& start) const {
    // Ever narrower. Descending the energy may lose in the
    // score: the best of all stages is what counts, never worse than the start.
    struct Stage {
      double sigma, penalty;
    };
    constexpr Stage kStages[] = {{4.0, 2.0}, {2.0, 2.0}, {1.0, 2.0}, {0.5, 3.0}};
    RigidMotion motion = start;
    RigidMotion best = start;
    const double tolerance = options.tolerance * unit;
    double best_score = score(start);
    for (const Stage& stage : kStages) {
      motion = pair->descend(motion, stage.sigma * tolerance, stage.penalty, 1.0, 8);
      const double here = score(motion);
      if (here > best_score) {
        best = motion;
        best_score = here;
      }
    }
    return best;
  }

  // Applies `change` to each placement, judges it, clusters and keeps the best.
  template <class Change, class Judge>
  [[nodiscard]] std::vector<Placed> sieve(std::vector<Placed> all, const Change& change,
                                          const Judge& judge, std::size_t keep) const {
    std::vector<double> scores(all.size());
    constexpr std::size_t kPiece = 16;
    parallel_for((all.size() + kPiece - 1) / kPiece, options.threads, [&](std::size_t piece, int) {
      const std::size_t end = std::min(all.size(), (piece + 1) * kPiece);
      for (std::size_t i = piece * kPiece; i < end; ++i) {
        all[i].motion = change(all[i].motion);
        scores[i] = judge(all[i].motion);
      }
    });
    const std::vector<std::size_t> order = ranking(scores);
    std::vector<RigidMotion> motions;
    motions.reserve(order.size());
    for (const std::size_t i : order) motions.push_back(all[i].motion);
    const Clusters clusters =
        cluster_poses(motions, pair->moving().points.cast<double>(),
                      {.radius = options.cluster_radius * unit, .max_clusters = keep});
    std::vector<Placed> kept;
    for (const std::size_t f : clusters.founders) kept.push_back(all[order[f]]);
    return kept;
  }
};

Mating::Mating(const MatePart& fixed, const MatePart& moving, const MateOptions& options)
    : impl_(std::make_unique<Impl>()) {
  check_options(options);
  impl_->options = options;
  constexpr Eigen::Index kProbe = 2000;
  const double length =
      std::min(diameter_of(fixed.mesh.vertices), diameter_of(moving.mesh.vertices));
  impl_->fixed_frame = {fixed.solid->bounds().center(), length};
  impl_->moving_frame = {moving.solid->bounds().center(), length};
  const MatePart local_fixed = local_part(fixed, impl_->fixed_frame);
  const MatePart local_moving = local_part(moving, impl_->moving_frame);
  SurfaceSamples fixed_samples = sample_surface(local_fixed.mesh, kProbe);
  SurfaceSamples moving_samples = sample_surface(local_moving.mesh, kProbe);
  // One density of samples for both surfaces, within reason.
  const double smaller = std::min(fixed_samples.area, moving_samples.area);
  const auto count = [&](double area) {
    return static_cast<Eigen::Index>(std::min(20.0, area / smaller) * options.samples);
  };
  fixed_samples = sample_surface(local_fixed.mesh, count(fixed_samples.area));
  moving_samples = sample_surface(local_moving.mesh, count(moving_samples.area));
  // A fixed part much larger than the moving one needs a box that a grid as fine would make slow.
  const double reach = diameter_of(local_moving.mesh.vertices) + 2.0 * options.skin;
  const double box = (local_fixed.solid->bounds().sizes().array() + reach).prod();
  const double coarser = std::max(1.0, std::cbrt(box / options.most_cells) / options.spacing);
  const double step = coarser * options.spacing;
  const double offset = coarser * options.skin;
  const double margin = std::max(offset + 2.0 * step, 16.0 * options.tolerance);
  const auto body = [&](const MatePart& part, const SurfaceSamples& samples) {
    // As fine as asked, but for a part so much the larger that its grid would not fit.
    constexpr double kMostNodes = 1.2e7;
    const Eigen::AlignedBox3d bounds = part.solid->bounds();
    const double volume = (bounds.sizes().array() + 2.0 * margin).prod();
    const double detail = std::max(options.detail, std::cbrt(volume / kMostNodes));
    return ContactBody(samples, DistanceField(*part.solid, detail, margin, options.threads),
                       bounds.center());
  };
  impl_->pair = std::make_unique<ContactPair>(body(local_fixed, fixed_samples),
                                              body(local_moving, moving_samples));
  const SampledSkinOptions skin{.spacing = step,
                                .offset = offset,
                                .penalty = options.penalty,
                                .feature = options.feature,
                                .feature_radius = 2.0 * offset};
  impl_->fixed_knots = skin_knots("fixed", impl_->fixed_frame, impl_->pair->fixed().field, skin);
  impl_->moving_knots =
      skin_knots("moving", impl_->moving_frame, impl_->pair->moving().field, skin);
  SearchOptions search;
  search.spacing = step * length;
  search.cutoff = 0.75 / search.spacing;
  search.per_rotation = options.per_rotation;
  search.separation = options.separation * length;
  search.summits = true;  // sliding fits have long slopes, which would take all places
  search.threads = options.threads;
  // In units of the grid step the scores fit single precision, whatever the parts' unit.
  const double weight = std::pow(search.spacing, -3);
  std::vector<Channel> channels{
      sampled_channel("skin", weight, impl_->fixed_knots, impl_->moving_knots, search.spacing)};
  if (options.skeletal > 0.0)
    channels.push_back(sampled_channel(
        "skeletal", weight * options.skeletal, skeletal_knots(fixed, impl_->fixed_knots, options),
        skeletal_knots(moving, impl_->moving_knots, options), search.spacing));
  // The search's frame depends on the knots alone: a search on a coarse grid tells it.
  SearchOptions coarse = search;
  coarse.spacing = 4.0 * search.spacing;
  const Eigen::Quaterniond search_from_fixed =
      RotationSearch(channels, Eigen::Vector4d(1.0, 0.0, 0.0, 0.0), coarse)
          .search_from_fixed()
          .rotation;
  if (options.axis) {
    impl_->rotations = axial_rotations(*options.axis, options.rotations, search_from_fixed);
  } else {
    impl_->rotations = rotation_set(options.rotations, RotationMethod::kAuto, options.threads);
    const Eigen::Matrix4Xd aligned =
        aligned_rotations(find_directions(local_fixed.mesh), find_directions(local_moving.mesh),
                          options.turns, options.aligned);
    const Eigen::Index regular = impl_->rotations.size();
    impl_->rotations.quaternions.conservativeResize(4, regular + aligned.cols());
    for (Eigen::Index i = 0; i < aligned.cols(); ++i) {
      const Eigen::Quaterniond q =
          canonical(search_from_fixed *
                    Eigen::Quaterniond(aligned(0, i), aligned(1, i), aligned(2, i), aligned(3, i)));
      impl_->rotations.quaternions.col(regular + i) << q.w(), q.x(), q.y(), q.z();
    }
  }
  impl_->search = std::make_unique<RotationSearch>(channels, impl_->rotations.quaternions, search);
}

Mating::~Mating() = default;
Mating::Mating(Mating&&) noexcept = default;
Mating& Mating::operator=(Mating&&) noexcept = default;

RotationSearch& Mating::search() { return *impl_->search; }
const RotationSet& Mating::rotations() const { return impl_->rotations; }
const Knots& Mating::fixed_knots() const { return impl_->fixed_knots; }
const Knots& Mating::moving_knots() const { return impl_->moving_knots; }
double Mating::smaller_diameter() const { return impl_->fixed_frame.unit; }

Pose Mating::judge(const RigidMotion& motion) const {
  Pose pose;
  pose.moving_in_fixed = motion;
  const auto channels =
      impl_->channels(local_motion(impl_->fixed_frame, impl_->moving_frame, motion),
                      impl_->options.tolerance * impl_->unit, 1.0, impl_->options.overlap);
  pose.channels = {channels[0], channels[1]};
  pose.score = channels[0] + channels[1];
  return pose;
}

RigidMotion Mating::polish(const RigidMotion& motion) const {
  const Impl& m = *impl_;
  return input_motion(m.fixed_frame, m.moving_frame,
                      m.polish(local_motion(m.fixed_frame, m.moving_frame, motion)));
}

PoseList Mating::rank() const {
  const Impl& run = *impl_;
  const double unit = run.unit;
  const double tolerance = run.options.tolerance * unit;
  std::vector<Placed> placed;
  for (const Candidate& c : run.search->candidates())
    placed.push_back(
        {local_motion(run.fixed_frame, run.moving_frame, run.search->moving_in_fixed(c)),
         c.rotation_index});
  const auto keep = static_cast<std::size_t>(run.options.polished);
  const auto as_it_is = [](const RigidMotion& m) { return m; };
  // Coarse to fine, few points to many, many placements to few.
  placed = run.sieve(
      std::move(placed), as_it_is,
      [&](const RigidMotion& m) { return run.rough_score(m, 4.0 * tolerance, 0.15); }, 20 * keep);
  const auto rough = [&](const RigidMotion& m) {
    return run.rough_score(m, 2.0 * tolerance, 0.25);
  };
  placed = run.sieve(
      std::move(placed),
      [&](const RigidMotion& m) {
        // From afar a wide energy finds the way, from near by it may lose it: both are tried.
        const RigidMotion wide = run.pair->descend(
            run.pair->descend(m, 6.0 * tolerance, 1.0, 0.1, 5), 3.0 * tolerance, 1.0, 0.15, 5);
        const RigidMotion narrow = run.pair->descend(m, 2.0 * tolerance, 1.0, 0.15, 6);
        return rough(wide) >= rough(narrow) ? wide : narrow;
      },
      rough, keep);
  placed = run.sieve(
      std::move(placed), [&](const RigidMotion& m) { return run.polish(m); },
      [&](const RigidMotion& m) { return run.score(m); },
      static_cast<std::size_t>(run.options.poses));
  PoseList best{{"contact", "penetration"}, {}};
  for (const Placed& p : placed) {
    best.poses.push_back(judge(input_motion(run.fixed_frame, run.moving_frame, p.motion)));
    best.poses.back().rotation_index = p.rotation;
    best.poses.back().cluster = static_cast<int>(best.poses.size()) - 1;
  }
  return best;
}

}  // namespace mortise
