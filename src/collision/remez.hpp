// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Remez's exchange for cosine sums that approximate 1 on one band and 0 on another.
#pragma once

#include <Eigen/Core>

namespace mortise {

struct RemezResult {
  Eigen::VectorXd cosines;  ///< sum_k cosines[k] cos(k theta), k = 0 .. degree
  double ripple = 0.0;      ///< largest error on both bands
  double levelled = 0.0;    ///< the error at the last reference: <= the best possible ripple
};

/// The cosine sum of this degree nearest, in the maximum norm, to 1 on [0, pass] and 0 on [stop,
/// pi] [Parks and McClellan 1972]; 0 < pass < stop < pi. Of best possible ripple to a percent.
[[nodiscard]] RemezResult remez(int degree, double pass, double stop);

}  // namespace mortise
