// SPDX-License-Identifier: GPL-3.0-or-later
// Sums over paired points from which their RMSD follows at any rigid motion, without the points.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace mortise::detail {

/// With m~ = m - mean m and r~ = r - mean r over N pairs (m_k, r_k):
struct PairedMoments {
  double count = 0.0;                                        // N
  Eigen::Vector3d model_mean = Eigen::Vector3d::Zero();      // mean m
  Eigen::Vector3d reference_mean = Eigen::Vector3d::Zero();  // mean r
  Eigen::Matrix3d cross = Eigen::Matrix3d::Zero();           // sum m~ r~^T
  double model_spread = 0.0;                                 // sum |m~|^2
  double reference_spread = 0.0;                             // sum |r~|^2
};

[[nodiscard]] PairedMoments paired_moments(const Eigen::Matrix3Xd& model,
                                           const Eigen::Matrix3Xd& reference);

// The moments of both sets of pairs together (parallel axis theorem).
[[nodiscard]] PairedMoments merge(const PairedMoments& a, const PairedMoments& b);

// The moments after x -> R x + t of the model's points.
[[nodiscard]] PairedMoments moved(const PairedMoments& moments, const Eigen::Matrix3d& R,
                                  const Eigen::Vector3d& t);

// RMSD of the pairs as they stand.
[[nodiscard]] double rmsd_in_place(const PairedMoments& moments);

// RMSD of the pairs after the best superposition.
[[nodiscard]] double rmsd_superposed(const PairedMoments& moments);

// The rotation of the model that superposes it best, either of the two quaternions.
[[nodiscard]] Eigen::Quaterniond best_rotation(const PairedMoments& moments);

// Horn's symmetric 4 x 4 matrix: its largest eigenvalue is max_R tr(R cross), its eigenvector the
// quaternion (w, x, y, z) of that R.
[[nodiscard]] Eigen::Matrix4d horn_matrix(const Eigen::Matrix3d& cross);

}  // namespace mortise::detail
