// SPDX-License-Identifier: GPL-3.0-or-later
// All pairs of balls, written once, at the speed of memory.
#include "mortise/collision/minkowski.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#ifdef __linux__
#include <sys/mman.h>
#endif

#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"

namespace mortise {
namespace {

void check_balls(const Eigen::Matrix4Xd& balls, const char* who) {
  if (!balls.allFinite())
    throw InputError(std::string(who) + ": expected finite centres and radii");
  if (balls.cols() > 0 && balls.row(3).minCoeff() < 0.0)
    throw InputError(std::string(who) + ": radii must be >= 0, got " +
                     std::to_string(balls.row(3).minCoeff()));
}

// Balls of one first factor that a negative offset leaves: those with r_i + s_j + offset > 0.
Balls kept(const Balls& balls) {
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < balls.cols(); ++i) count += balls(3, i) > 0.0F ? 1 : 0;
  Balls result(4, count);
  Eigen::Index at = 0;
  for (Eigen::Index i = 0; i < balls.cols(); ++i)
    if (balls(3, i) > 0.0F) result.col(at++) = balls.col(i);
  return result;
}

// Asks for pages of 2 MB: half of the time of writing 64 MB for the first time is spent on page
// faults otherwise. Only advice: what happens without it is the same.
void advise_large_pages([[maybe_unused]] Balls& balls) {
#ifdef __linux__
  constexpr std::size_t kPage = std::size_t{1} << 21;
  const std::size_t bytes = static_cast<std::size_t>(balls.size()) * sizeof(float);
  auto* begin = reinterpret_cast<char*>(balls.data());
  const std::size_t skip = (kPage - reinterpret_cast<std::uintptr_t>(begin) % kPage) % kPage;
  if (bytes > skip + kPage) madvise(begin + skip, (bytes - skip) / kPage * kPage, MADV_HUGEPAGE);
#endif
}

// Pair (i, j) is one sum of four numbers.
Balls all_pairs(const Eigen::Matrix4Xd& a, const Eigen::Matrix4Xd& b,
                const MinkowskiOptions& options, const char* who) {
  check_balls(a, who);
  check_balls(b, who);
  if (!std::isfinite(options.offset))
    throw InputError(std::string(who) + ": offset must be finite");
  constexpr Eigen::Index kMost = std::numeric_limits<std::int32_t>::max();
  if (b.cols() > 0 && a.cols() > kMost / b.cols())
    throw InputError(std::string(who) + ": " + std::to_string(a.cols()) + " x " +
                     std::to_string(b.cols()) + " balls, expected at most 2^31 pairs");
  Eigen::Matrix4Xd lifted = a;
  lifted.row(3).array() += options.offset;
  const Balls first = lifted.cast<float>();
  const Balls second = b.cast<float>();
  Balls result(4,
               a.cols() * b.cols());  // not initialised: each page is first touched by its writer
  advise_large_pages(result);
  constexpr Eigen::Index kPairs = 1 << 16;
  const Eigen::Index rows = b.cols() > 0 ? std::max<Eigen::Index>(1, kPairs / b.cols()) : 1;
  const Eigen::Index blocks = (a.cols() + rows - 1) / rows;
  parallel_for(static_cast<std::size_t>(blocks), options.threads, [&](std::size_t block, int) {
    const Eigen::Index from = static_cast<Eigen::Index>(block) * rows;
    const Eigen::Index to = std::min(a.cols(), from + rows);
    for (Eigen::Index i = from; i < to; ++i) {
      const Eigen::Vector4f shift = first.col(i);
      for (Eigen::Index j = 0; j < b.cols(); ++j)
        result.col(i * b.cols() + j) = second.col(j) + shift;
    }
  });
  return options.offset < 0.0 ? kept(result) : result;
}

}  // namespace

Balls minkowski_sum(const Eigen::Matrix4Xd& a, const Eigen::Matrix4Xd& b,
                    const MinkowskiOptions& options) {
  return all_pairs(a, b, options, "minkowski_sum");
}

Balls translational_obstacle(const Eigen::Matrix4Xd& fixed, const Eigen::Matrix4Xd& moving,
                             const Eigen::Quaterniond& rotation, const MinkowskiOptions& options) {
  if (!(std::abs(rotation.norm() - 1.0) < 1e-6))
    throw InputError("translational_obstacle: rotation must be a unit quaternion, its norm is " +
                     std::to_string(rotation.norm()));
  Eigen::Matrix4Xd mirrored = moving;
  mirrored.topRows<3>() = -(rotation.toRotationMatrix() * moving.topRows<3>());
  return all_pairs(fixed, mirrored, options, "translational_obstacle");
}

}  // namespace mortise
