// SPDX-License-Identifier: GPL-3.0-or-later
// The three kinds of cells against looking at all points.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "core/cell_hash.hpp"
#include "core/cell_list.hpp"
#include "core/nearest_point.hpp"
#include "core/point_grid.hpp"

namespace mortise::detail {
namespace {

// Points in a flat box, some on a lattice of half edges, some twice; with an outlier or without.
Eigen::Matrix3Xd points_of(int n, bool outlier, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::Matrix3Xd points(3, n);
  for (int i = 0; i < n; ++i)
    points.col(i) << 7.0 * uniform(random), 5.0 * uniform(random), 2.0 * uniform(random) + 40.0;
  for (int i = 0; i + 9 < n; i += 10) {
    points.col(i) = (2.0 * points.col(i).array()).round() / 2.0;
    points.col(i + 1) = points.col(i);
  }
  if (outlier && n > 0) points.col(n - 1) << 1e9, -1e9, 3.0;
  return points;
}

std::vector<std::int32_t> all_near(const Eigen::Matrix3Xd& points, const Eigen::Vector3d& p,
                                   double cutoff) {
  std::vector<std::int32_t> near;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if ((points.col(i) - p).squaredNorm() < cutoff * cutoff)
      near.push_back(static_cast<std::int32_t>(i));
  return near;
}

std::vector<Eigen::Vector3d> places(const Eigen::Matrix3Xd& points, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<Eigen::Vector3d> result;
  for (int i = 0; i < 300; ++i)
    result.emplace_back(9.0 * uniform(random), 7.0 * uniform(random), 40.0 + 4.0 * uniform(random));
  for (Eigen::Index i = 0; i < std::min<Eigen::Index>(50, points.cols()); ++i)
    result.emplace_back(points.col(i));
  result.emplace_back(1e6, 0.0, 40.0);
  return result;
}

TEST(PointGrid, FindsWhatIsNearAndKnowsWhatIsFar) {
  for (const int n : {0, 1, 7, 400})
    for (const bool outlier : {false, true}) {
      if (outlier && n != 400) continue;  // millions of cells
      const Eigen::Matrix3Xd points = points_of(n, outlier, 1);
      const PointGrid grid(points, 1.0, 3.0);
      int far = 0;
      for (const Eigen::Vector3d& p : places(points, 2)) {
        std::vector<std::int32_t> found;
        grid.for_each_near(p, [&](std::int32_t i) { found.push_back(i); });
        std::sort(found.begin(), found.end());
        EXPECT_EQ(found, all_near(points, p, 1.0));
        for (const double distance : {1.0, 2.5}) {
          if (!grid.surely_farther(p, distance)) continue;
          ++far;
          EXPECT_TRUE(all_near(points, p, distance).empty());
        }
      }
      if (!outlier) {
        EXPECT_GT(far, 20);
      }
    }
}

TEST(NearestPoint, IsTheNearestWithinTheLimit) {
  for (const int n : {0, 1, 7, 400})
    for (const bool outlier : {false, true}) {
      const Eigen::Matrix3Xd points = points_of(n, outlier, 3);
      const NearestPoint nearest(points, 0.6);
      int found = 0;
      for (const Eigen::Vector3d& p : places(points, 4))
        for (const double limit : {0.3, 2.0, 1e12}) {
          const NearestPoint::Found answer = nearest(p, limit);
          const double least =
              n == 0 ? 1e300 : (points.colwise() - p).colwise().squaredNorm().minCoeff();
          if (least < limit * limit) {
            ++found;
            ASSERT_GE(answer.index, 0);
            EXPECT_NEAR((points.col(answer.index) - p).squaredNorm(), least, 1e-12 * least);
          } else {
            EXPECT_EQ(answer.index, -1);
          }
        }
      if (n > 0) {
        EXPECT_GT(found, 300);
      }
    }
}

TEST(CellList, HoldsEachPointOnceAndAllNeighboursAround) {
  for (const int n : {0, 1, 7, 400})
    for (const bool outlier : {false, true}) {
      const Eigen::Matrix3Xd points = points_of(n, outlier, 5);
      const double edge = 0.7;
      const CellList list(points, edge);
      std::vector<int> times(static_cast<std::size_t>(n), 0);
      for (std::int32_t cell = 0; cell < list.cells(); ++cell) {
        EXPECT_FALSE(list.points_in(cell).empty());
        for (const std::int32_t i : list.points_in(cell)) {
          ++times[static_cast<std::size_t>(i)];
          EXPECT_EQ(list.cell_of(i), cell);
          std::vector<std::int32_t> around;
          for (const std::int32_t c : list.cells_around(cell))
            for (const std::int32_t j : list.points_in(c))
              if ((points.col(j) - points.col(i)).squaredNorm() < edge * edge) around.push_back(j);
          std::sort(around.begin(), around.end());
          EXPECT_EQ(around, all_near(points, points.col(i), edge));
        }
      }
      EXPECT_EQ(std::count(times.begin(), times.end(), 1), n);
      // Not so large that the outlier makes all others one cell.
      if (n == 400 && !outlier) {
        EXPECT_GT(list.cells(), 100);
      }
    }
}

TEST(CellHash, GivesWhatIsNearOnceAdded) {
  const Eigen::Matrix3Xd points = points_of(400, true, 6);
  CellHash cells(0.8, {0.1, 0.2, 0.3});
  for (Eigen::Index added = 0; added < points.cols(); ++added) {
    const Eigen::Vector3d p = points.col(added);
    std::vector<std::int32_t> near, seen;
    EXPECT_FALSE(cells.any_cell_around(p, [&](const std::vector<std::int32_t>& items) {
      seen.insert(seen.end(), items.begin(), items.end());
      for (const std::int32_t i : items)
        if ((points.col(i) - p).norm() < 0.8) near.push_back(i);
      return false;
    }));
    std::sort(near.begin(), near.end());
    EXPECT_EQ(near, all_near(points.leftCols(added), p, 0.8));
    EXPECT_LT(seen.size(), 60U);  // of 400: the cells around alone
    if (!seen.empty()) {
      int calls = 0;
      EXPECT_TRUE(
          cells.any_cell_around(p, [&](const std::vector<std::int32_t>&) { return ++calls == 1; }));
      EXPECT_EQ(calls, 1);
    }
    cells.add(p, static_cast<std::int32_t>(added));
  }
}

}  // namespace
}  // namespace mortise::detail
