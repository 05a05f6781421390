// SPDX-License-Identifier: GPL-3.0-or-later
// Questions to a mesh's triangle tree, in chunks of points.
#include "mortise/parts/mesh_solid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"
#include "parts/build_triangle_tree.hpp"
#include "parts/closed.hpp"
#include "parts/tree_isa.hpp"

namespace mortise {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr Index kChunk = 256;

void check_mesh(const TriangleMesh& mesh) {
  if (mesh.size() == 0) throw InputError("MeshSolid: a mesh of at least one triangle expected");
  for (Index t = 0; t < mesh.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.triangles(k, t);
      if (v < 0 || v >= mesh.vertices.cols())
        throw InputError("MeshSolid: triangle " + std::to_string(t) + " names vertex " +
                         std::to_string(v) + " of " + std::to_string(mesh.vertices.cols()));
      if (!mesh.vertices.col(v).allFinite())
        throw InputError("MeshSolid: vertex " + std::to_string(v) + " is not finite");
    }
}

void check_points(const char* where, const Eigen::Matrix3Xd& points) {
  if (points.allFinite()) return;
  for (Index i = 0; i < points.cols(); ++i)
    if (!points.col(i).allFinite())
      throw InputError(std::string("MeshSolid::") + where + ": point " + std::to_string(i) +
                       " is not finite");
}

void for_chunks(Index count, int threads, const std::function<void(Index, Index)>& body) {
  const auto chunks = static_cast<std::size_t>((count + kChunk - 1) / kChunk);
  parallel_for(chunks, threads, [&](std::size_t chunk, int) {
    const Index begin = static_cast<Index>(chunk) * kChunk;
    body(begin, std::min(kChunk, count - begin));
  });
}

Vector3d nearest_on_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d edge = b - a;
  const double length_sq = edge.squaredNorm();
  if (!(length_sq > 0.0)) return a;
  return a + std::clamp((p - a).dot(edge) / length_sq, 0.0, 1.0) * edge;
}

Vector3d nearest_on_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b,
                             const Vector3d& c) {
  const Vector3d n = (b - a).cross(c - a);
  const double s = (p - a).cross(c - a).dot(n), t = (b - a).cross(p - a).dot(n);
  const double whole = n.squaredNorm();
  if (whole > 0.0 && s >= 0.0 && t >= 0.0 && s + t <= whole) return p - (p - a).dot(n) / whole * n;
  Vector3d best = nearest_on_segment(p, a, b);
  for (const Vector3d& other : {nearest_on_segment(p, b, c), nearest_on_segment(p, c, a)})
    if ((other - p).squaredNorm() < (best - p).squaredNorm()) best = other;
  return best;
}

}  // namespace

struct MeshSolid::State {
  TriangleMesh mesh;
  MeshSolidOptions options;
  TriangleTree tree;
  Eigen::AlignedBox3d bounds;
  bool closed = false;

  // A chunk's distances, negative inside.
  void signed_distances(const double* points, Index count, double band, double* distances) const {
    std::vector<int> triangles(static_cast<std::size_t>(count));
    const TreeTable& table = tree_table();
    table.nearest(tree.view(), points, count, band * band, distances, triangles.data());
    for (Index i = 0; i < count; ++i) distances[i] = std::sqrt(distances[i]);
    if (!closed) {
      std::vector<double> winding(static_cast<std::size_t>(count));
      table.winding(tree.view(), points, count, options.winding_reach, winding.data());
      for (Index i = 0; i < count; ++i)
        if (winding[i] > 0.5) distances[i] = -distances[i];
      return;
    }
    // Off a closed surface the winding number changes nowhere: two points have the same if the
    // balls about them that the surface does not enter overlap.
    bool inside = false;
    for (Index i = 0; i < count; ++i) {
      const Eigen::Map<const Vector3d> p(points + 3 * i);
      const bool known =
          i > 0 && std::abs(distances[i - 1]) + distances[i] >
                       (1.0 + 1e-9) * (p - Eigen::Map<const Vector3d>(points + 3 * (i - 1))).norm();
      if (!known) {
        double winding = 0.0;
        table.winding(tree.view(), p.data(), 1, options.winding_reach, &winding);
        inside = winding > 0.5;
      }
      if (inside) distances[i] = -distances[i];
    }
  }
};

MeshSolid::MeshSolid(TriangleMesh mesh, const MeshSolidOptions& options) {
  check_mesh(mesh);
  if (!(options.winding_reach >= 1.0))
    throw InputError("MeshSolid: winding_reach must be >= 1, got " +
                     std::to_string(options.winding_reach));
  (void)resolve_threads(options.threads);
  auto state = std::make_shared<State>();
  state->mesh = std::move(mesh);
  state->options = options;
  state->tree = build_triangle_tree(state->mesh);
  for (Index t = 0; t < state->mesh.size(); ++t)
    for (int k = 0; k < 3; ++k)
      state->bounds.extend(state->mesh.vertices.col(state->mesh.triangles(k, t)));
  state->closed = is_closed(state->mesh);
  state_ = std::move(state);
}

Eigen::AlignedBox3d MeshSolid::bounds() const { return state_->bounds; }
bool MeshSolid::closed() const noexcept { return state_->closed; }
const TriangleMesh& MeshSolid::mesh() const noexcept { return state_->mesh; }
const TriangleTree& MeshSolid::tree() const noexcept { return state_->tree; }

Eigen::VectorXd MeshSolid::signed_distance(const Eigen::Matrix3Xd& points, double band) const {
  check_points("signed_distance", points);
  if (!(band > 0.0))
    throw InputError("MeshSolid::signed_distance: band must be > 0, got " + std::to_string(band));
  Eigen::VectorXd distances(points.cols());
  for_chunks(points.cols(), state_->options.threads, [&](Index begin, Index count) {
    state_->signed_distances(points.data() + 3 * begin, count, band, distances.data() + begin);
  });
  return distances;
}

Eigen::VectorXd MeshSolid::winding_number(const Eigen::Matrix3Xd& points) const {
  check_points("winding_number", points);
  Eigen::VectorXd winding(points.cols());
  for_chunks(points.cols(), state_->options.threads, [&](Index begin, Index count) {
    tree_table().winding(state_->tree.view(), points.data() + 3 * begin, count,
                         state_->options.winding_reach, winding.data() + begin);
  });
  return winding;
}

NearestPoints MeshSolid::nearest(const Eigen::Matrix3Xd& points) const {
  check_points("nearest", points);
  NearestPoints result;
  result.points.resize(3, points.cols());
  result.triangles.resize(points.cols());
  result.distances.resize(points.cols());
  for_chunks(points.cols(), state_->options.threads, [&](Index begin, Index count) {
    tree_table().nearest(state_->tree.view(), points.data() + 3 * begin, count,
                         std::numeric_limits<double>::infinity(), result.distances.data() + begin,
                         result.triangles.data() + begin);
    for (Index i = begin; i < begin + count; ++i) {
      result.distances[i] = std::sqrt(result.distances[i]);
      const Eigen::Vector3i corners = state_->mesh.triangles.col(result.triangles[i]);
      result.points.col(i) = nearest_on_triangle(
          points.col(i), state_->mesh.vertices.col(corners[0]),
          state_->mesh.vertices.col(corners[1]), state_->mesh.vertices.col(corners[2]));
    }
  });
  return result;
}

}  // namespace mortise
