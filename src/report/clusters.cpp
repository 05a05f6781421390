// SPDX-License-Identifier: GPL-3.0-or-later
// A run's poses clustered anew or as the run has them, and the clusters as tables.
#include "mortise/report/clusters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "mortise/core/errors.hpp"
#include "mortise/molecules/radii.hpp"
#include "mortise/parts/sample_surface.hpp"
#include "mortise/poses/cluster.hpp"
#include "mortise/store/csv.hpp"
#include "report/heavy_atoms.hpp"

namespace mortise {
namespace {

constexpr double kInterfaceCutoff = 10.0;  // angstrom: CAPRI's interface
constexpr Eigen::Index kSurfacePoints = 1000;

double diameter(const Eigen::Matrix3Xd& points) {
  const Eigen::Vector3d center = points.rowwise().mean();
  return 2.0 * (points.colwise() - center).colwise().norm().maxCoeff();
}

bool has_clusters(const PoseList& list) {
  std::vector<char> seen(list.poses.size(), 0);
  for (const Pose& pose : list.poses) {
    const auto cluster = static_cast<std::size_t>(pose.cluster);
    if (pose.cluster < 0 || cluster >= seen.size()) continue;
    if (seen[cluster] != 0) return true;
    seen[cluster] = 1;
  }
  return false;
}

Eigen::Matrix3Xd backbone(const Molecule& molecule) {
  Molecule chosen;
  for (const Atom& atom : molecule.atoms)
    if (!atom.hetero &&
        (atom.name == "N" || atom.name == "CA" || atom.name == "C" || atom.name == "O"))
      chosen.atoms.push_back(atom);
  return atom_positions(chosen);
}

struct InterfacePoints {
  Eigen::Matrix3Xd fixed, moving;
};

InterfacePoints interface_points(const ReportBodies& bodies) {
  if (bodies.fixed.is_mesh())
    return {sample_surface(bodies.fixed.mesh, kSurfacePoints).points,
            sample_surface(bodies.moving.mesh, kSurfacePoints).points};
  InterfacePoints points = {backbone(bodies.fixed.molecule), backbone(bodies.moving.molecule)};
  if (points.fixed.cols() == 0 || points.moving.cols() == 0)
    points = {report_points(bodies.fixed), report_points(bodies.moving)};
  return points;
}

std::vector<RigidMotion> motions_of(const PoseList& list) {
  std::vector<RigidMotion> motions;
  motions.reserve(list.poses.size());
  for (const Pose& pose : list.poses) motions.push_back(pose.moving_in_fixed);
  return motions;
}

void take(Run& run, const Clusters& clusters) {
  for (std::size_t i = 0; i < run.poses.poses.size(); ++i)
    run.poses.poses[i].cluster = clusters.cluster_of[i];
}

// The run's clusters, those of fewer poses dissolved and the others numbered by their first pose.
void keep_own(Run& run, int min_size) {
  std::vector<Pose>& poses = run.poses.poses;
  const auto slot = [&](const Pose& pose) { return static_cast<std::size_t>(pose.cluster); };
  std::vector<int> sizes(poses.size(), 0);
  for (const Pose& pose : poses)
    if (pose.cluster >= 0 && slot(pose) < sizes.size()) ++sizes[slot(pose)];
  std::vector<int> number(poses.size(), -1);
  int next = 0;
  for (Pose& pose : poses) {
    if (pose.cluster < 0 || slot(pose) >= sizes.size() || sizes[slot(pose)] < min_size) {
      pose.cluster = -1;
      continue;
    }
    int& mine = number[slot(pose)];
    if (mine < 0) mine = next++;
    pose.cluster = mine;
  }
}

void count(Run& run, ReportClusters& clusters) {
  const std::vector<Pose>& poses = run.poses.poses;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (poses[i].cluster < 0) continue;
    const auto cluster = static_cast<std::size_t>(poses[i].cluster);
    if (cluster == clusters.sizes.size()) {
      clusters.sizes.push_back(0);
      clusters.representatives.push_back(i);
    }
    ++clusters.sizes[cluster];
  }
  std::erase_if(run.metrics, [](const MetricColumn& m) { return m.name == "cluster_size"; });
  MetricColumn column = {"cluster_size", {}};
  for (const Pose& pose : poses)
    column.values.push_back(
        pose.cluster < 0
            ? std::numeric_limits<double>::quiet_NaN()
            : static_cast<double>(clusters.sizes[static_cast<std::size_t>(pose.cluster)]));
  run.metrics.insert(run.metrics.begin(), std::move(column));
}

void check(const ReportClusterOptions& options, const ReportBodies& bodies) {
  if (options.radius && !(*options.radius >= 0.0 && std::isfinite(*options.radius)))
    throw InputError("report: the cluster radius must be >= 0, got " +
                     std::to_string(*options.radius));
  if (options.min_size < 1)
    throw InputError("report: the least size of a cluster must be >= 1, got " +
                     std::to_string(options.min_size));
  if (options.radius && *options.radius > 0.0 && report_points(bodies.moving).cols() == 0)
    throw InputError("report: clusters of a radius need the moving body's input file");
  if (options.measure != ClusterMeasure::kInterface) return;
  if (options.radius && *options.radius == 0.0)
    throw InputError(
        "report: a cluster radius of 0 keeps the run's own clusters, which are not by interface; "
        "expected one > 0");
  if (bodies.fixed.is_missing() || bodies.moving.is_missing())
    throw InputError("report: clusters by interface need both input files");
}

bool repeats(const MetricColumn& metric) { return metric.name == "cluster_size"; }

}  // namespace

ClusterMeasure parse_cluster_measure(const std::string& name) {
  if (name == "ligand") return ClusterMeasure::kLigand;
  if (name == "interface") return ClusterMeasure::kInterface;
  throw InputError("cluster measure: expected ligand or interface, got \"" + name + "\"");
}

ReportClusters cluster_run(Run& run, const ReportBodies& bodies,
                           const ReportClusterOptions& options) {
  check(options, bodies);
  ReportClusters clusters;
  clusters.min_size = options.min_size;
  clusters.measure = "run";
  if (run.poses.poses.empty()) return clusters;
  const auto min_size = static_cast<std::size_t>(options.min_size);
  const Eigen::Matrix3Xd points = report_points(bodies.moving);
  const bool own = points.cols() == 0 || (options.radius && *options.radius == 0.0) ||
                   (!options.radius && has_clusters(run.poses));
  if (options.measure == ClusterMeasure::kInterface) {
    const InterfacePoints at = interface_points(bodies);
    const bool parts = bodies.fixed.is_mesh();
    const double size = diameter(points);
    clusters.measure = "interface";
    clusters.radius = options.radius.value_or(parts ? 0.05 * size : 3.0);
    clusters.interface_cutoff = parts ? 0.1 * size : kInterfaceCutoff;
    take(run, cluster_poses_by_interface(motions_of(run.poses), at.fixed, at.moving,
                                         {.radius = clusters.radius,
                                          .min_size = min_size,
                                          .interface_cutoff = clusters.interface_cutoff}));
  } else if (own) {
    keep_own(run, options.min_size);
  } else {
    clusters.measure = "ligand";
    clusters.radius = options.radius.value_or(0.1 * diameter(points));
    take(run, cluster_poses(motions_of(run.poses), points,
                            {.radius = clusters.radius, .min_size = min_size}));
  }
  count(run, clusters);
  return clusters;
}

std::string clusters_csv(const Run& run, const ReportClusters& clusters) {
  std::string text = "cluster,representative,size,score";
  for (const std::string& name : run.poses.channel_names) text += "," + csv_field(name);
  for (const MetricColumn& metric : run.metrics)
    if (!repeats(metric)) text += "," + csv_field(metric.name);
  text += "\n";
  for (std::size_t c = 0; c < clusters.sizes.size(); ++c) {
    const std::size_t first = clusters.representatives[c];
    const Pose& pose = run.poses.poses[first];
    text += std::to_string(c) + "," + std::to_string(first + 1) + "," +
            std::to_string(clusters.sizes[c]) + "," + shortest(pose.score);
    for (const double value : pose.channels) text += "," + shortest(value);
    for (const MetricColumn& metric : run.metrics)
      if (!repeats(metric)) text += "," + shortest(metric.values[first]);
    text += "\n";
  }
  return text;
}

std::string clusters_json(const Run& run, const ReportClusters& clusters) {
  using Json = nlohmann::ordered_json;
  Json all = {{"measure", clusters.measure},
              {"radius", clusters.radius > 0.0 ? Json(clusters.radius) : Json(nullptr)},
              {"interface_cutoff",
               clusters.interface_cutoff > 0.0 ? Json(clusters.interface_cutoff) : Json(nullptr)},
              {"min_size", clusters.min_size}};
  Json rows = Json::array();
  for (std::size_t c = 0; c < clusters.sizes.size(); ++c) {
    const std::size_t first = clusters.representatives[c];
    const Pose& pose = run.poses.poses[first];
    Json channels = Json::object();
    for (std::size_t k = 0; k < pose.channels.size(); ++k)
      channels[run.poses.channel_names[k]] = pose.channels[k];
    Json metrics = Json::object();
    for (const MetricColumn& metric : run.metrics)
      if (!repeats(metric))
        metrics[metric.name] =
            std::isfinite(metric.values[first]) ? Json(metric.values[first]) : Json(nullptr);
    rows.push_back({{"cluster", c},
                    {"representative", first + 1},
                    {"size", clusters.sizes[c]},
                    {"score", pose.score},
                    {"channels", channels},
                    {"metrics", metrics}});
  }
  all["clusters"] = std::move(rows);
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace mortise
