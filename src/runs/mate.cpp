// SPDX-License-Identifier: GPL-3.0-or-later
// Mating: what is searched, and how candidates become poses.
#include "mortise/runs/mate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include "mortise/affinity/double_skin.hpp"
#include "mortise/affinity/sampled_field.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/rotation_vector.hpp"
#include "mortise/metrics/contact.hpp"
#include "mortise/parts/diameter.hpp"
#include "mortise/parts/mesh_solid.hpp"
#include "mortise/parts/sample_surface.hpp"
#include "mortise/parts/skeletal_density.hpp"
#include "mortise/runs/body_forms.hpp"
#include "runs/mate_directions.hpp"
#include "runs/option_table.hpp"
#include "runs/part_knots.hpp"
#include "runs/random_start.hpp"
#include "scoring/part_scorer.hpp"

namespace mortise {
namespace {

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
Knots skeletal_knots(const Part& part, const Knots& skin, const MateOptions& options) {
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
    const Eigen::Quaterniond lay = rotation_between(axis.moving, onto);
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

// The two parts of a mating, as plan_mate() takes them in turn.
struct Parts {
  Part fixed, moving;  // input frame; frame of the start
  Part local_fixed, local_moving;
  std::shared_ptr<const PartPair> pair;
  double length = 1.0;   // that the options' fractions refer to
  double step = 0.0;     // of the search's grid, fractions of the length
  double offset = 0.0;   // of the skin, likewise
  double coarser = 1.0;  // step and skin, times those asked for
};

void check_clearances(const MateOptions& options) {
  const std::vector<double>& all = options.clearances;
  if (all.empty()) return;
  const auto refuse = [](const std::string& why) { throw InputError("mate: clearances " + why); };
  if (all.size() > kMostClearances)
    refuse("must be at most " + std::to_string(kMostClearances) + ", got " +
           std::to_string(all.size()));
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!(all[i] >= 0.0) || !std::isfinite(all[i]))
      refuse("must be >= 0 and finite, got " + short_number(all[i]));
    if (i > 0 && !(all[i] > all[i - 1]))
      refuse("must rise, got " + short_number(all[i]) + " after " + short_number(all[i - 1]));
  }
  if (options.knots != PartKnots::kBalls)
    refuse(
        "need --knots balls: the search grows the moving part's balls by each clearance, and nodes "
        "of a grid cannot grow");
}

// The largest clearance, in diameters of the smaller part; 0 if there is none.
double widest_clearance(double length, const MateOptions& options) {
  if (options.clearances.empty()) return 0.0;
  const double widest = options.clearances.back() / length;
  if (!(widest <= 0.25))
    throw InputError("mate: clearances must be at most a quarter of the smaller part's diameter, " +
                     short_number(0.25 * length) + ", got " +
                     short_number(options.clearances.back()));
  return widest;
}

// A fixed part much larger than the moving one needs a box that a grid as fine would make slow.
double coarsening(const Part& fixed, const Part& moving, double widest,
                  const MateOptions& options) {
  const double reach = diameter_of(moving.mesh.vertices) + 2.0 * (options.skin + widest);
  const double box = (fixed.solid->bounds().sizes().array() + reach).prod();
  return std::max(1.0, std::cbrt(box / options.most_cells) / options.spacing);
}

ContactBody contact_body(const Part& part, const SurfaceSamples& samples, double margin,
                         const MateOptions& options) {
  // As fine as asked, but for a part so much the larger that its grid would not fit.
  constexpr double kMostNodes = 1.2e7;
  const Eigen::AlignedBox3d bounds = part.solid->bounds();
  const double volume = (bounds.sizes().array() + 2.0 * margin).prod();
  const double spacing = std::max(options.distance_spacing, std::cbrt(volume / kMostNodes));
  return {samples, DistanceField(*part.solid, spacing, margin, options.threads), bounds.center()};
}

Parts make_parts(Part fixed, Part moving, const MateOptions& options) {
  Parts parts{std::move(fixed), std::move(moving), {}, {}, nullptr};
  parts.length =
      std::min(diameter_of(parts.fixed.mesh.vertices), diameter_of(parts.moving.mesh.vertices));
  const LocalFrame fixed_frame{parts.fixed.solid->bounds().center(), parts.length};
  const LocalFrame moving_frame{parts.moving.solid->bounds().center(), parts.length};
  parts.local_fixed = local_part(parts.fixed, fixed_frame);
  parts.local_moving = local_part(parts.moving, moving_frame);
  const double fixed_area = surface_area(parts.local_fixed.mesh);
  const double moving_area = surface_area(parts.local_moving.mesh);
  // One density of samples for both surfaces, within reason.
  const auto samples = [&](const Part& part, double area) {
    const double ratio = std::min(20.0, area / std::min(fixed_area, moving_area));
    return sample_surface(part.mesh, static_cast<Eigen::Index>(ratio * options.samples));
  };
  const double widest = widest_clearance(parts.length, options);
  parts.coarser = coarsening(parts.local_fixed, parts.local_moving, widest, options);
  parts.step = parts.coarser * options.spacing;
  parts.offset = parts.coarser * options.skin;
  const double margin =
      widest + std::max(parts.offset + 2.0 * parts.step, 16.0 * options.tolerance);
  parts.pair = std::make_shared<const PartPair>(PartPair{
      fixed_frame, moving_frame,
      ContactPair(
          contact_body(parts.local_fixed, samples(parts.local_fixed, fixed_area), margin, options),
          contact_body(parts.local_moving, samples(parts.local_moving, moving_area), margin,
                       options))});
  return parts;
}

// Makes both parts' knots, by the form asked for, and the channel of their double skins.
// Bodies that are balls already are taken as they are.
Channel skin_channel(const Parts& parts, const Body& fixed_body, const Body& moving_body,
                     const MateOptions& options, SearchPlan& plan) {
  const SampledSkinOptions skin{.spacing = parts.step,
                                .offset = parts.offset,
                                .penalty = options.penalty,
                                .feature = options.feature,
                                .feature_radius = 2.0 * parts.offset};
  const PartPair& pair = *parts.pair;
  const double spacing = parts.step * parts.length;
  // In units of the grid step the scores fit single precision, whatever the parts' unit.
  const double weight = std::pow(spacing, -3);
  if (options.knots == PartKnots::kNodes) {
    plan.fixed.knots = skin_knots("fixed", pair.fixed_frame, pair.pair.fixed().field, skin);
    plan.moving.knots = skin_knots("moving", pair.moving_frame, pair.pair.moving().field, skin);
    return sampled_channel("skin", weight, plan.fixed.knots, plan.moving.knots, spacing);
  }
  const PartBallsOptions balls{.step = options.ball_step,
                               .mu = options.ball_mu,
                               .expansion = options.ball_expansion,
                               .largest = options.ball_largest,
                               .threads = options.threads};
  const auto balls_of = [&](const char* name, const Body& body, const LocalFrame& frame,
                            const Part& local) {
    return body.balls() != nullptr ? *body.balls() : part_balls(name, frame, *local.solid, balls);
  };
  const Knots fixed = balls_of("fixed", fixed_body, pair.fixed_frame, parts.local_fixed);
  const Knots moving = balls_of("moving", moving_body, pair.moving_frame, parts.local_moving);
  plan.fixed.knots = fixed;
  plan.moving.knots = moving;
  // The option is the ratio of core and skin, which all balls have; the channel asks for lambda at
  // one radius: at r0, where a ball with its skin has eight times the volume.
  const double offset = parts.offset * parts.length;
  Channel channel = double_skin_channel(
      fixed, moving,
      {.offset = offset, .penalty = 8.0 * options.ball_penalty, .penalty_radius = offset});
  channel.name = "skin";
  channel.weight = weight;
  return channel;
}

// Ranks a rotation set's members and, unless an axis is given, those that lay faces together.
RotationSet mate_rotations(const Parts& parts, const MateOptions& options,
                           const Eigen::Quaterniond& search_from_fixed) {
  if (options.axis) return axial_rotations(*options.axis, options.rotations, search_from_fixed);
  RotationSet set = rotation_set(options.rotations, RotationMethod::kAuto, options.threads);
  const Eigen::Matrix4Xd aligned =
      aligned_rotations(find_directions(parts.local_fixed.mesh),
                        find_directions(parts.local_moving.mesh), options.turns, options.aligned);
  const Eigen::Index regular = set.size();
  set.quaternions.conservativeResize(4, regular + aligned.cols());
  for (Eigen::Index i = 0; i < aligned.cols(); ++i) {
    const Eigen::Quaterniond q =
        canonical(search_from_fixed *
                  Eigen::Quaterniond(aligned(0, i), aligned(1, i), aligned(2, i), aligned(3, i)));
    set.quaternions.col(regular + i) << q.w(), q.x(), q.y(), q.z();
  }
  return set;
}

// Coarse to fine, few points to many, many placements to few. Of a placement that is not polished
// yet the grid's step alone makes it penetrate, so that costs less.
std::vector<Stage> mate_stages(const std::shared_ptr<const PartPair>& pair, double length,
                               const MateOptions& options) {
  const auto scorer = [&](double widths, double fraction, double penetration) {
    return std::make_shared<const PartScorer>(
        pair, PartScoreOptions{widths * options.tolerance, fraction, options.one_sided_weight,
                               penetration});
  };
  const double rough = std::min(1.0, options.penetration_weight);
  const auto near = scorer(2.0, 0.25, rough);
  const auto last = scorer(1.0, 1.0, options.penetration_weight);
  const auto keep = static_cast<std::size_t>(options.polished);
  const double radius = options.cluster_radius * length;
  return {{.name = "rough",
           .scorer = scorer(4.0, 0.15, rough),
           .replaces = true,
           .keep = 20 * keep,
           .cluster_radius = radius},
          {.name = "approach",
           .move = approach_contact(pair, near, options.tolerance),
           .scorer = near,
           .replaces = true,
           .keep = keep,
           .cluster_radius = radius},
          {.name = "polish",
           .move = polish_contact(pair, last, options.tolerance),
           .scorer = last,
           .replaces = true,
           .keep = static_cast<std::size_t>(options.poses),
           .cluster_radius = radius}};
}

// Each clearance has its stages; what they leave is put together, one pose of each cluster.
void add_clearance_stages(const Parts& parts, const MateOptions& options, SearchPlan& plan) {
  for (const double clearance : options.clearances) {
    const PartPair& pair = *parts.pair;
    const auto apart = std::make_shared<const PartPair>(PartPair{
        pair.fixed_frame, pair.moving_frame, pair.pair.with_clearance(clearance / parts.length)});
    plan.offset_stages.push_back(mate_stages(apart, parts.length, options));
  }
  plan.search.offsets = options.clearances;
  plan.offset_name = kClearance;
  plan.stages = {{.name = "clearances",
                  .keep = static_cast<std::size_t>(options.poses),
                  .cluster_radius = options.cluster_radius * parts.length}};
}

// The clearance at which the search found each pose, and the contact of the best, exactly.
std::vector<MetricColumn> described(const Part& fixed, const Part& moving, double length,
                                    const MateOptions& options, const PoseList& list,
                                    const std::vector<FoundPose>& found) {
  const auto clearance = [&](std::size_t i) {
    return options.clearances.at(static_cast<std::size_t>(found[i].offset_index));
  };
  constexpr const char* kNames[] = {
      "contact_area", "penetration_volume", "penetration_depth", "pull_blocked", "pull_x", "pull_y",
      "pull_z"};
  std::vector<MetricColumn> columns;
  for (const char* name : kNames)
    columns.push_back({name, std::vector<double>(list.poses.size(), std::nan(""))});
  const bool apart = !options.clearances.empty();
  const std::size_t count = std::min(list.poses.size(), static_cast<std::size_t>(options.check));
  for (std::size_t i = 0; i < count; ++i) {
    const ContactReport report = measure_contact(
        fixed.mesh, *fixed.solid, moving.mesh, *moving.solid, list.poses[i].moving_in_fixed,
        {.tolerance = options.tolerance + (apart ? clearance(i) / length : 0.0),
         .threads = options.threads});
    const double values[] = {report.contact_area,      report.penetration_volume,
                             report.penetration_depth, report.pull_blocked,
                             report.pull_direction[0], report.pull_direction[1],
                             report.pull_direction[2]};
    for (std::size_t m = 0; m < std::size(kNames); ++m) columns[m].values[i] = values[m];
  }
  if (!apart) return columns;
  MetricColumn column{kClearance, {}};
  for (std::size_t i = 0; i < list.poses.size(); ++i) column.values.push_back(clearance(i));
  columns.insert(columns.begin(), std::move(column));
  return columns;
}

// What is said where the grid has to be coarser than asked for.
std::vector<std::string> step_decisions(double coarser, const MateOptions& options) {
  if (coarser < 1.0 + 1e-6) return {};
  char text[200];
  std::snprintf(text, sizeof text,
                "grid step and skin %.3g times those asked for (%.3g, %.3g of the smaller part's "
                "diameter): finer ones need more than --most-cells %g",
                coarser, options.spacing * coarser, options.skin * coarser, options.most_cells);
  return {text};
}

// Units that both files give must agree; where one gives none, a line says what it is taken to be.
std::vector<std::string> unit_decisions(const BodyRecord& fixed, const BodyRecord& moving) {
  const std::string &a = fixed.unit, &b = moving.unit;
  if (!a.empty() && !b.empty() && a != b)
    throw InputError("mate: expected both bodies in one unit, found " + fixed.spec + " in " + a +
                     " and " + moving.spec + " in " + b);
  if (a.empty() == b.empty()) return {};
  return {(a.empty() ? fixed.spec : moving.spec) +
          ": the file knows no unit: its lengths are taken" + " as " + (a.empty() ? b : a) +
          ", the other body's"};
}

}  // namespace

SearchPlan plan_mate(const Body& fixed, const Body& moving, const MateOptions& options) {
  check_options("mate", mate_option_rows(), options);
  if (options.axis && !(options.axis->fixed.norm() > 0.0 && options.axis->moving.norm() > 0.0 &&
                        options.axis->fixed.allFinite() && options.axis->moving.allFinite()))
    throw InputError("mate: an axis must be finite and not 0");
  check_clearances(options);
  if (options.skeletal > 0.0 && options.knots != PartKnots::kNodes)
    throw InputError("mate: the skeletal channel needs knots that are nodes");
  SearchPlan plan;
  plan.kind = "mate";
  plan.options = to_json(options);
  plan.threads = options.threads;
  plan.decisions = unit_decisions(fixed.record, moving.record);
  const Part moving_part = body_part(moving);
  MateOptions started = options;
  Parts parts;
  if (options.random_start) {
    plan.start = random_start(*options.random_start, 0.5 * diameter_of(moving_part.mesh.vertices));
    if (started.axis) started.axis->moving = plan.start.rotation * started.axis->moving;
    parts = make_parts(body_part(fixed), body_part(moved_body(moving, plan.start)), options);
  } else {
    parts = make_parts(body_part(fixed), moving_part, options);
  }
  const PartPair& pair = *parts.pair;
  plan.fixed = fixed.record;
  plan.moving = moving.record;
  plan.search.spacing = parts.step * parts.length;
  plan.search.cutoff = 0.75 / plan.search.spacing;
  plan.search.per_rotation = options.per_rotation;
  plan.search.separation = options.separation * parts.length;
  plan.search.summits = true;  // sliding fits have long slopes, which would take all places
  const double weight = std::pow(plan.search.spacing, -3);  // as of the skin
  plan.channels = {skin_channel(
      parts, fixed, options.random_start ? moved_body(moving, plan.start) : moving, options, plan)};
  if (options.skeletal > 0.0)
    plan.channels.push_back(sampled_channel(
        "skeletal", weight * options.skeletal,
        skeletal_knots(parts.fixed, plan.fixed.knots, options),
        skeletal_knots(parts.moving, plan.moving.knots, options), plan.search.spacing));
  const Eigen::Quaterniond search_from_fixed = search_frame(plan.channels).rotation;
  plan.rotations = mate_rotations(parts, started, search_from_fixed);
  plan.search_column = "skin";
  if (options.clearances.empty())
    plan.stages = mate_stages(parts.pair, parts.length, options);
  else
    add_clearance_stages(parts, options, plan);
  plan.points = pair.moving_frame.to_input(pair.pair.moving().points.cast<double>());
  for (std::string& decision : step_decisions(parts.coarser, options))
    plan.decisions.push_back(std::move(decision));
  plan.describe = [fixed_part = parts.fixed, moving_part, length = parts.length, options](
                      const PoseList& list, const std::vector<FoundPose>& found) {
    return described(fixed_part, moving_part, length, options, list, found);
  };
  return plan;
}

Run mate(const Body& fixed, const Body& moving, const MateOptions& options, const RunWatch& watch) {
  return run_plan(plan_mate(fixed, moving, options), make_provenance(""), watch);
}

}  // namespace mortise
