// SPDX-License-Identifier: GPL-3.0-or-later
// Spherical decompositions of meshes scaled to a longest side of 1, as [SD, Tables 1 and A.2]. CSV
// on stdout, one row a decomposition.
//
//   decompose_bench [--largest N] [--measure] [--balls DIR] MESH...
//
// --largest N   the finest grid, 16 to 256 (128)
// --measure     the Hausdorff distance of each too, by samples epsilon / 4 apart
// --balls DIR   the skeletal ones' balls as DIR/<mesh>_<grid>_<reduction>.csv: x, y, z, r
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "bench.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/parts/decompose.hpp"
#include "mortise/parts/distance_grid.hpp"
#include "mortise/parts/hausdorff.hpp"
#include "mortise/parts/mesh_solid.hpp"
#include "mortise/parts/read_part.hpp"

namespace mortise {
namespace {

struct Options {
  int largest = 128;
  bool measure = false;
  std::string balls;
  std::vector<std::string> meshes;
};

struct Method {
  const char* name;
  DecomposeOptions options;
};

std::vector<Method> methods() {
  using M = DecomposeMethod;
  using R = Reduction;
  std::vector<Method> result;
  for (const double mu : {0.25, 0.5, 1.0})
    for (const R reduction : {R::kContainment, R::kCover})
      result.push_back(
          {"skeletal", {.method = M::kSkeletal, .reduction = reduction, .protrusion = mu}});
  for (const R reduction : {R::kContainment, R::kCover}) {
    result.push_back({"packing", {.method = M::kInnerPacking, .reduction = reduction}});
    result.push_back({"octree", {.method = M::kOctree, .reduction = reduction}});
  }
  return result;
}

const char* reduction_name(Reduction reduction) {
  return reduction == Reduction::kCover         ? "cover"
         : reduction == Reduction::kContainment ? "containment"
                                                : "none";
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TriangleMesh unit_mesh(const std::string& path) {
  TriangleMesh mesh = read_part(path).mesh;
  const Eigen::Vector3d low = mesh.vertices.rowwise().minCoeff();
  const Eigen::Vector3d high = mesh.vertices.rowwise().maxCoeff();
  mesh.vertices =
      (mesh.vertices.colwise() - Eigen::Vector3d(0.5 * (low + high))) / (high - low).maxCoeff();
  return mesh;
}

void write_balls(const std::string& path, const Eigen::Matrix4Xd& balls) {
  std::ofstream file(path);
  file << "x,y,z,r\n";
  for (Eigen::Index i = 0; i < balls.cols(); ++i)
    file << balls(0, i) << ',' << balls(1, i) << ',' << balls(2, i) << ',' << balls(3, i) << '\n';
  if (!file) throw FileError(path, "cannot be written");
}

void run(const Options& options, const std::string& path) {
  const std::string name = std::filesystem::path(path).stem().string();
  const TriangleMesh mesh = unit_mesh(path);
  const MeshSolid solid(mesh);
  for (int grid = 16; grid <= options.largest; grid *= 2) {
    // The whole cube, as there: m = grid^3 nodes.
    GridNodes nodes;
    nodes.spacing = 1.0 / grid;
    nodes.size.setConstant(grid);
    nodes.origin.setConstant(-0.5 + 0.5 * nodes.spacing);
    auto start = std::chrono::steady_clock::now();
    const DistanceGrid distances = distance_grid(solid, nodes);
    const double distance_seconds = seconds_since(start);
    for (const Method& method : methods()) {
      start = std::chrono::steady_clock::now();
      const Decomposition d = decompose(distances, method.options);
      const double seconds = seconds_since(start);
      HausdorffDistance distance;
      if (options.measure)
        distance =
            hausdorff_distance(d.knots.points, solid, surface_samples(mesh, 0.25 * d.epsilon),
                               {.spacing = 0.25 * d.epsilon});
      const char* reduction = reduction_name(method.options.reduction);
      std::printf("%s,%d,%ld,%ld,%s,%.2f,%s,%ld,%ld,%.6f,%.6f,%.6f,%.6f,%.3f,%.3f\n", name.c_str(),
                  grid, static_cast<long>(d.nodes), static_cast<long>(d.inside), method.name,
                  method.options.protrusion, reduction, static_cast<long>(d.inner.cols()),
                  static_cast<long>(d.knots.size()), d.epsilon, distance.balls_beyond_solid,
                  distance.solid_beyond_balls, distance.of_surfaces(), distance_seconds, seconds);
      std::fflush(stdout);
      const bool shown = std::strcmp(method.name, "skeletal") == 0 &&
                         method.options.protrusion == DecomposeOptions{}.protrusion;
      if (shown && !options.balls.empty())
        write_balls(
            options.balls + "/" + name + "_" + std::to_string(grid) + "_" + reduction + ".csv",
            d.knots.points);
    }
  }
}

}  // namespace
}  // namespace mortise

int main(int argc, char** argv) {
  return mortise::bench::bench_main("decompose_bench", argc, argv, [](const auto& words) {
    mortise::Options options;
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (words[i] == "--measure")
        options.measure = true;
      else if (words[i] == "--largest" && i + 1 < words.size())
        options.largest = std::clamp(std::stoi(words[++i]), 16, 256);
      else if (words[i] == "--balls" && i + 1 < words.size())
        options.balls = words[++i];
      else
        options.meshes.push_back(words[i]);
    }
    std::printf(
        "mesh,grid,nodes,inside,method,mu,reduction,n1,n3,epsilon,balls_beyond,solid_beyond,"
        "surfaces,distance_seconds,seconds\n");
    for (const std::string& path : options.meshes) mortise::run(options, path);
  });
}
