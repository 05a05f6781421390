// SPDX-License-Identifier: GPL-3.0-or-later
// Every format, every kind of bad file, and files with bytes changed at random.
#include "mortise/parts/read_part.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include "helpers/temporary_file.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/parts/format_part.hpp"
#include "parts/shapes.hpp"

namespace mortise {
namespace {

using testing::HasSubstr;
using tests::TemporaryFile;

const std::string kPin = MORTISE_SOURCE_DIR "/parts/round_peg_pin";

const char* const kTetrahedronObj =
    "# a tetrahedron\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
const char* const kCubeOff =
    "OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
    "4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";

std::string ascii_stl(const TriangleMesh& mesh) {
  std::string text = "solid thing\n";
  for (const auto t : mesh.triangles.colwise()) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const int v : t) {
      text += "   vertex";
      for (int i = 0; i < 3; ++i) text += " " + std::to_string(mesh.vertices(i, v));
      text += "\n";
    }
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid thing\n";
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The message for a file of this content, without its path.
std::string error_in(const std::string& name, const std::string& content) {
  const TemporaryFile file(name, content);
  try {
    (void)read_part(file.path());
  } catch (const FileError& e) {
    const std::string text = e.what();
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    return text.starts_with(file.path()) ? text.substr(file.path().size()) : "(no path) " + text;
  }
  return "no error";
}

TEST(ReadPart, TakesObjFilesAsPeopleWriteThem) {
  const TemporaryFile obj("x.obj", R"(mtllib absent.mtl   # a comment
g box with \
 a name
v 0 0 0 # first
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1 1.0
v 1 0 1
v 1 1 1
v 0 1 1 0.5 0.5 0.5
vt 0 0
vn 0 0 1
p 1 2
l 1 2 3
usemtl nothing
f 4/1 3/1 \
  2/1 1/1
f 5//1 6//1 7//1 8//1   # comment
f -8 -7 -3 -4
f 2/1/1 3/1/1 7/1/1 6/1/1
s off
f 3 4 8 7
f 4 1 5 8
)");
  const ReadPartResult box = read_part(obj.path());
  EXPECT_TRUE(box.closed);
  EXPECT_NEAR(box.volume, 1.0, 1e-12);
  EXPECT_EQ(box.mesh.size(), 12);
}

TEST(ReadPart, EveryFormat) {
  const TriangleMesh ball = shapes::icosphere(2.0, 3);
  const TemporaryFile ascii("ball.stl", ascii_stl(ball));
  EXPECT_NEAR(read_part(ascii.path()).volume, shapes::volume(ball), 1e-4);
  // A binary file whose header begins with "solid", and one under a wrong name.
  std::string binary = format_stl(ball);
  std::memcpy(binary.data(), "solid ", 6);
  const TemporaryFile misleading("ball.obj", binary);
  EXPECT_NEAR(read_part(misleading.path()).volume, shapes::volume(ball), 1e-4);
  const TemporaryFile obj("t.obj", kTetrahedronObj);
  EXPECT_NEAR(read_part(obj.path()).volume, 1.0 / 6.0, 1e-12);
  const TemporaryFile off("cube.off", kCubeOff);
  const ReadPartResult cube = read_part(off.path());
  EXPECT_NEAR(cube.volume, 1.0, 1e-12);
  EXPECT_EQ(cube.mesh.size(), 12);
  EXPECT_THAT(cube.decisions, testing::ElementsAre("cut 6 polygons into triangles"));
  EXPECT_TRUE(cube.unit.empty());
  const ReadPartResult step = read_part(kPin + ".step");
  EXPECT_EQ(step.unit, "mm");
  EXPECT_TRUE(step.closed);
}

TEST(ReadPart, StepIsTessellatedToTheDeviationAskedFor) {
  // Shank of radius 5 and 14 long, head of radius 8 and 5 long.
  const double exact = std::numbers::pi * (25 * 14 + 64 * 5);
  double before = 1.0;
  for (const double deviation : {0.5, 0.1, 0.02, 0.004}) {
    ReadPartOptions options;
    options.absolute_deviation = deviation;
    options.angle = 2.0;
    const ReadPartResult part = read_part(kPin + ".step", options);
    const double missing = 1 - part.volume / exact;
    EXPECT_GT(missing, 0.0);
    EXPECT_LT(missing, 2 * deviation / 5);  // the inscribed polygon of the smaller circle
    EXPECT_LT(missing, before);
    EXPECT_EQ(part.deviation, deviation);
    before = missing;
  }
}

TEST(ReadPart, SaysWhatIsWrongWithAFile) {
  EXPECT_THROW((void)read_part("/nosuch/x.stl"), FileError);
  EXPECT_THROW((void)read_part("/"), FileError);
  EXPECT_EQ(error_in("x.stl", ""), ": expected a mesh or STEP file, found an empty one");
  EXPECT_EQ(error_in("x.stl", "hello\n"), ": expected an STL file, found 6 bytes");
  EXPECT_EQ(error_in("x.xyz", "hello\n"),
            ": expected STL, OBJ, PLY, OFF or STEP, found other text");
  const std::string binary = format_stl(shapes::cube(1.0));
  EXPECT_EQ(error_in("x.stl", binary.substr(0, 400)),
            ": expected 684 bytes for 12 triangles, found 400");
  std::string with_nan = binary;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(with_nan.data() + 84 + 50 * 3 + 12, &nan, sizeof nan);
  EXPECT_EQ(error_in("x.stl", with_nan), ": triangle 3: a coordinate is not finite");
  const std::string ascii = ascii_stl(shapes::cube(1.0));
  EXPECT_EQ(error_in("x.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 zero 0\n"),
            ":4: expected a coordinate, found 'zero'");
  EXPECT_EQ(error_in("x.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 nan 0\n"),
            ":4: expected a finite coordinate, found 'nan'");
  EXPECT_THAT(error_in("x.stl", ascii.substr(0, ascii.size() / 2)), HasSubstr("expected "));
  EXPECT_THAT(error_in("x.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 7\n"), HasSubstr("expected"));
  EXPECT_THAT(error_in("x.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"),
              HasSubstr("expected faces, found none"));
  EXPECT_THAT(error_in("x.obj", "v 0 0 0\nv 1 0 \\\n zero\nf 1 2 3\n"),
              HasSubstr(":2: expected three coordinates after v, found \"zero\""));
  EXPECT_THAT(error_in("x.obj", "v 0 0 0\nv 1 0 0\n# a face\nf 1 2 -3\n"),
              HasSubstr(":4: expected corners like 1, 1/2, 1//3 or -1 after f, found \"-3\""));
  EXPECT_THAT(error_in("x.off", "OFF\n1000000000 1000000000 0\n0 0 0\n"),
              HasSubstr("found '1000000000'"));
  EXPECT_THAT(error_in("x.ply", "ply\nformat ascii 1.0\nelement vertex 2000000000\nend_header\n"),
              HasSubstr("expected a PLY file"));
  EXPECT_THAT(error_in("x.step", "ISO-10303-21;\nHEADER;\n"), HasSubstr("STEP"));
  EXPECT_THAT(error_in("x.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
              HasSubstr("found 3 open edges, the first from (0, 0, 0) to (1, 0, 0)"));
  ReadPartOptions bad;
  bad.deviation = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)read_part(kPin + ".stl", bad), InputError);
}

/// Reads the content; a clear refusal is as good as a mesh, anything else is not.
void survive(const std::string& name, const std::string& content,
             const ReadPartOptions& options = {}) {
  const TemporaryFile file(name, content);
  const auto start = std::chrono::steady_clock::now();
  try {
    const ReadPartResult result = read_part(file.path(), options);
    EXPECT_TRUE(result.mesh.vertices.allFinite());
    EXPECT_TRUE(options.repair.allow_open || result.volume > 0.0);
  } catch (const FileError&) {
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20)) << name;
}

TEST(ReadPart, SurvivesChangedBytes) {
  const TriangleMesh ball = shapes::icosphere(2.0, 2);
  const std::pair<std::string, std::string> sources[] = {{"x.stl", format_stl(ball)},
                                                         {"y.stl", ascii_stl(ball)},
                                                         {"x.ply", format_ply(ball)},
                                                         {"x.off", kCubeOff},
                                                         {"x.obj", kTetrahedronObj}};
  std::mt19937 random(11);
  for (const auto& [name, good] : sources) {
    for (int round = 0; round < 100; ++round) {
      std::string bad = good;
      const int changes = 1 << (round % 6);
      for (int i = 0; i < changes; ++i) bad[random() % bad.size()] = static_cast<char>(random());
      if (round % 4 == 3) bad.resize(random() % bad.size());
      survive(name, bad);
    }
  }
  for (int round = 0; round < 50; ++round) {  // nothing but noise
    std::string noise(random() % 2000, '\0');
    for (char& c : noise) c = static_cast<char>(random());
    survive("x.stl", noise);
  }
}

TEST(ReadPart, SurvivesAChangedStepFile) {
  const std::string good = bytes_of(kPin + ".step");
  std::mt19937 random(13);
  for (int round = 0; round < 60; ++round) {
    std::string bad = good;
    const int changes = 1 << (round % 6);
    for (int i = 0; i < changes; ++i) {
      // Mostly digits and names, so that references and types change, not the syntax alone.
      static const std::string kLikely = "0123456789#(),.;'ABCDEF$*";
      bad[40 + random() % (bad.size() - 40)] = kLikely[random() % kLikely.size()];
    }
    if (round % 5 == 4) bad.resize(40 + random() % (bad.size() - 40));
    // As it is: what encloses a volume is another test's, and takes seconds with sanitizers.
    survive("x.step", bad, {.repair = {.allow_open = true}});
  }
}

TEST(ReadPart, RealMeshes) {
  const std::string folder = MORTISE_SOURCE_DIR "/../shared/meshes/";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  for (const std::string name :
       {"ballA.off", "busted.STL", "bunny.ply", "featuretype.STEP", "featuretype.STL",
        "rocker-arm.obj", "fandisk.obj", "stanford-bunny.obj"})
    EXPECT_TRUE(read_part(folder + name).closed) << name;
  // Two of them with holes and doubled triangles, to be said.
  EXPECT_THAT(read_part(folder + "bunny.ply").decisions,
              testing::Contains(HasSubstr("filled 5 holes")));
  // One part in both formats.
  const ReadPartResult stl = read_part(folder + "featuretype.STL");
  const ReadPartResult step = read_part(folder + "featuretype.STEP");
  EXPECT_EQ(step.unit, "in");
  EXPECT_NEAR(step.volume, stl.volume, 1e-3 * stl.volume);
}

}  // namespace
}  // namespace mortise
