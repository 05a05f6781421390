// SPDX-License-Identifier: GPL-3.0-or-later
// Products by sums of sections, quotients by depths.
#include "mortise/collision/configuration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"
#include "mortise/parts/surface_net.hpp"
#include "parts/envelope_grid.hpp"
#include "parts/level_nodes.hpp"

namespace mortise {
namespace {

void check_rotation(const Eigen::Quaterniond& rotation, const char* who) {
  check_motion({rotation, Eigen::Vector3d::Zero()}, who);
}

void check_set(const Configurations& set, const char* who) {
  if (set.rotations.size() != set.translations.size())
    throw InputError(std::string(who) + ": " + std::to_string(set.rotations.size()) +
                     " rotations, but " + std::to_string(set.translations.size()) + " sections");
  for (const Eigen::Quaterniond& rotation : set.rotations) check_rotation(rotation, who);
}

void check_body(const Eigen::Matrix4Xd& balls, const char* who) {
  if (balls.cols() == 0 || !balls.allFinite() || balls.row(3).minCoeff() < 0.0)
    throw InputError(std::string(who) + ": expected balls, finite with radii >= 0");
}

Eigen::Matrix4Xd turned(const Eigen::Quaterniond& rotation, const Balls& balls, double sign) {
  Eigen::Matrix4Xd result = balls.cast<double>();
  result.topRows<3>() = sign * (rotation.toRotationMatrix() * result.topRows<3>());
  return result;
}

// Rotations equal to 1e-9 have equal or neighbouring keys; neighbours only stay apart.
std::array<long, 4> key_of(const Eigen::Quaterniond& rotation) {
  const Eigen::Quaterniond q = canonical(rotation);
  std::array<long, 4> key{};
  for (int d = 0; d < 4; ++d) key[static_cast<std::size_t>(d)] = std::lround(q.coeffs()[d] * 1e9);
  return key;
}

}  // namespace

Configurations configurations_of_body(const Eigen::Matrix4Xd& balls,
                                      const Eigen::Quaterniond& rotation) {
  return {{rotation}, {balls.cast<float>()}};
}

Configurations configurations_of_motions(const std::vector<RigidMotion>& motions,
                                         double tolerance) {
  Configurations set;
  for (const RigidMotion& motion : motions) {
    Eigen::Vector4d ball;
    ball << motion.translation, tolerance;
    set.rotations.push_back(motion.rotation);
    set.translations.emplace_back(ball.cast<float>());
  }
  return set;
}

Configurations inverse(const Configurations& set) {
  check_set(set, "inverse");
  Configurations result;
  for (std::size_t k = 0; k < set.rotations.size(); ++k) {
    result.rotations.push_back(set.rotations[k].conjugate());
    result.translations.emplace_back(
        turned(result.rotations.back(), set.translations[k], -1.0).cast<float>());
  }
  return result;
}

Configurations configuration_product(const Configurations& a, const Configurations& b,
                                     const MinkowskiOptions& options) {
  check_set(a, "configuration_product");
  check_set(b, "configuration_product");
  Configurations product;
  std::map<std::array<long, 4>, std::size_t> known;
  std::vector<std::vector<Balls>> sections;
  for (std::size_t i = 0; i < a.rotations.size(); ++i)
    for (std::size_t j = 0; j < b.rotations.size(); ++j) {
      const Eigen::Quaterniond rotation = canonical(a.rotations[i] * b.rotations[j]);
      const auto [entry, fresh] = known.try_emplace(key_of(rotation), sections.size());
      if (fresh) {
        product.rotations.push_back(rotation);
        sections.emplace_back();
      }
      sections[entry->second].push_back(
          minkowski_sum(a.translations[i].cast<double>(),
                        turned(a.rotations[i], b.translations[j], 1.0), options));
    }
  for (std::vector<Balls>& pieces : sections) {
    Configurations section;
    section.translations = std::move(pieces);
    product.translations.push_back(section.translations.size() == 1
                                       ? std::move(section.translations.front())
                                       : all_translations(section));
  }
  return product;
}

Balls all_translations(const Configurations& set) {
  Eigen::Index count = 0;
  for (const Balls& balls : set.translations) count += balls.cols();
  Balls result(4, count);
  Eigen::Index at = 0;
  for (const Balls& balls : set.translations) {
    result.middleCols(at, balls.cols()) = balls;
    at += balls.cols();
  }
  return result;
}

Eigen::VectorXd containment_depth(const Solid& solid, const Eigen::Matrix4Xd& balls,
                                  const std::vector<RigidMotion>& motions, int threads) {
  check_body(balls, "containment_depth");
  for (const RigidMotion& motion : motions) check_motion(motion, "containment_depth");
  Eigen::VectorXd depth(static_cast<Eigen::Index>(motions.size()));
  parallel_for(motions.size(), threads, [&](std::size_t m, int) {
    const Eigen::VectorXd distance = solid.signed_distance(
        motions[m] * Eigen::Matrix3Xd(balls.topRows<3>()), std::numeric_limits<double>::infinity());
    depth[static_cast<Eigen::Index>(m)] = -(distance + balls.row(3).transpose()).maxCoeff();
  });
  return depth;
}

TriangleMesh quotient_mesh(const Solid& solid, const Eigen::Matrix4Xd& balls,
                           const Eigen::Quaterniond& rotation, const QuotientMeshOptions& options) {
  check_body(balls, "quotient_mesh");
  check_rotation(rotation, "quotient_mesh");
  Eigen::Matrix4Xd body = balls;
  body.topRows<3>() = rotation.toRotationMatrix() * body.topRows<3>();
  // Where the body's own box fits into the solid's.
  const Eigen::AlignedBox3d outer = solid.bounds();
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  Eigen::AlignedBox3d box(Eigen::Vector3d::Constant(-kEndless),
                          Eigen::Vector3d::Constant(kEndless));
  for (const auto ball : body.colwise()) {
    box.min() =
        box.min().cwiseMax(Eigen::Vector3d(outer.min().array() - ball.head<3>().array() + ball[3]));
    box.max() =
        box.max().cwiseMin(Eigen::Vector3d(outer.max().array() - ball.head<3>().array() - ball[3]));
  }
  if (!((box.max() - box.min()).minCoeff() >= 0.0)) return {};
  const double spacing =
      options.spacing == 0.0 ? outer.sizes().maxCoeff() / 128.0 : options.spacing;
  const GridNodes nodes = parts::level_nodes(box, spacing, "quotient_mesh");
  // The most that a ball sticks out, max_j distance + s_j, is minus the least of the negatives.
  DistanceGrid grid = parts::envelope_grid(
      nodes, static_cast<std::int32_t>(body.cols()), options.threads,
      [&](const std::vector<std::int32_t>& which, const Eigen::Vector3d& at,
          std::vector<double>& values) {
        Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(which.size()));
        for (std::size_t n = 0; n < which.size(); ++n)
          points.col(static_cast<Eigen::Index>(n)) = body.col(which[n]).head<3>() + at;
        const Eigen::VectorXd distance = solid.signed_distance(points, kEndless);
        values.resize(which.size());
        for (std::size_t n = 0; n < which.size(); ++n)
          values[n] = -distance[static_cast<Eigen::Index>(n)] - body(3, which[n]);
      });
  for (float& value : grid.values) value = -value;
  return surface_net(grid);
}

}  // namespace mortise
