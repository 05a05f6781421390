// SPDX-License-Identifier: GPL-3.0-or-later
// Dots on the molecular surface, patch by patch; derivation in docs/math.md.
#include "mortise/metrics/molecular_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "core/point_grid.hpp"
#include "core/sphere_points.hpp"
#include "metrics/probe_arcs.hpp"
#include "molecules/check_balls.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"

namespace mortise {
namespace {

using detail::GrownBalls;
using detail::ProbeArc;
using detail::ProbeCircle;

struct Dot {
  Eigen::Vector3d position, normal;
  double area = 0.0;
  std::int32_t atom = 0;
  SurfacePatch patch = SurfacePatch::kContact;
};

// A probe at rest on three balls.
struct RestingProbe {
  Eigen::Vector3d centre;
  std::array<std::int32_t, 3> balls{};
  double height = 0.0;  // over the plane through the balls' centres
};

// What one ball contributes; a torus counts for the ball of the smaller index.
struct Piece {
  std::vector<Dot> dots;
  std::vector<RestingProbe> probes;
};

class Surface {
 public:
  Surface(const Eigen::Matrix3Xd& centres, const Eigen::VectorXd& radii,
          const MolecularSurfaceOptions& options)
      : probe_(options.probe_radius),
        density_(options.density),
        radii_(radii),
        grown_{perturbed(centres), (radii.array() + probe_).matrix()},
        grid_(grown_.centres, 2.0 * grown_.radii.maxCoeff(), 2.0 * grown_.radii.maxCoeff()),
        probe_points_(lattice(probe_)) {}

  [[nodiscard]] Piece piece(std::int32_t i) const {
    Piece out;
    std::vector<std::int32_t> near;
    grid_.for_each_near(grown_.centres.col(i), [&](std::int32_t j) {
      if (j == i) return;
      const double reach = grown_.radii[i] + grown_.radii[j];
      if ((grown_.centres.col(j) - grown_.centres.col(i)).squaredNorm() < reach * reach)
        near.push_back(j);
    });
    // The closest hide most: circles then vanish after few of them.
    std::vector<std::pair<double, std::int32_t>> order;
    order.reserve(near.size());
    for (const std::int32_t j : near)
      order.emplace_back((grown_.centres.col(j) - grown_.centres.col(i)).norm() - grown_.radii[j],
                         j);
    std::sort(order.begin(), order.end());
    std::transform(order.begin(), order.end(), near.begin(),
                   [](const auto& o) { return o.second; });
    add_contact(i, near, out);
    ProbeCircle circle;
    for (const std::int32_t j : near) {
      if (j < i || !detail::probe_circle(grown_, i, j, circle)) continue;
      for (const ProbeArc& arc : detail::free_arcs(grown_, circle, i, j, near)) {
        add_torus(i, j, circle, arc, out);
        // Each resting probe ends arcs of three circles: it counts for the two smallest indices.
        if (arc.from_owner > j) add_probe(circle.at(arc.from), i, j, arc.from_owner, out);
        if (arc.to_owner > j) add_probe(circle.at(arc.to), i, j, arc.to_owner, out);
      }
    }
    return out;
  }

  // Dots of the triangle on a resting probe between the three points of touch.
  // `low`: probes that reach through the plane of their three balls; only these can run into
  // others.
  void add_concave(const RestingProbe& probe, const std::vector<Eigen::Vector3d>& low,
                   const detail::PointGrid& low_grid, std::vector<Dot>& dots) const {
    std::array<Eigen::Vector3d, 3> corners, sides;
    for (int k = 0; k < 3; ++k)
      corners[k] = (grown_.centres.col(probe.balls[k]) - probe.centre).normalized();
    const double volume = corners[0].dot(corners[1].cross(corners[2]));
    for (int k = 0; k < 3; ++k)
      sides[k] = (volume < 0.0 ? -1.0 : 1.0) * corners[k].cross(corners[(k + 1) % 3]);
    // Van Oosterom and Strackee: tan(half the solid angle) = |volume| / (1 + sum of the cosines).
    const double area =
        2.0 * probe_ * probe_ *
        std::atan2(std::abs(volume), 1.0 + corners[0].dot(corners[1]) + corners[1].dot(corners[2]) +
                                         corners[2].dot(corners[0]));
    const std::size_t first = dots.size();
    const auto add = [&](const Eigen::Vector3d& u) {
      const std::array<double, 3> closeness{u.dot(corners[0]), u.dot(corners[1]),
                                            u.dot(corners[2])};
      const auto nearest = std::max_element(closeness.begin(), closeness.end()) - closeness.begin();
      dots.push_back(
          {probe.centre + probe_ * u, -u, 0.0, probe.balls[nearest], SurfacePatch::kConcave});
    };
    for (Eigen::Index p = 0; p < probe_points_.cols(); ++p) {
      const Eigen::Vector3d u = probe_points_.col(p);
      if (u.dot(sides[0]) > 0.0 && u.dot(sides[1]) > 0.0 && u.dot(sides[2]) > 0.0) add(u);
    }
    if (dots.size() == first) add((corners[0] + corners[1] + corners[2]).normalized());
    const double each = area / static_cast<double>(dots.size() - first);
    for (std::size_t k = first; k < dots.size(); ++k) dots[k].area = each;
    if (probe.height >= probe_) return;
    const double inside = probe_ * probe_ * (1.0 - 1e-9);
    const auto hidden = [&](const Dot& dot) {
      bool found = false;
      low_grid.for_each_near(dot.position, [&](std::int32_t q) {
        found = found || (low[q] - dot.position).squaredNorm() < inside;
      });
      return found;
    };
    dots.erase(
        std::remove_if(dots.begin() + static_cast<std::ptrdiff_t>(first), dots.end(), hidden),
        dots.end());
  }

 private:
  // Four balls that one probe touches at once (square rings, lattices) would make the patches
  // between them overlap or leave a gap: a shift far below any coordinate's digits decides.
  static Eigen::Matrix3Xd perturbed(Eigen::Matrix3Xd centres) {
    std::uint32_t state = 1;
    for (double& x : centres.reshaped()) {
      state = 1664525U * state + 1013904223U;
      x += 1e-7 * (static_cast<double>(state >> 8) / 16777216.0 - 0.5);
    }
    return centres;
  }

  [[nodiscard]] Eigen::Matrix3Xd lattice(double radius) const {
    const double count = 4.0 * std::numbers::pi * radius * radius * density_;
    return detail::fibonacci_sphere(std::max(1, static_cast<int>(std::lround(count))));
  }

  void add_contact(std::int32_t i, const std::vector<std::int32_t>& near, Piece& out) const {
    if (!(radii_[i] > 0.0)) return;
    struct Cap {  // a direction u is hidden if u . towards > threshold
      Eigen::Vector3d towards;
      double threshold;
    };
    std::vector<Cap> caps;
    const double R = grown_.radii[i];
    for (const std::int32_t j : near) {
      const Eigen::Vector3d d = grown_.centres.col(j) - grown_.centres.col(i);
      const double Rj = grown_.radii[j], d_sq = d.squaredNorm(), length = std::sqrt(d_sq);
      if (length <= Rj - R) return;    // i lies within j
      if (length <= R - Rj) continue;  // j within i
      caps.push_back({d, (R * R + d_sq - Rj * Rj) / (2.0 * R)});
    }
    const Eigen::Matrix3Xd points = lattice(radii_[i]);
    const double area =
        4.0 * std::numbers::pi * radii_[i] * radii_[i] / static_cast<double>(points.cols());
    std::size_t last = 0;  // often hides the next point too
    for (Eigen::Index p = 0; p < points.cols(); ++p) {
      const Eigen::Vector3d u = points.col(p);
      const auto hides = [&](const Cap& cap) { return u.dot(cap.towards) > cap.threshold; };
      if (last < caps.size() && hides(caps[last])) continue;
      last = static_cast<std::size_t>(std::find_if(caps.begin(), caps.end(), hides) - caps.begin());
      if (last == caps.size())
        out.dots.push_back(
            {grown_.centres.col(i) + radii_[i] * u, u, area, i, SurfacePatch::kContact});
    }
  }

  // The saddle swept along one arc: on each probe the points from the touch of i, at angle
  // -atan2(from_i, radius) off the direction to the axis, to that of j. Where the probe reaches
  // across the axis, only what stays on its side is surface.
  void add_torus(std::int32_t i, std::int32_t j, const ProbeCircle& circle, const ProbeArc& arc,
                 Piece& out) const {
    const double low = -std::atan2(circle.from_i, circle.radius);
    const double high = std::atan2(circle.from_j, circle.radius);
    if (circle.radius >= probe_) {
      add_saddle(i, j, circle, arc, low, high, out);
    } else {
      const double cusp = std::acos(circle.radius / probe_);
      add_saddle(i, j, circle, arc, low, std::min(high, -cusp), out);
      add_saddle(i, j, circle, arc, std::max(low, cusp), high, out);
    }
  }

  void add_saddle(std::int32_t i, std::int32_t j, const ProbeCircle& circle, const ProbeArc& arc,
                  double low, double high, Piece& out) const {
    if (!(low < high)) return;
    const double turn = arc.to - arc.from;
    const auto area_of = [&](double a, double b) {
      return probe_ * turn * (circle.radius * (b - a) - probe_ * (std::sin(b) - std::sin(a)));
    };
    const double across = probe_ * (high - low) * std::sqrt(density_);
    const double most = std::max(1.0, std::ceil(area_of(low, high) * density_));
    const int strips = static_cast<int>(std::clamp(std::round(across), 1.0, most));
    for (int s = 0; s < strips; ++s) {
      const double a = low + (high - low) * s / strips;
      const double b = low + (high - low) * (s + 1) / strips;
      const double area = std::max(0.0, area_of(a, b)), angle = 0.5 * (a + b);
      const int count = std::max(1, static_cast<int>(std::lround(area * density_)));
      for (int k = 0; k < count; ++k) {
        const Eigen::Vector3d e = circle.radial(arc.from + turn * (k + 0.5) / count);
        const Eigen::Vector3d normal = std::cos(angle) * e - std::sin(angle) * circle.axis;
        out.dots.push_back({circle.centre + circle.radius * e - probe_ * normal, normal,
                            area / count, angle < 0.5 * (low + high) ? i : j,
                            SurfacePatch::kToroidal});
      }
    }
  }

  void add_probe(const Eigen::Vector3d& centre, std::int32_t i, std::int32_t j, std::int32_t k,
                 Piece& out) const {
    const Eigen::Vector3d a = grown_.centres.col(i), b = grown_.centres.col(j),
                          c = grown_.centres.col(k);
    const double height = std::abs((centre - a).dot((b - a).cross(c - a).normalized()));
    out.probes.push_back({centre, {i, j, k}, height});
  }

  double probe_, density_;
  const Eigen::VectorXd& radii_;
  GrownBalls grown_;
  detail::PointGrid grid_;
  Eigen::Matrix3Xd probe_points_;
};

void check(const Eigen::Matrix3Xd& centres, const Eigen::VectorXd& radii,
           const MolecularSurfaceOptions& options) {
  const std::string where = "molecular_surface: ";
  check_balls(where, centres, radii);
  for (const auto& [name, value] :
       {std::pair("probe_radius", options.probe_radius), std::pair("density", options.density)})
    if (!(value > 0.0 && std::isfinite(value)))
      throw InputError(where + name + " must be > 0 and finite, got " + std::to_string(value));
}

// The dots, sorted by atom; those of one atom stay in the order they were made in.
SurfaceDots gathered(const std::vector<std::vector<Dot>>& lists, Eigen::Index atoms) {
  std::vector<std::size_t> next(static_cast<std::size_t>(atoms) + 1, 0);
  for (const auto& list : lists)
    for (const Dot& dot : list) ++next[dot.atom + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  SurfaceDots out;
  const std::size_t count = next.back();
  const auto columns = static_cast<Eigen::Index>(count);
  out.positions.resize(3, columns);
  out.normals.resize(3, columns);
  out.areas.resize(columns);
  out.atoms.resize(count);
  out.patches.resize(count);
  for (const auto& list : lists)
    for (const Dot& dot : list) {
      const std::size_t slot = next[dot.atom]++;
      out.positions.col(static_cast<Eigen::Index>(slot)) = dot.position;
      out.normals.col(static_cast<Eigen::Index>(slot)) = dot.normal;
      out.areas[static_cast<Eigen::Index>(slot)] = dot.area;
      out.atoms[slot] = dot.atom;
      out.patches[slot] = dot.patch;
    }
  return out;
}

}  // namespace

SurfaceDots molecular_surface(const Eigen::Matrix3Xd& centres, const Eigen::VectorXd& radii,
                              const MolecularSurfaceOptions& options) {
  check(centres, radii, options);
  const int threads = resolve_threads(options.threads);
  if (radii.size() == 0) return gathered({}, 0);
  const Surface surface(centres, radii, options);
  constexpr std::size_t kPiece = 16;
  const auto atoms = static_cast<std::size_t>(radii.size());
  std::vector<Piece> pieces(atoms);
  parallel_for((atoms + kPiece - 1) / kPiece, threads, [&](std::size_t piece, int) {
    for (std::size_t i = piece * kPiece; i < std::min(atoms, (piece + 1) * kPiece); ++i)
      pieces[i] = surface.piece(static_cast<std::int32_t>(i));
  });
  std::vector<Eigen::Vector3d> low;
  for (const Piece& piece : pieces)
    for (const RestingProbe& probe : piece.probes)
      if (probe.height < options.probe_radius) low.push_back(probe.centre);
  Eigen::Matrix3Xd low_points(3, static_cast<Eigen::Index>(low.size()));
  for (std::size_t k = 0; k < low.size(); ++k)
    low_points.col(static_cast<Eigen::Index>(k)) = low[k];
  const detail::PointGrid low_grid(low_points, options.probe_radius, options.probe_radius);
  std::vector<std::vector<Dot>> dots(atoms);
  parallel_for((atoms + kPiece - 1) / kPiece, threads, [&](std::size_t piece, int) {
    for (std::size_t i = piece * kPiece; i < std::min(atoms, (piece + 1) * kPiece); ++i) {
      dots[i] = std::move(pieces[i].dots);
      for (const RestingProbe& probe : pieces[i].probes)
        surface.add_concave(probe, low, low_grid, dots[i]);
    }
  });
  return gathered(dots, radii.size());
}

}  // namespace mortise
