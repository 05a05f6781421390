// SPDX-License-Identifier: GPL-3.0-or-later
// What is written is read back: the same part, moved.
#include "mortise/parts/format_part.hpp"

#include <gmock/gmock.h>

#include "helpers/temporary_file.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/parts/read_part.hpp"
#include "parts/shapes.hpp"

namespace mortise {
namespace {

using testing::HasSubstr;
using tests::TemporaryFile;

RigidMotion some_motion() {
  RigidMotion m;
  m.rotation = canonical(Eigen::Quaterniond(0.3, -0.5, 0.7, 0.2).normalized());
  m.translation = {11.0, -7.5, 3.25};
  return m;
}

/// Largest distance from the corners of `expected` to their nearest ones in `found`.
double farthest_corner(const Eigen::Matrix3Xd& expected, const Eigen::Matrix3Xd& found) {
  double farthest = 0.0;
  for (const auto p : expected.colwise())
    farthest =
        std::max(farthest, std::sqrt((found.colwise() - p).colwise().squaredNorm().minCoeff()));
  return farthest;
}

TEST(FormatPart, StlAndPlyComeBack) {
  const TriangleMesh ball = shapes::noisy_sphere(3.0, 500);
  const RigidMotion motion = some_motion();
  const Eigen::Matrix3Xd moved = motion * ball.vertices;
  const TemporaryFile stl("x.stl", format_stl(ball, motion));
  const TemporaryFile ply("x.ply", format_ply(ball, motion));
  const ReadPartResult from_stl = read_part(stl.path());
  EXPECT_EQ(from_stl.mesh.size(), ball.size());
  EXPECT_LT(farthest_corner(moved, from_stl.mesh.vertices), 2e-6);
  EXPECT_TRUE(from_stl.closed);
  const ReadPartResult from_ply = read_part(ply.path());
  EXPECT_EQ(from_ply.mesh.triangles, ball.triangles);
  EXPECT_LT((from_ply.mesh.vertices - moved).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(format_stl(ball, motion).size(), 84U + 50U * static_cast<std::size_t>(ball.size()));
}

TEST(FormatPart, OffAndObjComeBackToTheBit) {
  const TriangleMesh ball = shapes::noisy_sphere(3.0, 500);
  const TemporaryFile off("x.off", format_off(ball));
  const TemporaryFile obj("x.obj", format_obj(ball));
  for (const std::string& path : {off.path(), obj.path()}) {
    const ReadPartResult back = read_part(path);
    EXPECT_EQ(back.mesh.triangles, ball.triangles);
    EXPECT_EQ(back.mesh.vertices, ball.vertices);
  }
}

TEST(FormatPart, StepOfAMeshComesBackInItsUnit) {
  const TriangleMesh two = shapes::join(shapes::icosphere(3.0, 2), [] {
    TriangleMesh cube = shapes::cube(2.0);
    cube.vertices.colwise() += Eigen::Vector3d(9, 0, 0);
    return cube;
  }());
  const RigidMotion motion = some_motion();
  for (const std::string unit : {"mm", "m", "in"}) {
    const TemporaryFile step("x.step", format_step(two, motion, unit));
    const ReadPartResult back = read_part(step.path());
    EXPECT_EQ(back.unit, unit);
    EXPECT_TRUE(back.closed);
    EXPECT_NEAR(back.volume, shapes::volume(two), 1e-6 * back.volume);
    EXPECT_LT(farthest_corner(motion * two.vertices, back.mesh.vertices), 1e-6);
  }
  EXPECT_THROW((void)format_step(two, {}, "ell"), InputError);
  EXPECT_THROW((void)format_step(shapes::icosphere(1.0, 51), {}), InputError);  // 52,020 triangles
}

TEST(FormatPart, MovedStepKeepsItsCurvedFaces) {
  const std::string source = MORTISE_SOURCE_DIR "/parts/round_peg_pin.step";
  const RigidMotion motion = some_motion();
  const std::string bytes = format_moved_step(source, motion);
  EXPECT_THAT(bytes, HasSubstr("CYLINDRICAL_SURFACE"));
  EXPECT_TRUE(bytes == format_moved_step(source, motion));
  const TemporaryFile step("moved.step", bytes);
  const ReadPartResult before = read_part(source);
  const ReadPartResult after = read_part(step.path());
  EXPECT_NEAR(after.volume, before.volume, 1e-3 * before.volume);
  const Eigen::Vector3d expected = motion * Eigen::Vector3d(before.mesh.vertices.rowwise().mean());
  EXPECT_LT((after.mesh.vertices.rowwise().mean() - expected).norm(), 0.2);
  EXPECT_THROW((void)format_moved_step(MORTISE_SOURCE_DIR "/parts/round_peg_pin.stl", motion),
               FileError);
}

}  // namespace
}  // namespace mortise
