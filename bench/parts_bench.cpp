// SPDX-License-Identifier: GPL-3.0-or-later
// Time and memory of distance grid and skeletal density.
//   parts_bench [--threads N] [--nodes N] [--sigma S]... bumps TRIANGLES | obj FILE SUBDIVISIONS
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "mortise/parts/distance_grid.hpp"
#include "mortise/parts/mesh_solid.hpp"
#include "mortise/parts/skeletal_density.hpp"
#include "parts/shapes.hpp"

namespace {

// Vertices and triangles of an OBJ file, nothing else.
mortise::TriangleMesh read_obj(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector3i> triangles;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      Eigen::Vector3d v;
      words >> v[0] >> v[1] >> v[2];
      vertices.push_back(v);
    } else if (kind == "f") {
      std::vector<int> corners;
      for (std::string word; words >> word;) corners.push_back(std::stoi(word) - 1);
      for (std::size_t k = 2; k < corners.size(); ++k)
        triangles.emplace_back(corners[0], corners[k - 1], corners[k]);
    }
  }
  mortise::TriangleMesh mesh;
  mesh.vertices.resize(3, static_cast<Eigen::Index>(vertices.size()));
  for (std::size_t i = 0; i < vertices.size(); ++i)
    mesh.vertices.col(static_cast<Eigen::Index>(i)) = vertices[i];
  mesh.triangles.resize(3, static_cast<Eigen::Index>(triangles.size()));
  for (std::size_t i = 0; i < triangles.size(); ++i)
    mesh.triangles.col(static_cast<Eigen::Index>(i)) = triangles[i];
  return mesh;
}

class Watch {
 public:
  Watch() : wall_(std::chrono::steady_clock::now()), user_(user()) {}
  void report(const std::string& what) const {
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - wall_;
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    std::printf("%-34s %7.2f s user %7.2f s wall, peak %ld MiB\n", what.c_str(), user() - user_,
                wall.count(), usage.ru_maxrss / 1024);
    std::fflush(stdout);
  }

 private:
  static double user() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_utime.tv_sec) +
           1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
  }
  std::chrono::steady_clock::time_point wall_;
  double user_;
};

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  int threads = 0, nodes = 128;
  std::vector<double> sigmas;
  while (words.size() >= 2 && words[0].rfind("--", 0) == 0) {
    if (words[0] == "--threads") threads = std::stoi(words[1]);
    if (words[0] == "--nodes") nodes = std::stoi(words[1]);
    if (words[0] == "--sigma") sigmas.push_back(std::stod(words[1]));
    words.erase(words.begin(), words.begin() + 2);
  }
  if (words.size() < 2) {
    std::cerr << "parts_bench [--threads N] [--nodes N] [--sigma S]... bumps TRIANGLES | obj FILE "
                 "SUBDIVISIONS\n";
    return 1;
  }
  mortise::TriangleMesh mesh;
  if (words[0] == "obj") {
    mesh = read_obj(words[1]);
    for (int level = words.size() > 2 ? std::stoi(words[2]) : 0; level > 0; --level)
      mesh = mortise::shapes::subdivide(mesh);
  } else {
    mesh = mortise::shapes::noisy_sphere(1.0, std::stoi(words[1]));
  }
  const Watch build;
  const mortise::MeshSolid solid(mesh, {.threads = threads});
  build.report("tree of " + std::to_string(mesh.size()) + " triangles");
  std::printf("closed: %s\n", solid.closed() ? "yes" : "no");
  const auto grid =
      mortise::cubic_grid_around(solid.bounds(), nodes, 0.1 * solid.bounds().sizes().maxCoeff());
  const Watch watch;
  const auto distances = mortise::distance_grid(solid, grid, {.threads = threads});
  watch.report("distance at " + std::to_string(grid.count()) + " nodes");
  std::printf("inside: %ld nodes\n",
              static_cast<long>(std::count_if(distances.values.begin(), distances.values.end(),
                                              [](float d) { return d < 0; })));
  for (const double sigma : sigmas) {
    const Watch own;
    const auto density =
        mortise::skeletal_density(solid, distances, {.thickness = sigma, .threads = threads});
    own.report("skeletal density, sigma " + std::to_string(sigma).substr(0, 4));
    std::complex<double> sum = 0.0;
    for (const auto& value : density.values) sum += std::complex<double>(value);
    std::printf("sum: %.6g %.6g\n", sum.real(), sum.imag());
  }
  return 0;
}
