// SPDX-License-Identifier: GPL-3.0-or-later
// The tree of a mesh's triangles: halves by count along the longest side, three times per node.
#include "parts/build_triangle_tree.hpp"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mortise {
namespace {

using Eigen::Vector3d;

struct Item {
  Vector3d middle;
  int triangle;
};

struct Range {
  std::size_t begin, end;
  [[nodiscard]] std::size_t size() const { return end - begin; }
};

class Builder {
 public:
  explicit Builder(const TriangleMesh& mesh) : mesh_(mesh) {
    const auto count = static_cast<std::size_t>(mesh.size());
    items_.resize(count);
    for (std::size_t t = 0; t < count; ++t) {
      const auto index = static_cast<Eigen::Index>(t);
      items_[t] = {(corner(index, 0) + corner(index, 1) + corner(index, 2)) / 3.0,
                   static_cast<int>(t)};
    }
    tree_.packet_of.resize(count);
    tree_.packets.reserve(count / kTreeWidth + 1);
    tree_.nodes.reserve(count / (kTreeWidth * 4) + 1);
  }

  TriangleTree build() {
    tree_.nodes.emplace_back();
    fill_node(0, {0, items_.size()});
    return std::move(tree_);
  }

 private:
  Vector3d corner(Eigen::Index triangle, int k) const {
    return mesh_.vertices.col(mesh_.triangles(k, triangle));
  }

  // Two halves, the first a whole number of packets.
  std::pair<Range, Range> halves(Range range) {
    Eigen::AlignedBox3d box;
    for (std::size_t i = range.begin; i < range.end; ++i) box.extend(items_[i].middle);
    Eigen::Index axis = 0;
    box.sizes().maxCoeff(&axis);
    const std::size_t packets = (range.size() + kTreeWidth - 1) / kTreeWidth;
    const std::size_t middle = range.begin + (packets + 1) / 2 * kTreeWidth;
    const auto at = [&](std::size_t i) { return items_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(range.begin), at(middle), at(range.end), [&](const Item& a, const Item& b) {
      return a.middle[axis] < b.middle[axis] ||
             (a.middle[axis] == b.middle[axis] && a.triangle < b.triangle);
    });
    return {{range.begin, middle}, {middle, range.end}};
  }

  void fill_node(std::size_t node, Range range) {
    std::array<Range, kTreeWidth> parts{};
    parts[0] = range;
    int count = 1;
    for (int level = 0; level < 3; ++level)
      for (int p = count - 1; p >= 0; --p)
        if (parts[p].size() > kTreeWidth) {
          const auto [first, second] = halves(parts[p]);
          parts[p] = first;
          parts[count++] = second;
        }
    tree_.nodes[node].count = count;
    for (int p = 0; p < kTreeWidth; ++p) {
      if (p < count)
        describe(tree_.nodes[node], p, parts[p]);
      else
        leave_empty(tree_.nodes[node], p);
    }
    for (int p = 0; p < count; ++p) {
      if (parts[p].size() <= kTreeWidth) {
        tree_.nodes[node].child[p] = -1 - static_cast<int>(tree_.packets.size());
        add_packet(parts[p]);
      } else {
        const std::size_t child = tree_.nodes.size();
        tree_.nodes[node].child[p] = static_cast<int>(child);
        tree_.nodes.emplace_back();
        fill_node(child, parts[p]);
      }
    }
  }

  void add_packet(Range range) {
    TrianglePacket packet{};
    packet.count = static_cast<int>(range.size());
    for (int l = 0; l < kTreeWidth; ++l) {
      const int t =
          items_[std::min(range.begin + static_cast<std::size_t>(l), range.end - 1)].triangle;
      const Vector3d a = corner(t, 0), e1 = corner(t, 1) - a, e2 = corner(t, 2) - a;
      const Vector3d n = e1.cross(e2);
      const double area = n.norm();
      for (int d = 0; d < 3; ++d) {
        packet.corner[d][l] = a[d];
        packet.edge1[d][l] = e1[d];
        packet.edge2[d][l] = e2[d];
        packet.normal[d][l] = area > std::numeric_limits<double>::min() ? n[d] / area : 0.0;
      }
      const auto inverse = [](double sq) {
        return sq > std::numeric_limits<double>::min() ? 1.0 / sq : 0.0;
      };
      packet.inverse_edge1_sq[l] = inverse(e1.squaredNorm());
      packet.inverse_edge2_sq[l] = inverse(e2.squaredNorm());
      packet.inverse_edge3_sq[l] = inverse((e2 - e1).squaredNorm());
      packet.triangle[l] = t;
      tree_.packet_of[t] = static_cast<int>(tree_.packets.size());
    }
    tree_.packets.push_back(packet);
  }

  static void leave_empty(TreeNode& node, int p) {
    for (int d = 0; d < 3; ++d) {
      node.half[d][p] = -1e200;               // the square of what is beyond it is infinite
      node.centre[d][p] = node.centre[d][0];  // of no moments, so anywhere finite will do
    }
    node.radius[p] = node.radius[0];
    node.child[p] = -1;
  }

  // A box along the principal axes: flat where the surface is, so that of the many boxes about as
  // far as the nearest triangle few need to be opened.
  void lay_box(TreeNode& node, int p, Range range, const Eigen::Matrix3d& covariance) const {
    const Eigen::Matrix3d axes =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors();
    const Vector3d origin = items_[range.begin].middle;
    Eigen::AlignedBox3d box;
    for (std::size_t i = range.begin; i < range.end; ++i)
      for (int k = 0; k < 3; ++k)
        box.extend(axes.transpose() * (corner(items_[i].triangle, k) - origin));
    const Vector3d middle = origin + axes * box.center();
    for (int d = 0; d < 3; ++d) {
      node.middle[d][p] = middle[d];
      node.half[d][p] = 0.5 * box.sizes()[d];
      for (int a = 0; a < 3; ++a) node.axis[a][d][p] = axes(d, a);
    }
  }

  void describe(TreeNode& node, int p, Range range) const {
    Vector3d weighted = Vector3d::Zero(), plain = Vector3d::Zero();
    double area = 0.0;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const int t = items_[i].triangle;
      const Vector3d a = corner(t, 0), b = corner(t, 1), c = corner(t, 2);
      const double share = (b - a).cross(c - a).norm();
      area += share;
      weighted += share * (items_[i].middle - items_[range.begin].middle);
      plain += items_[i].middle - items_[range.begin].middle;
    }
    const Vector3d offset = area > std::numeric_limits<double>::min()
                                ? Vector3d(weighted / area)
                                : Vector3d(plain / static_cast<double>(range.size()));
    const Vector3d centre = items_[range.begin].middle + offset;
    Eigen::Matrix<double, kTreeMoments, 1> sum = Eigen::Matrix<double, kTreeMoments, 1>::Zero();
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    double radius_sq = 0.0;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const int t = items_[i].triangle;
      const Vector3d a = corner(t, 0) - centre, b = corner(t, 1) - centre,
                     c = corner(t, 2) - centre;
      radius_sq = std::max({radius_sq, a.squaredNorm(), b.squaredNorm(), c.squaredNorm()});
      const Vector3d n = 0.5 * (b - a).cross(c - a);  // unit normal times area
      const Vector3d s = (a + b + c) / 3.0;
      const Eigen::Matrix3d S =
          (a * a.transpose() + b * b.transpose() + c * c.transpose() + 9.0 * s * s.transpose()) /
          24.0;
      if (area > std::numeric_limits<double>::min()) covariance += 4.0 / area * n.norm() * S;
      Eigen::Matrix<double, kTreeMoments, 1> m;
      m << n, s[0] * n[0], s[1] * n[1], s[2] * n[2], s[0] * n[1] + s[1] * n[0],
          s[0] * n[2] + s[2] * n[0], s[1] * n[2] + s[2] * n[1],  //
          S(0, 0) * n[0], S(1, 1) * n[1], S(2, 2) * n[2],        //
          S(0, 0) * n[1] + 2 * S(0, 1) * n[0], S(0, 0) * n[2] + 2 * S(0, 2) * n[0],
          S(1, 1) * n[0] + 2 * S(0, 1) * n[1], S(1, 1) * n[2] + 2 * S(1, 2) * n[1],
          S(2, 2) * n[0] + 2 * S(0, 2) * n[2], S(2, 2) * n[1] + 2 * S(1, 2) * n[2],
          2 * (S(0, 1) * n[2] + S(0, 2) * n[1] + S(1, 2) * n[0]);
      sum += m;
    }
    for (int d = 0; d < 3; ++d) node.centre[d][p] = centre[d];
    lay_box(node, p, range, covariance);
    node.radius[p] = std::sqrt(radius_sq);
    const Eigen::Matrix3d& C = covariance;
    Eigen::Matrix<double, 6, 1> spread;
    spread << C(0, 0), C(1, 1), C(2, 2), 2 * C(0, 1), 2 * C(0, 2), 2 * C(1, 2);
    for (int k = 0; k < 6; ++k) node.spread[k][p] = spread[k];
    for (int m = 0; m < kTreeMoments; ++m) node.moments[m][p] = sum[m];
  }

  const TriangleMesh& mesh_;
  std::vector<Item> items_;
  TriangleTree tree_;
};

}  // namespace

TriangleTree build_triangle_tree(const TriangleMesh& mesh) { return Builder(mesh).build(); }

}  // namespace mortise
