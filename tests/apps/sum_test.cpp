// SPDX-License-Identifier: GPL-3.0-or-later
// mortise sum and mortise sweep on cubes and a molecule.
#include <cmath>
#include <fstream>
#include <random>
#include <sstream>

#include "apps/program.hpp"
#include "mortise/parts/read_part.hpp"
#include "mortise/store/knots_file.hpp"

namespace mortise {
namespace {

class SumProgram : public testing::Program {
 protected:
  SumProgram() {
    write_cube("cube.obj", 0.5);
    write_cube("large.obj", 2.0);
    std::ofstream(path("path.csv")) << "qw,qx,qy,qz,tx,ty,tz\n1,0,0,0,0,0,0\n1,0,0,0,3,0,0\n";
    std::ofstream(path("poses.csv")) << "qw,qx,qy,qz,tx,ty,tz\n1,0,0,0,7,8,9\n0.70710678118654757,"
                                        "0,0,0.70710678118654746,7,8,9\n";
  }
  void write_cube(const std::string& name, double half) const {
    std::ofstream cube(path(name));
    for (int corner = 0; corner < 8; ++corner)
      cube << "v " << ((corner & 1) != 0 ? half : -half) << ' '
           << ((corner & 2) != 0 ? half : -half) << ' ' << ((corner & 4) != 0 ? half : -half)
           << '\n';
    cube << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  }
  // Balls of a file of plain ones.
  [[nodiscard]] std::vector<Eigen::Vector4d> plain(const std::string& name) const {
    std::ifstream file(path(name));
    std::vector<Eigen::Vector4d> balls;
    for (std::string line; std::getline(file, line);) {
      std::istringstream words(line);
      Eigen::Vector4d ball;
      if (words >> ball[0] >> ball[1] >> ball[2] >> ball[3]) balls.push_back(ball);
    }
    return balls;
  }
};

TEST_F(SumProgram, ObstacleOfTwoCubesIsACubeOfTwice) {
  for (const char* name : {"o.stl", "o.ply", "o.off", "o.obj"}) {
    const nlohmann::json figures =
        json(std::string("sum cube.obj cube.obj --grid 24 --spacing 0.04 -o ") + name);
    const double error = figures["error"].get<double>();
    // Both decompositions stand out by half a cell's diagonal, to which the answer keeps.
    EXPECT_NEAR(error, std::sqrt(3.0) / 24.0, 1e-9);
    for (int d = 0; d < 3; ++d) {
      EXPECT_NEAR(figures["low"][d].get<double>(), -1.0, error + 1e-6);
      EXPECT_NEAR(figures["high"][d].get<double>(), 1.0, error + 1e-6);
    }
    // Between the cubes of side 2 with `error` taken off and put on.
    EXPECT_GT(figures["volume"].get<double>(), std::pow(2.0 - 2.0 * error, 3));
    EXPECT_LT(figures["volume"].get<double>(), std::pow(2.0 + 2.0 * error, 3));
    const ReadPartResult mesh = read_part(path(name));
    EXPECT_TRUE(mesh.closed);
    EXPECT_NEAR(mesh.volume, figures["volume"].get<double>(), 1e-4);
    EXPECT_EQ(mesh.mesh.size(), figures["triangles"].get<long>());
  }
}

// What collide says of the same bodies, exactly, at translations in and out of the obstacle.
TEST_F(SumProgram, ObstacleOfMoleculesAnswersAsCollideDoes) {
  must("sum 1hpv_receptor.pdb 1hpv_ligand.pdb --poses poses.csv --pose 2 -o o.h5");
  const KnotsFile obstacle = read_knots_file(path("o.h5"));
  const Eigen::Matrix4Xd& balls = obstacle.knots.points;
  EXPECT_LT(balls.cols(), 758 * 758);
  const Eigen::Vector3d low = balls.topRows<3>().rowwise().minCoeff(),
                        high = balls.topRows<3>().rowwise().maxCoeff();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::ofstream poses(path("many.csv"));
  poses.precision(17);
  poses << "qw,qx,qy,qz,tx,ty,tz\n";
  std::vector<double> depth;
  for (int i = 0; i < 300; ++i) {
    Eigen::Vector3d t;
    for (int d = 0; d < 3; ++d) t[d] = low[d] - 3.0 + (high[d] - low[d] + 6.0) * uniform(random);
    depth.push_back(
        (balls.row(3) - (balls.topRows<3>().colwise() - t).colwise().norm()).maxCoeff());
    poses << "0.70710678118654757,0,0,0.70710678118654746," << t[0] << ',' << t[1] << ',' << t[2]
          << '\n';
  }
  poses.close();
  const nlohmann::json answers =
      json("collide 1hpv_receptor.pdb 1hpv_ligand.pdb --poses many.csv --modes 200");
  int yes = 0, no = 0;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (std::abs(depth[i]) < 1e-4) continue;  // single precision may not tell
    EXPECT_EQ(answers["poses"][i]["answer"], depth[i] > 0.0 ? "yes" : "no") << i;
    (depth[i] > 0.0 ? yes : no) += 1;
  }
  EXPECT_GT(yes, 30);
  EXPECT_GT(no, 30);
}

TEST_F(SumProgram, BallsGoInAndOutAndOffsetsAndSlackDoAsTheySay) {
  std::ofstream(path("off.csv")) << "qw,qx,qy,qz,tx,ty,tz\n1,0,0,0,0,0,0\n";
  must("decompose cube.obj -o cube.h5 --grid 12 --no-hausdorff");
  const nlohmann::json tight = json("sum cube.h5 cube.h5 -o tight.xyzr");
  EXPECT_EQ(tight["error"], 0.0);
  EXPECT_EQ(plain("tight.xyzr").size(), tight["balls"].get<std::size_t>());
  const nlohmann::json loose = json("sum cube.h5 cube.h5 --offset 0.25 -o loose.xyzr");
  EXPECT_NEAR(loose["high"][0].get<double>(), tight["high"][0].get<double>() + 0.25, 1e-6);
  const nlohmann::json few = json("sum cube.h5 cube.h5 --slack 0.2 -o few.xyzr");
  EXPECT_LT(few["balls"].get<long>(), tight["balls"].get<long>() / 4);
  EXPECT_NEAR(few["error"].get<double>(), 0.2, 1e-12);
  // Each ball lies in one of the few.
  const std::vector<Eigen::Vector4d> kept = plain("few.xyzr");
  for (const Eigen::Vector4d& ball : plain("tight.xyzr"))
    EXPECT_TRUE(std::any_of(kept.begin(), kept.end(), [&](const Eigen::Vector4d& k) {
      return (k.head<3>() - ball.head<3>()).norm() + ball[3] <= k[3] + 1e-6;
    }));
  // The sum and the obstacle of a body that is its own mirror image are one.
  const nlohmann::json plain_sum = json("sum cube.obj cube.obj --plain --grid 32 -o plain.stl");
  const double error = plain_sum["error"].get<double>();
  EXPECT_GT(plain_sum["volume"].get<double>(), std::pow(2.0 - 2.0 * error, 3));
  EXPECT_LT(plain_sum["volume"].get<double>(), std::pow(2.0 + 2.0 * error, 3));
  must("sum cube.h5 cube.h5 -o one.xyzr --threads 1");
  must("sum cube.h5 cube.h5 -o three.xyzr --threads 3");
  EXPECT_EQ(read_whole_file(path("one.xyzr")), read_whole_file(path("three.xyzr")));
}

TEST_F(SumProgram, InsideIsWhereTheBodyFits) {
  const nlohmann::json figures =
      json("sum large.obj cube.obj --inside --grid 32 --spacing 0.05 -o places.stl");
  // A cube of side 4 takes one of side 1 in a cube of side 3, less what the balls stand out.
  const double error = figures["error"].get<double>();
  EXPECT_LE(figures["volume"].get<double>(), 27.0);
  EXPECT_GT(figures["volume"].get<double>(), std::pow(3.0 - 2.0 * error, 3) - 0.2);
  EXPECT_LT(error, 0.03);
  expect_user_error("sum cube.obj large.obj --inside -o none.stl --quiet",
                    "fits into the fixed one nowhere");
  expect_user_error("sum large.obj cube.obj --inside -o places.h5", "places.h5: expected a name");
}

TEST_F(SumProgram, SweepFillsTheSpaceBetweenPoses) {
  const nlohmann::json swept =
      json("sweep cube.obj --path path.csv --grid 24 --spacing 0.05 -o swept.stl");
  const double error = swept["error"].get<double>();
  EXPECT_EQ(swept["poses"], 2);
  EXPECT_GT(swept["steps"].get<int>(), 60);
  EXPECT_LE(error, 0.5 * std::sqrt(3.0) / 24.0 + 0.5 * 2.0 / 64.0);
  EXPECT_GT(swept["volume"].get<double>(), (4.0 - 2.0 * error) * std::pow(1.0 - 2.0 * error, 2));
  EXPECT_LT(swept["volume"].get<double>(), (4.0 + 2.0 * error) * std::pow(1.0 + 2.0 * error, 2));
  const nlohmann::json two =
      json("sweep cube.obj --path path.csv --grid 24 --as-given -o two.xyzr");
  EXPECT_EQ(two["steps"], 2);
  EXPECT_NEAR(two["largest_motion"].get<double>(), 3.0, 1e-9);
  // A turn about the corner: the farthest ball's way is stated.
  std::ofstream(path("turn.csv")) << "qw,qx,qy,qz,tx,ty,tz\n1,0,0,0,0,0,0\n0,0,0,1,0,0,0\n";
  const nlohmann::json turned = json("sweep cube.obj --path turn.csv --step 0.05 -o turn.ply");
  EXPECT_LE(turned["largest_motion"].get<double>(), 0.05);
  EXPECT_NEAR(turned["volume"].get<double>(), 3.14159 * 0.5, 0.16);  // of radius sqrt(1/2), high 1
}

TEST_F(SumProgram, BadInputIsNamed) {
  expect_user_error("sum cube.obj cube.obj -o out.txt",
                    "out.txt: expected a name that ends in .h5");
  expect_user_error("sum cube.obj cube.obj -o cube.obj", "found an input");
  expect_user_error("sum cube.obj none.obj -o out.stl", "none.obj");
  expect_user_error("sum cube.obj cube.obj --rotation 1,1,0,0 -o out.stl", "norm 1.41");
  expect_user_error("sum cube.obj cube.obj --poses poses.csv --pose 3 -o out.stl",
                    "poses.csv: has 2 poses");
  expect_user_error("sum cube.obj cube.obj --offset -9 -o out.stl --quiet", "leaves nothing");
  expect_user_error("sum cube.obj cube.obj --offset nan -o out.stl", "--offset");
  expect_user_error("sum cube.obj cube.obj --spacing 1e-9 -o out.stl --quiet", "2^28 nodes");
  must("sum cube.obj cube.obj --grid 8 -o out.stl");
  expect_user_error("sum cube.obj cube.obj --grid 8 -o out.stl", "--force replaces it");
  must("sum cube.obj cube.obj --grid 8 -o out.stl --force");
  std::ofstream(path("empty.csv")) << "qw,qx,qy,qz,tx,ty,tz\n";
  expect_user_error("sweep cube.obj --path empty.csv -o new.stl", "holds no pose");
  expect_user_error("sweep cube.obj --path path.csv --step 1e-9 -o new.stl --quiet",
                    "1000000 steps");
  expect_user_error("sweep cube.obj --path path.csv -o path.csv", "path.csv: expected a name");
}

}  // namespace
}  // namespace mortise
