// SPDX-License-Identifier: GPL-3.0-or-later
// POV-Ray's scene language for a pose.
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "mortise/core/errors.hpp"
#include "mortise/molecules/radii.hpp"
#include "mortise/report/pictures.hpp"
#include "report/density_surface.hpp"
#include "report/heavy_atoms.hpp"
#include "report/part_view.hpp"
#include "report/ribbon.hpp"
#include "report/shading.hpp"

namespace mortise {
namespace {

constexpr double kMargin = 1.06;         // of the picture around what it shows
constexpr double kSurfaceSpacing = 0.5;  // angstrom
constexpr double kSeeThrough = 0.68;
constexpr double kSmooth = std::numbers::pi;  // a crease no edge has

// Linear light of the page's two body colours.
constexpr const char* kFixedColour = "srgb <0.54, 0.66, 0.80>";
constexpr const char* kMovingColour = "srgb <0.91, 0.52, 0.17>";
constexpr const char* kEdgeColour = "srgb <0.13, 0.18, 0.24>";

std::string vector_text(const Eigen::Vector3d& v) {
  std::array<char, 80> text;
  std::snprintf(text.data(), text.size(), "<%.6g,%.6g,%.6g>", v.x(), v.y(), v.z());
  return text.data();
}

std::string mesh_text(const TriangleMesh& mesh, const RigidMotion& motion, double crease) {
  const Eigen::Matrix3Xd normals =
      motion.rotation.toRotationMatrix() * detail::corner_normals(mesh, crease);
  const Eigen::Matrix3Xd vertices = motion * mesh.vertices;
  std::string text = "mesh {\n";
  for (Eigen::Index t = 0; t < mesh.size(); ++t) {
    text += "smooth_triangle {";
    for (int c = 0; c < 3; ++c)
      text += (c > 0 ? "," : "") + vector_text(vertices.col(mesh.triangles(c, t))) + "," +
              vector_text(normals.col(3 * t + c));
    text += "}\n";
  }
  return text;
}

std::string edges_text(const TriangleMesh& mesh, const RigidMotion& motion, double radius) {
  const Eigen::Matrix3Xd vertices = motion * mesh.vertices;
  const Eigen::Matrix2Xi edges = detail::sharp_edges(mesh);
  std::array<char, 32> thick;
  std::snprintf(thick.data(), thick.size(), "%.6g", radius);
  std::string text;
  for (Eigen::Index e = 0; e < edges.cols(); ++e) {
    const Eigen::Vector3d a = vertices.col(edges(0, e));
    const Eigen::Vector3d b = vertices.col(edges(1, e));
    if ((a - b).norm() < 1e-9 * radius) continue;  // POV-Ray refuses it
    text += "cylinder {" + vector_text(a) + "," + vector_text(b) + "," + thick.data() + "}\n";
  }
  if (text.empty()) return text;
  return "union {\n" + text + "pigment {color " + kEdgeColour +
         "} finish {ambient 0.4 diffuse 0.5} no_shadow}\n";
}

// Balls and sticks of what has no ribbon: hetero groups, and molecules without a backbone.
std::string sticks_text(const Molecule& molecule, const RigidMotion& motion, bool all) {
  std::vector<const Atom*> atoms;
  for (const Atom& atom : molecule.atoms)
    if (all || atom.hetero) atoms.push_back(&atom);
  std::string text;
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    const Eigen::Vector3d a = motion * atoms[i]->position;
    const char* colour = atoms[i]->element == "O"   ? "srgb <0.80,0.15,0.12>"
                         : atoms[i]->element == "N" ? "srgb <0.20,0.35,0.80>"
                         : atoms[i]->element == "S" ? "srgb <0.85,0.70,0.15>"
                         : atoms[i]->element == "P" ? "srgb <0.85,0.45,0.10>"
                                                    : "srgb <0.45,0.45,0.45>";
    text += "sphere {" + vector_text(a) + ",0.42 pigment {color " + colour + "} finish {Body}}\n";
    constexpr std::size_t kNeighbours = 60;  // bonds join atoms that are near in the file too
    for (std::size_t j = i + 1; j < std::min(atoms.size(), i + kNeighbours); ++j) {
      const Eigen::Vector3d b = motion * atoms[j]->position;
      constexpr double kBond = 1.95;  // angstrom
      if ((a - b).norm() < kBond && (a - b).norm() > 0.4)
        text += "cylinder {" + vector_text(a) + "," + vector_text(b) +
                ",0.2 pigment {color srgb <0.45,0.45,0.45>} finish {Body}}\n";
    }
  }
  return text;
}

std::string material(const std::string& colour, double transmit) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), " transmit %.3g", transmit);
  return "pigment {color " + colour + text.data() + "} finish {Body}" +
         (transmit > 0.0 ? " no_shadow" : "") + "}\n";
}

// Rows: to the right, upward, toward the viewer. The line between the bodies runs to the right;
// what is left of the molecules' extent upward.
Eigen::Matrix3d view_of_molecules(const Eigen::Matrix3Xd& fixed, const Eigen::Matrix3Xd& moving) {
  Eigen::Vector3d right = moving.rowwise().mean() - fixed.rowwise().mean();
  right = right.norm() > 1e-6 ? Eigen::Vector3d(right.normalized()) : Eigen::Vector3d::UnitX();
  Eigen::Matrix3Xd flat(3, fixed.cols() + moving.cols());
  flat << fixed, moving;
  flat.colwise() -= Eigen::Vector3d(flat.rowwise().mean());
  flat -= right * (right.transpose() * flat);
  const Eigen::Matrix3d spread = flat.lazyProduct(flat.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  Eigen::Vector3d up = axes.eigenvectors().col(2);
  up = (up - up.dot(right) * right).normalized();
  if (up.z() < 0.0) up = -up;
  Eigen::Matrix3d view;
  view << right.transpose(), up.transpose(), right.cross(up).transpose();
  return view;
}

std::string camera_text(const Eigen::Matrix3d& view, const Eigen::Matrix3Xd& points,
                        const PictureOptions& options) {
  const Eigen::Matrix3Xd seen = view * points;
  const Eigen::Vector3d low = seen.rowwise().minCoeff();
  const Eigen::Vector3d high = seen.rowwise().maxCoeff();
  const Eigen::Vector3d size = high - low;
  const double aspect = static_cast<double>(options.width) / options.height;
  const double height = kMargin * std::max(size.y(), size.x() / aspect);
  const Eigen::Vector3d centre = view.transpose() * (0.5 * (low + high));
  const double distance = 2.0 * size.norm();
  const Eigen::Vector3d right = view.row(0), up = view.row(1), toward = view.row(2);
  const Eigen::Vector3d eye = centre + distance * toward;
  // POV-Ray's axes are left-handed; a camera whose x axis points to the left undoes it.
  std::string text = "camera {orthographic location " + vector_text(eye) + " direction " +
                     vector_text(-toward) + " right " + vector_text(height * aspect * right) +
                     " up " + vector_text(height * up) + "}\n";
  const auto light = [&](const Eigen::Vector3d& from, const std::string& rest) {
    text += "light_source {" + vector_text(centre + distance * (view.transpose() * from)) + rest +
            "}\n";
  };
  const double width = 0.5 * distance;
  light({-0.9, 1.3, 1.4}, ", srgb 0.95 area_light " + vector_text(width * right) + "," +
                              vector_text(width * up) + ",4,4 adaptive 1 circular orient");
  light({1.2, 0.3, 1.6}, ", srgb 0.5 shadowless");
  light({0.0, -1.5, 0.6}, ", srgb 0.3 shadowless");
  return text;
}

void check(const ReportBodies& bodies, const PictureOptions& options) {
  for (const int pixels : {options.width, options.height})
    if (pixels < 16 || pixels > 10'000)
      throw InputError("povray_scene: width and height must be 16 to 10000, got " +
                       std::to_string(pixels));
  if (report_points(bodies.fixed).cols() == 0 || report_points(bodies.moving).cols() == 0)
    throw InputError("povray_scene: a body has no points");
}

}  // namespace

std::string povray_scene(const ReportBodies& bodies, const RigidMotion& pose,
                         const PictureOptions& options) {
  check(bodies, options);
  std::string text =
      "#version 3.7;\nglobal_settings {assumed_gamma 1.0 max_trace_level 24}\n"
      "background {color rgb 1}\n"
      "#declare Body = finish {ambient 0.22 diffuse 0.8 specular 0.1 roughness 0.04}\n";
  std::string objects;
  Eigen::Matrix3Xd shown;
  Eigen::Matrix3d view;
  const auto show = [&](const Eigen::Matrix3Xd& points) {
    shown.conservativeResize(3, shown.cols() + points.cols());
    shown.rightCols(points.cols()) = points;
  };
  if (bodies.fixed.is_mesh()) {
    const Eigen::Matrix3Xd fixed = report_points(bodies.fixed);
    const Eigen::Matrix3Xd moving = pose * report_points(bodies.moving);
    view = detail::part_view(bodies.fixed.mesh, moving.rowwise().mean() - fixed.rowwise().mean());
    show(fixed);
    show(moving);
    // Where parts fit exactly both surfaces are one, and the ray tracer would pick either.
    constexpr double kShrink = 0.998;
    TriangleMesh inner = bodies.moving.mesh;
    const Eigen::Vector3d middle = report_points(bodies.moving).rowwise().mean();
    inner.vertices = (kShrink * (inner.vertices.colwise() - middle)).colwise() + middle;
    constexpr double kLine = 0.0011;  // of the assembly's diagonal
    const double line = kLine * (shown.rowwise().maxCoeff() - shown.rowwise().minCoeff()).norm();
    objects = mesh_text(bodies.fixed.mesh, {}, detail::kCrease) +
              material(kFixedColour, kSeeThrough) + edges_text(bodies.fixed.mesh, {}, line) +
              mesh_text(inner, pose, detail::kCrease) + material(kMovingColour, 0.0) +
              edges_text(inner, pose, line);
  } else {
    const Molecule fixed = detail::heavy_atoms(bodies.fixed.molecule);
    const Molecule moving = detail::heavy_atoms(bodies.moving.molecule);
    const TriangleMesh surface =
        detail::density_surface(atom_positions(fixed), atom_radii(fixed), kSurfaceSpacing);
    const TriangleMesh band = detail::ribbon(moving);
    const Eigen::Matrix3Xd placed = pose * atom_positions(moving);
    view = view_of_molecules(atom_positions(fixed), placed);
    show(surface.vertices);
    show(placed);
    objects = mesh_text(surface, {}, kSmooth) + material(kFixedColour, 0.0) +
              sticks_text(fixed, {}, false) + sticks_text(moving, pose, band.size() == 0);
    if (band.size() > 0) objects += mesh_text(band, pose, kSmooth) + material(kMovingColour, 0.0);
  }
  return text + camera_text(view, shown, options) + objects;
}

}  // namespace mortise
