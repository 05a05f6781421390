// SPDX-License-Identifier: GPL-3.0-or-later
// Sides of triangles told by a wrap, the result checked by its winding number.
#include "parts/enclose.hpp"

#include <algorithm>
#include <cmath>

#include "mortise/parts/mesh_solid.hpp"
#include "mortise/parts/sample_surface.hpp"
#include "parts/wrap.hpp"

namespace mortise::parts {
namespace {

constexpr double kWide = 1.0 / 30.0;     ///< radius of the first ball, part of the diagonal
constexpr double kNarrow = 1.0 / 80.0;   ///< of the second, where the first leaves doubts
constexpr double kMostFacets = 2e4;      ///< of a wrap, about: balls are larger if need be
constexpr double kOffset = 1.0 / 600.0;  ///< of the wrap, part of the diagonal
constexpr double kNear =
    1e-3;  ///< how far off the surface the winding number is asked, part of the diagonal
constexpr double kLook = 2.5;    ///< how far from a triangle a side is looked at, offsets
constexpr double kAgreed = 0.8;  ///< share of a patch's area that decides for all of it
constexpr double kCrack = 0.1;   ///< how far off a whole number cracks may carry the winding number
constexpr double kSure = 0.95;   ///< share of the surface whose sides must be told by the winding
                                 ///< number
constexpr int kSamples = 4000;

/// What lies on the two sides of a triangle.
enum Place : std::uint8_t { kOutward, kInward, kSheet, kWall };

TriangleMesh mesh_of(const Surface& surface) {
  TriangleMesh mesh;
  mesh.vertices.resize(3, static_cast<Eigen::Index>(surface.points.size()));
  for (std::size_t i = 0; i < surface.points.size(); ++i)
    mesh.vertices.col(static_cast<Eigen::Index>(i)) = surface.points[i];
  mesh.triangles.resize(3, static_cast<Eigen::Index>(surface.triangles.size()));
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const auto& t = surface.triangles[i];
    mesh.triangles.col(static_cast<Eigen::Index>(i)) << t[0], t[1], t[2];
  }
  return mesh;
}

std::vector<Place> places_of(const Surface& surface, const MeshSolid& wrapped, double look) {
  const auto count = static_cast<Eigen::Index>(surface.triangles.size());
  Eigen::Matrix3Xd points(3, 2 * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& t = surface.triangles[static_cast<std::size_t>(i)];
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const int v : t) middle += surface.points[static_cast<std::size_t>(v)] / 3.0;
    const Eigen::Vector3d step = look * area_vector(surface, t).stableNormalized();
    points.col(2 * i) = middle + step;
    points.col(2 * i + 1) = middle - step;
  }
  const Eigen::VectorXd winding = wrapped.winding_number(points);
  std::vector<Place> places(surface.triangles.size());
  for (Eigen::Index i = 0; i < count; ++i) {
    const bool front = winding[2 * i] > 0.5;
    const bool back = winding[2 * i + 1] > 0.5;
    places[static_cast<std::size_t>(i)] =
        front ? (back ? kWall : kInward) : (back ? kOutward : kSheet);
  }
  return places;
}

/// Triangles joined by edges of two; a patch is open if it has an edge of any other kind.
struct Patches {
  std::vector<int> number;  ///< of each triangle
  std::vector<char> open;   ///< of each patch
};

Patches patches_of(const Surface& surface, const std::vector<Side>& sides) {
  DisjointSets sets(surface.triangles.size());
  for_each_edge(sides, [&](std::size_t first, std::size_t last) {
    if (last - first == 2) sets.join(sides[first].triangle, sides[first + 1].triangle);
  });
  int count = 0;
  Patches patches;
  patches.number = sets.numbers(&count);
  patches.open.assign(static_cast<std::size_t>(count), 0);
  for_each_edge(sides, [&](std::size_t first, std::size_t last) {
    const bool agree = last - first == 2 && runs_forward(surface.triangles, sides[first]) !=
                                                runs_forward(surface.triangles, sides[first + 1]);
    for (std::size_t i = first; !agree && i < last; ++i)
      patches.open[static_cast<std::size_t>(
          patches.number[static_cast<std::size_t>(sides[i].triangle)])] = 1;
  });
  return patches;
}

/// One vote a patch where most of its area agrees.
void agree_in_patches(const Surface& surface, const Patches& patches, std::vector<Place>& places) {
  std::vector<std::array<double, 4>> area(patches.open.size(), {0.0, 0.0, 0.0, 0.0});
  for (std::size_t i = 0; i < places.size(); ++i)
    area[static_cast<std::size_t>(patches.number[i])][places[i]] +=
        area_vector(surface, surface.triangles[i]).norm();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto& votes = area[static_cast<std::size_t>(patches.number[i])];
    const auto most = std::max_element(votes.begin(), votes.end());
    if (*most > kAgreed * (votes[0] + votes[1] + votes[2] + votes[3]))
      places[i] = static_cast<Place>(most - votes.begin());
  }
}

/// The smallest ball whose wrap, which covers both sides of a sheet, has no more than kMostFacets.
double least_radius(const Surface& surface) {
  double area = 0.0;
  for (const auto& t : surface.triangles) area += 0.5 * area_vector(surface, t).norm();
  return std::sqrt(4.0 * area / kMostFacets);
}

double volume_of(const Surface& surface) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : surface.points)
    centre += p / static_cast<double>(surface.points.size());
  double volume = 0.0;
  for (const auto& t : surface.triangles)
    volume +=
        area_vector(surface, t).dot(surface.points[static_cast<std::size_t>(t[0])] - centre) / 6.0;
  return volume;
}

/// Share of the surface at whose sides the winding number is near a whole one, and not the same.
double sure_share(const Surface& surface, double look) {
  const TriangleMesh mesh = mesh_of(surface);
  const SurfaceSamples sample = sample_surface(mesh, kSamples);
  const Eigen::Index count = sample.points.cols();
  Eigen::Matrix3Xd points(3, 2 * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    points.col(2 * i) = sample.points.col(i) + look * sample.normals.col(i);
    points.col(2 * i + 1) = sample.points.col(i) - look * sample.normals.col(i);
  }
  const Eigen::VectorXd winding = MeshSolid(mesh).winding_number(points);
  const auto whole = [](double w) { return std::abs(w - std::round(w)) < kCrack; };
  Eigen::Index sure = 0;
  for (Eigen::Index i = 0; i < count; ++i)
    sure += whole(winding[2 * i]) && whole(winding[2 * i + 1]) && winding[2 * i + 1] > 0.5;
  return static_cast<double>(sure) / static_cast<double>(std::max<Eigen::Index>(count, 1));
}

}  // namespace

Enclosed enclose(Surface& surface) {
  const Surface whole = surface;
  const Patches patches = patches_of(whole, sorted_sides(whole.triangles));
  const double offset = kOffset * whole.diagonal;
  const double look = kLook * offset;
  const double near = kNear * whole.diagonal;
  const auto says_all = [&](double volume) {
    return volume > 0.0 && sure_share(surface, near) >= kSure;
  };
  const double volume = volume_of(surface);
  if (says_all(volume)) return {.volume = volume};
  const double least = least_radius(whole);
  const double wide = std::max(kWide * whole.diagonal, least);
  const double narrow = std::max(kNarrow * whole.diagonal, least);
  for (const double radius : {wide, narrow}) {
    const bool last = radius == narrow;
    Enclosed result;
    result.gap = 2.0 * radius;
    const MeshSolid wrapped(wrap(whole, radius, offset));
    std::vector<Place> places = places_of(whole, wrapped, look);
    agree_in_patches(whole, patches, places);
    surface.triangles.clear();
    for (std::size_t i = 0; i < places.size(); ++i) {
      auto t = whole.triangles[i];
      if (patches.open[static_cast<std::size_t>(patches.number[i])] != 0) {
        result.turned += places[i] == kInward;
        result.sheets += places[i] == kSheet;
        result.walls += places[i] == kWall;
        if (places[i] == kSheet || places[i] == kWall) continue;
        if (places[i] == kInward) std::swap(t[1], t[2]);
      }
      surface.triangles.push_back(t);
    }
    if (surface.triangles.empty()) return result;
    result.volume = volume_of(surface);
    const bool sure = says_all(result.volume);
    // What looks like a wall may stand in a hole that only a smaller ball enters.
    if (sure && (last || result.walls == 0)) return result;
    if (!last) continue;
    result.wrapped = true;
    result.deviation = offset;
    const TriangleMesh& mesh = wrapped.mesh();
    surface.points.assign(static_cast<std::size_t>(mesh.vertices.cols()), {});
    for (Eigen::Index i = 0; i < mesh.vertices.cols(); ++i)
      surface.points[static_cast<std::size_t>(i)] = mesh.vertices.col(i);
    surface.triangles.clear();
    for (const auto t : mesh.triangles.colwise()) surface.triangles.push_back({t(0), t(1), t(2)});
    result.volume = volume_of(surface);
    return result;
  }
  return {};
}

}  // namespace mortise::parts
