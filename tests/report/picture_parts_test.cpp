// SPDX-License-Identifier: GPL-3.0-or-later
// What pictures are made of: surfaces of balls, ribbons, sharp edges and normals.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "closed_mesh.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/molecules/radii.hpp"
#include "report/density_surface.hpp"
#include "report/part_view.hpp"
#include "report/ribbon.hpp"
#include "report/shading.hpp"
#include "sample_report.hpp"

namespace mortise::testing {
namespace {

double volume(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (Eigen::Index t = 0; t < mesh.size(); ++t)
    sum += mesh.vertices.col(mesh.triangles(0, t))
               .dot(mesh.vertices.col(mesh.triangles(1, t))
                        .cross(mesh.vertices.col(mesh.triangles(2, t)))) /
           6.0;
  return sum;
}

TEST(DensitySurface, OfOneBallIsItsSphere) {
  for (const double radius : {1.0, 3.0})
    for (const double share : {0.3, 0.15}) {
      const Eigen::Vector3d centre(5.0, -3.0, 100.0);
      const double spacing = share * radius;
      const TriangleMesh mesh =
          detail::density_surface(centre, Eigen::VectorXd::Constant(1, radius), spacing);
      ASSERT_GT(mesh.size(), 100);
      EXPECT_TRUE(is_closed(mesh));
      const Eigen::VectorXd distance = (mesh.vertices.colwise() - centre).colwise().norm();
      // A vertex is the mean of points within a cell of the sphere: inside by at most
      // (sqrt(3) spacing)^2 / 8 radius, and the linear crossing errs by as much again.
      const double tolerance = spacing * spacing / radius;
      EXPECT_LT((distance.array() - radius).abs().maxCoeff(), tolerance);
      TriangleMesh centred = mesh;
      centred.vertices.colwise() -= centre;
      EXPECT_NEAR(volume(centred), 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3),
                  4.0 * std::numbers::pi * radius * radius * tolerance);
    }
}

TEST(DensitySurface, EnclosesAProteinOnceAndClosed) {
  const Molecule molecule = protease().fixed.molecule;
  const Eigen::Matrix3Xd atoms = atom_positions(molecule);
  const TriangleMesh mesh = detail::density_surface(atoms, atom_radii(molecule), 0.8);
  EXPECT_TRUE(is_closed(mesh));
  // Partial specific volume of proteins, 0.73 cm^3/g, of about 10.8 kDa: 13,100 cubic angstrom; the
  // Gaussian surface fills crevices and stands out a little.
  EXPECT_GT(volume(mesh), 12'000.0);
  EXPECT_LT(volume(mesh), 20'000.0);
}

TEST(DensitySurface, RefusesWhatHasNoSurface) {
  EXPECT_THROW((void)detail::density_surface(Eigen::Matrix3Xd(3, 0), {}, 1.0), InputError);
  EXPECT_THROW((void)detail::density_surface(Eigen::Vector3d::Zero(),
                                             Eigen::VectorXd::Constant(1, 0.0), 1.0),
               InputError);
  EXPECT_THROW((void)detail::density_surface(Eigen::Vector3d::Zero(),
                                             Eigen::VectorXd::Constant(1, 1.0), 0.0),
               InputError);
}

TEST(Ribbon, FollowsTheBackbone) {
  const Molecule molecule = protease().moving.molecule;
  const TriangleMesh band = detail::ribbon(molecule);
  ASSERT_GT(band.size(), 10'000);
  EXPECT_TRUE(band.vertices.allFinite());
  std::vector<Eigen::Vector3d> trace;
  for (const Atom& atom : molecule.atoms)
    if (atom.name == "CA") trace.push_back(atom.position);
  // A B-spline stays within its four nodes: no vertex is far from an atom, and each atom has
  // vertices near by.
  Eigen::VectorXd nearest = Eigen::VectorXd::Constant(band.vertices.cols(), 1e9);
  for (const Eigen::Vector3d& at : trace) {
    const Eigen::VectorXd distance = (band.vertices.colwise() - at).colwise().norm();
    EXPECT_LT(distance.minCoeff(), 3.0);
    nearest = nearest.cwiseMin(distance);
  }
  EXPECT_LT(nearest.maxCoeff(), 4.0);
}

TEST(Ribbon, BreaksWhereResiduesAreMissingAndNeedsFour) {
  Molecule molecule = protease().moving.molecule;
  const auto whole = detail::ribbon(molecule).size();
  Molecule gap;
  for (const Atom& atom : molecule.atoms)
    if (atom.residue_number < 40 || atom.residue_number > 44) gap.atoms.push_back(atom);
  // 99 residues have 98 spans; without five in the middle, 94 residues in two runs have 92.
  EXPECT_EQ(detail::ribbon(gap).size() * 98, whole * 92);
  Molecule three;
  for (const Atom& atom : molecule.atoms)
    if (atom.residue_number < 4) three.atoms.push_back(atom);
  EXPECT_EQ(detail::ribbon(three).size(), 0);
  for (Atom& atom : molecule.atoms) atom.hetero = true;
  EXPECT_EQ(detail::ribbon(molecule).size(), 0);
}

TEST(PartView, IsARotationWithTheMovingPartUpward) {
  std::mt19937 random(3);
  for (int i = 0; i < 20; ++i) {
    TriangleMesh box;
    Eigen::Matrix2Xd outline(2, 4);
    outline << 0, 5, 5, 0, 0, 0, 4, 4;
    add_prism(box, outline, 0.0, 3.0);
    const Eigen::Quaterniond turn = tests::random_rotation(random);
    box.vertices = turn.toRotationMatrix() * box.vertices;
    for (const Eigen::Vector3d& axis :
         {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(0, 0, 1)}) {
      const Eigen::Matrix3d view =
          detail::part_view(box, turn * (axis + Eigen::Vector3d(0.1, 0.2, -0.1)));
      EXPECT_TRUE((view * view.transpose()).isIdentity(1e-12));
      EXPECT_NEAR(view.determinant(), 1.0, 1e-12);
      // Seen from 30 degrees above: upward in the picture, and toward the viewer.
      const Eigen::Vector3d seen = view * (turn * axis);
      EXPECT_LT((seen - Eigen::Vector3d(0.0, std::sqrt(0.75), 0.5)).norm(), 1e-9);
    }
  }
  const Eigen::Vector3d z =
      detail::part_view(
          detail::density_surface(Eigen::Vector3d::Zero(), Eigen::VectorXd::Constant(1, 2.0), 0.2),
          Eigen::Vector3d::UnitX()) *
      Eigen::Vector3d::UnitZ();
  EXPECT_GT(z.y(), 0.8) << "a ball has no flat faces: z is upward";
}

TEST(Shading, OfAPrismBreaksAtItsEdges) {
  TriangleMesh cube;
  Eigen::Matrix2Xd square(2, 4);
  square << 0, 1, 1, 0, 0, 0, 1, 1;
  add_prism(cube, square, 0.0, 1.0);
  EXPECT_EQ(detail::sharp_edges(cube).cols(), 12);
  const Eigen::Matrix3Xd normals = detail::corner_normals(cube);
  for (Eigen::Index t = 0; t < cube.size(); ++t) {
    const Eigen::Vector3d centre =
        (cube.vertices.col(cube.triangles(0, t)) + cube.vertices.col(cube.triangles(1, t)) +
         cube.vertices.col(cube.triangles(2, t))) /
            3.0 -
        Eigen::Vector3d::Constant(0.5);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(normals.col(3 * t + c).cwiseAbs().maxCoeff(), 1.0, 1e-12);  // along an axis
      EXPECT_NEAR(normals.col(3 * t + c).dot(centre), 0.5, 1e-12);            // outward
    }
  }
  // With every edge smooth, corners look away from the centre.
  const Eigen::Matrix3Xd smooth = detail::corner_normals(cube, std::numbers::pi);
  EXPECT_LT(smooth.cwiseAbs().maxCoeff(), 1.0 + 1e-12);
  EXPECT_EQ(detail::sharp_edges(cube, std::numbers::pi).cols(), 0);
}

TEST(Shading, OfACylinderIsRoundAndItsOpenRimIsAnEdge) {
  const ReportBodies parts = plate_and_pin();
  // The plate: four rings of 48 sides, of which the hole's and the outline's straight edges show.
  const Eigen::Matrix2Xi edges = detail::sharp_edges(parts.fixed.mesh);
  EXPECT_EQ(edges.cols(), 4 * 48 + 2 * 4);  // rims, and the chamfered outline's eight corners
  TriangleMesh open = parts.fixed.mesh;
  open.triangles.conservativeResize(3, open.size() - 1);
  EXPECT_GT(detail::sharp_edges(open).cols(), edges.cols());
}

}  // namespace
}  // namespace mortise::testing
