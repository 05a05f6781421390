// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Clusters of a run's poses as a report lists them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "mortise/report/bodies.hpp"
#include "mortise/store/run_file.hpp"

namespace mortise {

/// Over which points two poses are compared.
enum class ClusterMeasure {
  kLigand,    ///< the moving body's, in the fixed body's frame (cluster_poses)
  kInterface  ///< both bodies' at the interface, superposed (cluster_poses_by_interface)
};

/// "ligand" or "interface". @throws InputError for any other name
[[nodiscard]] ClusterMeasure parse_cluster_measure(const std::string& name);

struct ReportClusterOptions {
  ClusterMeasure measure = ClusterMeasure::kLigand;
  /// RMSD below which two poses are one cluster, length unit; 0 = the run's own clusters. Absent:
  /// by ligand the run's own if one holds several poses, else a tenth of the moving body's
  /// diameter; by interface 3 A for molecules, a twentieth of that diameter for parts.
  std::optional<double> radius = {};
  int min_size = 1;  ///< clusters of fewer poses are dissolved; >= 1
};

/// The clusters, numbered by the rank of their representative, and by what rule they were made.
struct ReportClusters {
  std::string measure;                       ///< "ligand", "interface", "run": as the run has them
  double radius = 0.0;                       ///< length unit; 0 for the run's own
  double interface_cutoff = 0.0;             ///< points this close to the partner; 0: not used
  int min_size = 1;                          ///< as asked for
  std::vector<std::size_t> representatives;  ///< index of each cluster's best-ranked pose
  std::vector<std::size_t> sizes;            ///< poses in each cluster
};

/// Clusters a run's poses: sets each pose's cluster (-1 = none) and a metric column "cluster_size",
/// the first one, NaN for poses of no cluster.
///
/// By interface the points are a molecule's backbone atoms N, CA, C, O (all heavy atoms, if a body
/// has none) within 10 A of the partner, or 1,000 even points of a part's surface within a tenth of
/// the moving one's diameter.
/// @throws InputError if an option is out of range, or interface clusters are asked for with radius
/// 0 or without the bodies
[[nodiscard]] ReportClusters cluster_run(Run& run, const ReportBodies& bodies,
                                         const ReportClusterOptions& options = {});

/// One row per cluster: cluster (from 0, as in the table of poses), rank of its representative,
/// size, and the representative's score, channels and metrics.
[[nodiscard]] std::string clusters_csv(const Run& run, const ReportClusters& clusters);

/// The same as JSON, with the rule: measure, radius, interface_cutoff, min_size.
[[nodiscard]] std::string clusters_json(const Run& run, const ReportClusters& clusters);

}  // namespace mortise
