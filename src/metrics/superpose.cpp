// SPDX-License-Identifier: GPL-3.0-or-later
// Horn's superposition on top of the paired moments.
#include "mortise/metrics/superpose.hpp"

#include <cmath>
#include <string>

#include "core/paired_moments.hpp"
#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

void check_pairs(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b, const char* who) {
  if (a.cols() != b.cols() || a.cols() == 0)
    throw InputError(std::string(who) + ": expected two equally large sets of points, got " +
                     std::to_string(a.cols()) + " and " + std::to_string(b.cols()));
  if (!a.allFinite() || !b.allFinite())
    throw InputError(std::string(who) + ": expected finite coordinates, got one that is not");
}

}  // namespace

Superposition superpose(const Eigen::Matrix3Xd& model, const Eigen::Matrix3Xd& reference) {
  check_pairs(model, reference, "superpose");
  const detail::PairedMoments moments = detail::paired_moments(model, reference);
  Superposition out;
  out.motion.rotation = canonical(detail::best_rotation(moments));
  out.motion.translation = moments.reference_mean - out.motion.rotation * moments.model_mean;
  out.rmsd = rmsd(out.motion * model, reference);  // from the points: exact near zero
  return out;
}

double rmsd(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  check_pairs(a, b, "rmsd");
  return std::sqrt((a - b).squaredNorm() / static_cast<double>(a.cols()));
}

}  // namespace mortise
