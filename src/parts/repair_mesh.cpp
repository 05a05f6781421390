// SPDX-License-Identifier: GPL-3.0-or-later
// The order of the repairs, and what is said about them.
#include "mortise/parts/repair_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "mortise/core/errors.hpp"
#include "parts/clean_soup.hpp"
#include "parts/enclose.hpp"
#include "parts/holes.hpp"
#include "parts/orient.hpp"
#include "parts/self_intersections.hpp"

namespace mortise {
namespace {

using parts::Surface;

std::string text_of(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

std::string text_of(const Eigen::Vector3d& p) {
  return "(" + text_of(p.x()) + ", " + text_of(p.y()) + ", " + text_of(p.z()) + ")";
}

/// "1 triangle", "2 triangles".
std::string counted(long n, const std::string& one, const std::string& many = "") {
  return std::to_string(n) + " " + (n == 1 ? one : many.empty() ? one + "s" : many);
}

Surface surface_of(const TriangleMesh& soup) {
  if (soup.size() == 0) throw InputError("expected triangles, found none");
  if (soup.triangles.minCoeff() < 0 || soup.triangles.maxCoeff() >= soup.vertices.cols())
    throw InputError("a triangle names vertex " +
                     std::to_string(soup.triangles.minCoeff() < 0 ? soup.triangles.minCoeff()
                                                                  : soup.triangles.maxCoeff()) +
                     ", expected 0 to " + std::to_string(soup.vertices.cols() - 1));
  Surface surface;
  surface.points.reserve(static_cast<std::size_t>(soup.vertices.cols()));
  for (const auto p : soup.vertices.colwise()) surface.points.emplace_back(p);
  surface.triangles.reserve(static_cast<std::size_t>(soup.size()));
  for (const auto t : soup.triangles.colwise()) {
    for (const int v : t) {
      if (!surface.points[static_cast<std::size_t>(v)].allFinite())
        throw InputError("vertex " + std::to_string(v) +
                         " is not finite: " + text_of(surface.points[static_cast<std::size_t>(v)]));
    }
    surface.triangles.push_back({t(0), t(1), t(2)});
  }
  for (auto& p : surface.points) {  // an unused vertex may be anything
    if (!p.allFinite()) p.setZero();
  }
  return surface;
}

class Repair {
 public:
  Repair(const TriangleMesh& soup, const RepairOptions& options)
      : options_(options), surface_(surface_of(soup)) {}

  RepairResult run();

 private:
  void say(long n, const std::string& line) {
    if (n > 0) result_.decisions.push_back(line);
  }
  void clean();
  void agree();
  void close(double tolerance, double largest, double flat);
  [[nodiscard]] bool bridge(double tolerance);
  void enclose();
  [[noreturn]] void refuse_open(const parts::Crossings& crossings) const;
  [[nodiscard]] parts::Crossings crossings() const {
    constexpr long kMost = 10000;
    return parts::find_crossings(surface_, kMost);
  }

  const RepairOptions& options_;
  Surface surface_;
  RepairResult result_;
  std::vector<parts::OpenEdge> open_;
  bool one_sided_ = false;
};

void Repair::clean() {
  parts::merge_equal_points(surface_);  // every STL file needs it: not worth a line
  surface_.diagonal = parts::diagonal_of(surface_);
  if (!(surface_.diagonal > 0.0)) throw InputError("all triangles lie in one point");
  if (!(surface_.diagonal < 1e100 && surface_.diagonal > 1e-100))
    throw InputError("expected a part of between 1e-100 and 1e100 units across, found " +
                     text_of(surface_.diagonal));
  const long collapsed = parts::drop_collapsed(surface_);
  say(collapsed, "dropped " + counted(collapsed, "triangle") + " with a repeated corner");
  const long second = parts::drop_second_sides(surface_);
  say(second, "dropped the second sides of faces: " + counted(second, "triangle"));
}

void Repair::agree() {
  auto sides = parts::sorted_sides(surface_.triangles);
  bool crowded = false;
  parts::for_each_edge(
      sides, [&](std::size_t first, std::size_t last) { crowded = crowded || last - first > 2; });
  if (crowded) {
    const long repeated = parts::drop_repeated(surface_);
    say(repeated, "dropped " + counted(repeated, "repeated triangle"));
    if (repeated > 0) sides = parts::sorted_sides(surface_.triangles);
  }
  const parts::Turned turned = parts::agree_with_neighbours(surface_, sides);
  say(turned.triangles,
      "turned " + counted(turned.triangles, "triangle") + " over to agree with the neighbours");
  one_sided_ = turned.one_sided > 0;
  say(turned.one_sided, "the surface has one side only along " + counted(turned.one_sided, "edge"));
  open_ = parts::open_edges(surface_.triangles, sides);
}

// Merges points of open edges nearer than `tolerance` and fills holes up to `largest` across, and
// those within `flat` of a plane.
void Repair::close(double tolerance, double largest, double flat) {
  // Points that two sides of a seam hold twice with rounding errors.
  std::vector<int> ends;
  for (const auto& edge : open_) {
    ends.push_back(edge.from);
    ends.push_back(edge.to);
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  const long near = parts::merge_near_points(surface_, ends, tolerance);
  say(near, "merged " + counted(near, "point") + " of open edges with points nearer than " +
                text_of(tolerance));
  if (near > 0) {
    parts::drop_collapsed(surface_);
    agree();
  }
  if (open_.empty()) return;
  const parts::Filled filled = parts::fill_holes(surface_, open_, largest, flat);
  say(filled.holes, "filled " + counted(filled.holes, "hole") + " with " +
                        counted(filled.triangles, "triangle") + ", the largest " +
                        text_of(filled.largest) + " across");
  if (filled.holes > 0) agree();
}

// Closes a surface that lacks faces: cracks up to `tolerance` of the diagonal are merged, flat
// openings of any size filled. False, and all as before, if that does not close it.
bool Repair::bridge(double tolerance) {
  const Surface open = surface_;
  const std::vector<std::string> decisions = result_.decisions;
  agree();
  close(tolerance * surface_.diagonal, options_.largest_hole * surface_.diagonal,
        std::max(tolerance, 1e-4) * surface_.diagonal);
  parts::flatten_needles(surface_);
  const auto sides = parts::sorted_sides(surface_.triangles);
  open_ = parts::open_edges(surface_.triangles, sides);
  result_.volume = parts::turn_outward(surface_, sides).volume;
  result_.closed = open_.empty() && !one_sided_;
  if (result_.closed && result_.volume > 1e-12 * std::pow(surface_.diagonal, 3)) return true;
  surface_ = open;
  agree();
  result_.decisions = decisions;
  result_.closed = false;
  return false;
}

// The open surface becomes what it encloses, or is refused.
void Repair::enclose() {
  if (bridge(options_.merge_tolerance)) return;
  const Surface open = surface_;
  const parts::Enclosed found = parts::enclose(surface_);
  if (!(found.volume > 1e-12 * std::pow(surface_.diagonal, 3))) {
    surface_ = open;
    if (bridge(1e-4) || bridge(1e-3)) return;
    refuse_open(options_.find_self_intersections ? crossings() : parts::Crossings());
  }
  say(found.sheets,
      "dropped " + counted(found.sheets, "triangle") + " of sheets without thickness");
  say(found.walls, "dropped " + counted(found.walls, "triangle") + " inside the solid");
  say(found.turned, "turned " + counted(found.turned, "triangle") + " outward");
  result_.volume = found.volume;
  open_ = parts::open_edges(surface_.triangles, parts::sorted_sides(surface_.triangles));
  result_.closed = open_.empty();
  if (found.wrapped) {
    result_.decisions.push_back("wrapped the surface, which does not close, " +
                                text_of(found.deviation) + " outside of its faces, gaps up to " +
                                text_of(found.gap) + " filled");
    result_.deviation = found.deviation;
  }
}

void Repair::refuse_open(const parts::Crossings& found) const {
  if (one_sided_) throw InputError("expected a solid, found a surface that has one side only");
  const auto& first = open_.front();
  const auto point = [&](int v) { return surface_.points[static_cast<std::size_t>(v)]; };
  std::string text = "expected a closed surface, found " +
                     counted(static_cast<long>(open_.size()), "open edge") + ", the first from " +
                     text_of(point(first.from)) + " to " + text_of(point(first.to)) +
                     ", and nothing that encloses a volume";
  if (found.pairs > 0)
    text += "; " + std::to_string(found.pairs) + (found.more ? " or more" : "") +
            " pairs of triangles cross, the first near " + text_of(found.first);
  throw InputError(text +
                   ". Close it, give sheets a thickness, or take what the winding number says "
                   "(--allow-open)");
}

RepairResult Repair::run() {
  clean();
  agree();
  if (!open_.empty())
    close(options_.merge_tolerance * surface_.diagonal, options_.largest_hole * surface_.diagonal,
          0.0);
  const long needles = parts::flatten_needles(surface_);
  say(needles, "removed " + counted(needles, "triangle") + " without area");
  if (surface_.triangles.empty())
    throw InputError("expected a surface, found triangles without area only");
  auto sides = parts::sorted_sides(surface_.triangles);
  open_ = parts::open_edges(surface_.triangles, sides);
  const parts::Outward outward = parts::turn_outward(surface_, sides);
  say(outward.turned, "turned " + counted(outward.turned, "shell") + " outward");
  say(outward.flat, "dropped " + counted(outward.flat, "shell") + " without volume");
  result_.closed = open_.empty() && !one_sided_;
  result_.volume = outward.volume;
  if (result_.closed && !(outward.volume > 1e-12 * std::pow(surface_.diagonal, 3)))
    throw InputError("expected a solid, found a surface that encloses no volume");
  if (!result_.closed && !options_.allow_open) enclose();
  if (outward.flat > 0 || !result_.closed) sides = parts::sorted_sides(surface_.triangles);
  say(static_cast<long>(open_.size()), "left " +
                                           counted(static_cast<long>(open_.size()), "open edge") +
                                           ": inside by winding number");
  if (result_.closed && outward.shells > 1)
    result_.decisions.push_back("the part has " + counted(outward.shells, "shell"));
  long crowded = 0;
  parts::for_each_edge(sides,
                       [&](std::size_t first, std::size_t last) { crowded += last - first > 2; });
  say(crowded, "kept " + counted(crowded, "edge") + " at which more than two triangles meet");

  parts::drop_unused_points(surface_);
  if (options_.find_self_intersections) {
    const parts::Crossings found = crossings();
    result_.self_intersections = found.pairs;
    say(found.pairs, "kept " + std::to_string(found.pairs) + (found.more ? " or more" : "") +
                         (found.pairs == 1 ? " pair" : " pairs") +
                         " of crossing triangles, the first near " + text_of(found.first) +
                         ": inside by winding number");
  }
  auto& mesh = result_.mesh;
  mesh.vertices.resize(3, static_cast<Eigen::Index>(surface_.points.size()));
  for (std::size_t i = 0; i < surface_.points.size(); ++i)
    mesh.vertices.col(static_cast<Eigen::Index>(i)) = surface_.points[i];
  mesh.triangles.resize(3, static_cast<Eigen::Index>(surface_.triangles.size()));
  for (std::size_t i = 0; i < surface_.triangles.size(); ++i) {
    const auto& t = surface_.triangles[i];
    mesh.triangles.col(static_cast<Eigen::Index>(i)) << t[0], t[1], t[2];
  }
  return std::move(result_);
}

}  // namespace

RepairResult repair_mesh(const TriangleMesh& soup, const RepairOptions& options) {
  if (!(options.merge_tolerance >= 0.0 && options.merge_tolerance <= 0.01))
    throw InputError("repair_mesh: merge_tolerance must be in [0, 0.01], got " +
                     text_of(options.merge_tolerance));
  if (!(options.largest_hole >= 0.0))
    throw InputError("repair_mesh: largest_hole must be >= 0, got " +
                     text_of(options.largest_hole));
  return Repair(soup, options).run();
}

}  // namespace mortise
