// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The molecular (solvent-excluded) surface as dots: what a rolling probe cannot enter.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace mortise {

/// What of the molecular surface a dot lies on.
enum class SurfacePatch : std::uint8_t {
  kContact,   ///< an atom's own sphere, where the probe can touch it
  kToroidal,  ///< swept by a probe that rolls in touch with two atoms
  kConcave,   ///< of a probe that rests on three atoms
};

struct SurfaceDots {
  Eigen::Matrix3Xd positions;         ///< 3 x N, frame and length unit of the centres
  Eigen::Matrix3Xd normals;           ///< 3 x N unit vectors, outward; the probe's centre lies at
                                      ///< position + probe_radius normal
  Eigen::VectorXd areas;              ///< N: surface each dot stands for, length unit squared
  std::vector<std::int32_t> atoms;    ///< N: an atom the probe touches there; rising
  std::vector<SurfacePatch> patches;  ///< N

  [[nodiscard]] Eigen::Index size() const noexcept { return areas.size(); }
};

struct MolecularSurfaceOptions {
  double probe_radius = 1.7;  ///< length unit; > 0. Lawrence and Colman's
  double density = 15.0;      ///< dots per unit of area; > 0. Lawrence and Colman's
  int threads = 1;            ///< 0 = all cores; never changes the result
};

/// Dots on the surface of all space that no probe ball outside the atoms' balls can reach: contact,
/// toroidal and concave patches (M. L. Connolly, J. Appl. Cryst. 16 (1983) 548-558). Derivation in
/// docs/math.md.
///
/// Areas of toroidal patches are exact, and of concave ones unless they run into each other; those
/// of contact patches are counted. A patch's area is spread over its dots, at least one. Cavities
/// have a surface too, if a probe fits in.
///
/// @param centres  3 x N
/// @param radii    N radii >= 0
/// @throws InputError if the counts differ, a value is not finite, a radius is negative or an
/// option out of range. Time O(N neighbours^2), memory O(dots).
[[nodiscard]] SurfaceDots molecular_surface(const Eigen::Matrix3Xd& centres,
                                            const Eigen::VectorXd& radii,
                                            const MolecularSurfaceOptions& options = {});

}  // namespace mortise
