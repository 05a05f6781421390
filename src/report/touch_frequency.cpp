// SPDX-License-Identifier: GPL-3.0-or-later
// How often each place of the fixed body is touched by the moving one, over the best poses.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/point_grid.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"
#include "mortise/report/page.hpp"
#include "report/heavy_atoms.hpp"

namespace mortise {
namespace {

struct Places {
  Eigen::Matrix3Xd points;
  std::vector<int> place_of;  // one per point
  int count = 0;
};

Places fixed_places(const ReportBody& body) {
  Places places;
  if (body.is_mesh()) {
    places.points = body.mesh.vertices;
    places.count = static_cast<int>(places.points.cols());
    for (int i = 0; i < places.count; ++i) places.place_of.push_back(i);
    return places;
  }
  // Residues are counted over heavy atoms, as the page sees them.
  const Molecule heavy = detail::heavy_atoms(body.molecule);
  places.points = report_points(body);
  for (const ResidueRange& residue : residues(heavy)) {
    places.place_of.insert(places.place_of.end(), residue.last - residue.first, places.count);
    ++places.count;
  }
  return places;
}

Eigen::Matrix3Xd moving_points(const ReportBody& body) {
  if (!body.is_mesh()) return report_points(body);
  Eigen::Matrix3Xd points(3, body.mesh.vertices.cols() + body.mesh.size());
  points.leftCols(body.mesh.vertices.cols()) = body.mesh.vertices;
  for (Eigen::Index t = 0; t < body.mesh.size(); ++t)
    points.col(body.mesh.vertices.cols() + t) =
        (body.mesh.vertices.col(body.mesh.triangles(0, t)) +
         body.mesh.vertices.col(body.mesh.triangles(1, t)) +
         body.mesh.vertices.col(body.mesh.triangles(2, t))) /
        3.0;
  return points;
}

}  // namespace

Eigen::VectorXd touch_frequency(const Run& run, const ReportBodies& bodies, double cutoff,
                                int poses, int threads) {
  if (!(cutoff > 0.0))
    throw InputError("touch_frequency: cutoff must be > 0, got " + std::to_string(cutoff));
  if (poses < 1)
    throw InputError("touch_frequency: poses must be >= 1, got " + std::to_string(poses));
  const Places fixed = fixed_places(bodies.fixed);
  const Eigen::Matrix3Xd moving = moving_points(bodies.moving);
  const std::size_t count = std::min(static_cast<std::size_t>(poses), run.poses.poses.size());
  Eigen::VectorXd frequency = Eigen::VectorXd::Zero(fixed.count);
  if (count == 0 || fixed.count == 0 || moving.cols() == 0) return frequency;

  const detail::PointGrid grid(fixed.points, cutoff, cutoff);
  struct Scratch {
    std::vector<std::int32_t> touches;  // per place
    std::vector<std::size_t> last;      // pose + 1 that touched it last
  };
  std::vector<Scratch> scratch(static_cast<std::size_t>(resolve_threads(threads)));
  parallel_for(count, threads, [&](std::size_t index, int worker) {
    Scratch& mine = scratch[static_cast<std::size_t>(worker)];
    if (mine.touches.empty()) {
      mine.touches.assign(static_cast<std::size_t>(fixed.count), 0);
      mine.last.assign(static_cast<std::size_t>(fixed.count), 0);
    }
    const Eigen::Matrix3Xd moved = run.poses.poses[index].moving_in_fixed * moving;
    for (Eigen::Index i = 0; i < moved.cols(); ++i)
      grid.for_each_near(moved.col(i), [&](std::int32_t point) {
        const auto place =
            static_cast<std::size_t>(fixed.place_of[static_cast<std::size_t>(point)]);
        if (mine.last[place] == index + 1) return;
        mine.last[place] = index + 1;
        ++mine.touches[place];
      });
  });
  for (const Scratch& mine : scratch)
    for (std::size_t k = 0; k < mine.touches.size(); ++k)
      frequency[static_cast<Eigen::Index>(k)] += mine.touches[k];
  return frequency / static_cast<double>(count);
}

}  // namespace mortise
