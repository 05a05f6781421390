// SPDX-License-Identifier: GPL-3.0-or-later
// Maps in bricks: which blocks of cells need one, and what stands in them.
#include "scoring/fill_maps.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"

namespace mortise::detail {
namespace {

// Points that make a field, from grid point 0, and how far it reaches.
struct Sources {
  std::vector<float> x, y, z, weights;
  std::vector<std::int32_t> types;
  double range = 0.0;

  void add(const Eigen::Vector3d& place, int type, double weight) {
    x.push_back(static_cast<float>(place[0]));
    y.push_back(static_cast<float>(place[1]));
    z.push_back(static_cast<float>(place[2]));
    types.push_back(type);
    weights.push_back(static_cast<float>(weight));
  }
  [[nodiscard]] FieldSources view() const {
    return {x.data(), y.data(), z.data(), types.data(), weights.data()};
  }
};

// The sources near a box that is narrowed axis by axis: first to a slab, then a row, then a block.
class Narrowing {
 public:
  explicit Narrowing(const Sources& sources) : sources_(sources), all_(sources.x.size()) {
    for (std::size_t i = 0; i < all_.size(); ++i) all_[i] = static_cast<std::int32_t>(i);
  }
  void slab(double low, double high) { narrow(sources_.x, all_, {}, low, high, slab_, slab_sq_); }
  void row(double low, double high) {
    narrow(sources_.y, slab_, slab_sq_, low, high, row_, row_sq_);
  }
  const std::vector<std::int32_t>& block(double low, double high) {
    narrow(sources_.z, row_, row_sq_, low, high, block_, block_sq_);
    return block_;
  }
  bool any_in_block(double low, double high) const {
    for (std::size_t n = 0; n < row_.size(); ++n)
      if (within(sources_.z[row_[n]], row_sq_[n], low, high) >= 0.0) return true;
    return false;
  }

 private:
  // Squared distance to the box along the axes so far; < 0: too far.
  [[nodiscard]] double within(double at, double before, double low, double high) const {
    const double off = std::max({0.0, low - at, at - high});
    const double sq = before + off * off;
    return sq < sources_.range * sources_.range ? sq : -1.0;
  }
  void narrow(const std::vector<float>& axis, const std::vector<std::int32_t>& from,
              const std::vector<double>& from_sq, double low, double high,
              std::vector<std::int32_t>& to, std::vector<double>& to_sq) const {
    to.clear();
    to_sq.clear();
    for (std::size_t n = 0; n < from.size(); ++n) {
      const double sq = within(axis[from[n]], from_sq.empty() ? 0.0 : from_sq[n], low, high);
      if (sq < 0.0) continue;
      to.push_back(from[n]);
      to_sq.push_back(sq);
    }
  }

  const Sources& sources_;
  std::vector<std::int32_t> all_, slab_, row_, block_;
  std::vector<double> slab_sq_, row_sq_, block_sq_;
};

// For blocks without a brick (0), minus the number of blocks to the nearest one that has one (> 0).
void mark_clearance(std::vector<std::int32_t>& blocks, const std::array<int, 3>& size) {
  const int most = size[0] + size[1] + size[2];
  for (std::int32_t& b : blocks)
    if (b == 0) b = -most;
  const auto at = [&](int i, int j, int k) -> std::int32_t& {
    return blocks[(static_cast<std::size_t>(i) * size[1] + j) * size[2] + k];
  };
  // Two sweeps: a way of k steps to the nearest goes through neighbours seen before, one way or the
  // other.
  const auto look = [&](int i, int j, int k, int sign) {
    std::int32_t& here = at(i, j, k);
    if (here > 0) return;
    for (int n = 0; n < 13; ++n) {  // half of the 26 neighbours
      const int a = i - sign * (n < 9 ? 1 : 0);
      const int b = j - sign * (n < 9 ? n / 3 - 1 : n < 12 ? 1 : 0);
      const int c = k - sign * (n < 12 ? n % 3 - 1 : 1);
      if (a < 0 || b < 0 || c < 0 || a >= size[0] || b >= size[1] || c >= size[2]) continue;
      here = std::max(here, std::min(0, at(a, b, c)) - 1);
    }
  };
  for (int i = 0; i < size[0]; ++i)
    for (int j = 0; j < size[1]; ++j)
      for (int k = 0; k < size[2]; ++k) look(i, j, k, 1);
  for (int i = size[0] - 1; i >= 0; --i)
    for (int j = size[1] - 1; j >= 0; --j)
      for (int k = size[2] - 1; k >= 0; --k) look(i, j, k, -1);
}

class Filler {
 public:
  Filler(const FieldTable& table, const MapsLayout& layout, const TypedPoints& fixed,
         const ContactPotential& potential, const ShapeTerms* shape)
      : table_(table),
        layout_(layout),
        types_(potential.near.rows()),
        near_(potential.near.cast<float>()),
        far_(potential.far.cast<float>()) {
    contacts_.range = kContactRange;
    for (Eigen::Index i = 0; i < fixed.points.cols(); ++i)
      if (fixed.types[i] >= 0) contacts_.add(fixed.points.col(i) - layout.low, fixed.types[i], 0.0);
    if (shape == nullptr) return;
    terms_ = shape->kernels.size();
    shape_.range = shape->kernels.front().front().range;
    for (Eigen::Index i = 0; i < shape->points.cols(); ++i)
      shape_.add(shape->points.col(i) - layout.low, shape->kernel_of[i], shape->weights[i]);
    for (const auto& term : shape->kernels) {
      entries_ = term.front().values.size();
      std::vector<float>& tables = tables_.emplace_back();
      for (const TabulatedKernel& kernel : term)
        for (const double value : kernel.values) tables.push_back(static_cast<float>(value));
      tables.push_back(0.0F);
    }
  }

  FilledMaps fill(int threads) const {
    const auto [nx, ny, nz] = layout_.size;
    const std::size_t plane = static_cast<std::size_t>(ny) * nz;
    FilledMaps maps;
    maps.blocks.assign(nx * plane, 0);
    parallel_for(static_cast<std::size_t>(nx), threads,
                 [&](std::size_t i, int) { mark(i, maps.blocks.data() + i * plane); });
    const std::size_t stride = (types_ + terms_) * kBrickPoints;
    std::size_t bricks = 1;  // the first is 0, for points that lie in none
    for (std::int32_t& b : maps.blocks)
      if (b != 0) {
        if (++bricks * stride > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
          throw InputError("score maps: spacing " + std::to_string(layout_.spacing) +
                           " is too fine for a body of this size");
        b = static_cast<std::int32_t>((bricks - 1) * stride);
      }
    maps.values.resize(bricks * stride + 2);  // the last pair may be read one beyond
    parallel_for(static_cast<std::size_t>(nx), threads, [&](std::size_t i, int) {
      fill_slab(i, maps.blocks.data() + i * plane, maps.values.data());
    });
    mark_clearance(maps.blocks, layout_.size);
    return maps;
  }

 private:
  // 1 for each block of the slab that a source reaches.
  void mark(std::size_t i, std::int32_t* blocks) const {
    const double step = kBrickCells * layout_.spacing;
    for (const Sources* sources : {&contacts_, &shape_}) {
      Narrowing near(*sources);
      near.slab(static_cast<double>(i) * step, static_cast<double>(i + 1) * step);
      for (int j = 0; j < layout_.size[1]; ++j) {
        near.row(j * step, (j + 1) * step);
        for (int k = 0; k < layout_.size[2]; ++k) {
          std::int32_t& b = blocks[static_cast<std::size_t>(j) * layout_.size[2] + k];
          if (b == 0 && near.any_in_block(k * step, (k + 1) * step)) b = 1;
        }
      }
    }
  }

  // Each grid point once into planes, then into the bricks that have it.
  void fill_slab(std::size_t i, const std::int32_t* blocks, std::uint16_t* values) const {
    const int rows = layout_.size[1] * kBrickCells / kBrickSide + 1;  // of 4 x 4 x 4 points
    const int columns = layout_.size[2] * kBrickCells / kBrickSide + 1;
    const std::ptrdiff_t row = std::ptrdiff_t{columns} * kBrickSide;
    const std::ptrdiff_t plane = row * rows * kBrickSide, map = plane * kBrickSide;
    const std::size_t count = types_ + terms_;
    std::vector<float> planes(count * map, 0.0F);
    std::vector<float> work(2 * types_ * kBrickPoints), out(count * kBrickPoints);
    Narrowing near_contacts(contacts_), near_shape(shape_);
    const double side = (kBrickSide - 1) * layout_.spacing, step = kBrickSide * layout_.spacing;
    const double x = static_cast<double>(i) * kBrickCells * layout_.spacing;
    near_contacts.slab(x, x + side);
    near_shape.slab(x, x + side);
    const auto spacing = static_cast<float>(layout_.spacing);
    for (int j = 0; j < rows; ++j) {
      near_contacts.row(j * step, j * step + side);
      near_shape.row(j * step, j * step + side);
      for (int k = 0; k < columns; ++k) {
        const float corner[3] = {static_cast<float>(x), static_cast<float>(j * step),
                                 static_cast<float>(k * step)};
        const auto& typed = near_contacts.block(k * step, k * step + side);
        const auto& knots = near_shape.block(k * step, k * step + side);
        if (typed.empty() && knots.empty()) continue;
        if (typed.empty())
          std::fill(out.begin(), out.begin() + types_ * kBrickPoints, 0.0F);
        else
          table_.contacts(contacts_.view(), typed.data(), static_cast<std::ptrdiff_t>(typed.size()),
                          corner, spacing, near_.data(), far_.data(), types_, work.data(),
                          out.data());
        for (std::size_t q = 0; q < terms_; ++q)
          table_.shape(shape_.view(), knots.data(), static_cast<std::ptrdiff_t>(knots.size()),
                       corner, spacing, tables_[q].data(), static_cast<std::ptrdiff_t>(entries_),
                       static_cast<float>(shape_.range * shape_.range),
                       out.data() + (types_ + q) * kBrickPoints);
        for (std::size_t m = 0; m < count; ++m)
          for (int n = 0; n < kBrickSide * kBrickSide; ++n)
            std::copy_n(out.data() + m * kBrickPoints + n * kBrickSide, kBrickSide,
                        planes.data() + m * map + n / kBrickSide * plane +
                            (j * kBrickSide + n % kBrickSide) * row + k * kBrickSide);
      }
    }
    for (int j = 0; j < layout_.size[1]; ++j)
      for (int k = 0; k < layout_.size[2]; ++k) {
        const std::int32_t brick = blocks[static_cast<std::size_t>(j) * layout_.size[2] + k];
        if (brick == 0) continue;
        for (std::size_t m = 0; m < count; ++m)
          table_.pack(planes.data() + m * map + j * kBrickCells * row + k * kBrickCells, plane, row,
                      values + brick + m * kBrickPoints);
      }
  }

  const FieldTable& table_;
  MapsLayout layout_;
  std::size_t types_, terms_ = 0, entries_ = 0;
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> near_, far_;
  Sources contacts_, shape_;
  std::vector<std::vector<float>> tables_;  // of each term
};

}  // namespace

FilledMaps fill_maps(const FieldTable& table, const MapsLayout& layout, const TypedPoints& fixed,
                     const ContactPotential& potential, const ShapeTerms* shape, int threads) {
  return Filler(table, layout, fixed, potential, shape).fill(threads);
}

}  // namespace mortise::detail
