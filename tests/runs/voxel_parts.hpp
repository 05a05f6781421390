// SPDX-License-Identifier: GPL-3.0-or-later
// Parts made of unit cubes, with their exact distance: mates that a person can draw.
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "mortise/core/rigid_motion.hpp"
#include "mortise/parts/part.hpp"

namespace mortise::testing_parts {

/// Cubes of unit side at whole coordinates [0, n), moved by a rigid motion.
class VoxelSolid : public Solid {
 public:
  using Filled = std::function<bool(int, int, int)>;
  VoxelSolid(int n, const Filled& filled, const RigidMotion& motion) : n_(n), motion_(motion) {
    const auto at = [&](const std::array<int, 3>& c) {
      for (const int x : c)
        if (x < 0 || x >= n) return false;
      return filled(c[0], c[1], c[2]);
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < n; ++k) {
          cells_.push_back(at({i, j, k}));
          for (int d = 0; d < 3; ++d)
            for (const int side : {0, 1}) {
              std::array<int, 3> next{i, j, k};
              next[d] += 2 * side - 1;
              if (at({i, j, k}) && !at(next))
                faces_.push_back({d,
                                  side,
                                  {i + (d == 0 ? side : 0) * 1.0, j + (d == 1 ? side : 0) * 1.0,
                                   k + (d == 2 ? side : 0) * 1.0}});
            }
        }
  }

  [[nodiscard]] TriangleMesh mesh() const {
    TriangleMesh mesh;
    const auto count = static_cast<Eigen::Index>(faces_.size());
    mesh.vertices.resize(3, 4 * count);
    mesh.triangles.resize(3, 2 * count);
    for (Eigen::Index f = 0; f < count; ++f) {
      const Face& face = faces_[f];
      const Eigen::Vector3d a = Eigen::Vector3d::Unit((face.axis + 1) % 3);
      const Eigen::Vector3d b = Eigen::Vector3d::Unit((face.axis + 2) % 3);
      mesh.vertices.middleCols<4>(4 * f) << face.low, face.low + a, face.low + a + b, face.low + b;
      const int v = static_cast<int>(4 * f);
      if (face.side == 1)
        mesh.triangles.middleCols<2>(2 * f) << v, v, v + 1, v + 2, v + 2, v + 3;
      else
        mesh.triangles.middleCols<2>(2 * f) << v, v, v + 2, v + 3, v + 1, v + 2;
    }
    mesh.vertices = motion_ * mesh.vertices;
    return mesh;
  }

  [[nodiscard]] Eigen::AlignedBox3d bounds() const override {
    Eigen::AlignedBox3d box;
    const TriangleMesh m = mesh();
    for (Eigen::Index i = 0; i < m.vertices.cols(); ++i)
      box.extend(Eigen::Vector3d(m.vertices.col(i)));
    return box;
  }

  [[nodiscard]] Eigen::VectorXd signed_distance(const Eigen::Matrix3Xd& points,
                                                double) const override {
    Eigen::VectorXd result(points.cols());
    const RigidMotion back = inverse(motion_);
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      const Eigen::Vector3d x = back * Eigen::Vector3d(points.col(i));
      double best = std::numeric_limits<double>::infinity();
      for (const Face& face : faces_) {
        Eigen::Vector3d high = face.low + Eigen::Vector3d::Ones();
        high[face.axis] = face.low[face.axis];
        best = std::min(best, (x - x.cwiseMax(face.low).cwiseMin(high)).squaredNorm());
      }
      const Eigen::Vector3i c = x.array().floor().cast<int>();
      const bool inside = (c.array() >= 0).all() && (c.array() < n_).all() &&
                          cells_[(c[0] * n_ + c[1]) * n_ + c[2]];
      result[i] = (inside ? -1.0 : 1.0) * std::sqrt(best);
    }
    return result;
  }

 private:
  struct Face {
    int axis, side;
    Eigen::Vector3d low;
  };
  int n_;
  RigidMotion motion_;
  std::vector<bool> cells_;
  std::vector<Face> faces_;
};

inline Part voxel_part(int n, const VoxelSolid::Filled& filled, const RigidMotion& motion = {}) {
  auto solid = std::make_shared<VoxelSolid>(n, filled, motion);
  return {solid->mesh(), solid};
}

/// A block with a square, blind hole off its centre.
inline Part mortise_block(const RigidMotion& motion = {}) {
  return voxel_part(
      6,
      [](int i, int j, int k) { return k < 4 && !(i >= 1 && i < 3 && j >= 2 && j < 5 && k >= 1); },
      motion);
}

/// A plate with a tenon that fits the hole: in place at the identity.
inline Part tenon_plate(const RigidMotion& motion = {}) {
  return voxel_part(
      6,
      [](int i, int j, int k) {
        return k == 4 || (k >= 1 && k < 4 && i >= 1 && i < 3 && j >= 2 && j < 5);
      },
      motion);
}

}  // namespace mortise::testing_parts
