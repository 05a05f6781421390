// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Channels as 4D point sets: the form of [SD, Sec. 2.2 and 2.5] with nothing compressed.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mortise/kernels/cone.hpp"
#include "search/components.hpp"

namespace mortise {

/// One real product of fields: the moving knots with their cone, and the fixed body's spectrum that
/// they meet.
struct LiftedPart {
  Eigen::Matrix4Xd points;  ///< radius first, then the centre, input frame
  Eigen::VectorXf weights;
  ConeSeries cone;     ///< of the moving transform, for all radii and offsets
  HalfSpectrum fixed;  ///< fixed body's field, times the low-pass and factors
};

struct LiftedParts {
  std::vector<LiftedPart> parts;
  double tolerance = 1e-4;  ///< for the sums over moving knots
};

/// The two real products, Re Re and -Im Im, of every channel. The fixed fields come from a 4D NFFT
/// and the series of the fixed transform's cone.
[[nodiscard]] LiftedParts make_lifted_parts(const std::vector<Channel>& channels,
                                            const RigidMotion& search_from_fixed,
                                            const std::array<int, 3>& size, double spacing,
                                            const ComponentOptions& options);

}  // namespace mortise
