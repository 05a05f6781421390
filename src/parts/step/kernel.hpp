// SPDX-License-Identifier: GPL-3.0-or-later
// What the library asks of the STEP module, which is loaded when the first STEP file is met.
#pragma once

#include <string>

#include "mortise/core/rigid_motion.hpp"
#include "mortise/parts/triangle_mesh.hpp"

namespace mortise {

/// How fine a tessellation is.
struct Fineness {
  double deviation = 0.0;  ///< largest distance from surface to triangles, unit of the file; > 0
  double angle = 0.5;      ///< largest turn of the normal between neighbours, radians
  double smallest = 0.0;   ///< no edge is split below this length, unit of the file
};

/// Reads, moves and writes boundary representations. Safe to call from several threads at once.
class StepKernel {
 public:
  virtual ~StepKernel() = default;

  struct Tessellation {
    TriangleMesh soup;       ///< triangles by face: what faces share is not merged yet
    std::string unit;        ///< "mm", "m", "in", ...; the unit of the coordinates
    double deviation = 0.0;  ///< the one used, unit of the file
  };

  /// @param relative  deviation in `fineness` is a part of the diagonal of the bounding box
  /// @throws FileError if the file holds no STEP shape
  [[nodiscard]] virtual Tessellation tessellate(const std::string& path, const Fineness& fineness,
                                                bool relative) const = 0;
  /// The bytes of a STEP file with the shapes of `path` moved; its unit is kept.
  [[nodiscard]] virtual std::string moved(const std::string& path,
                                          const RigidMotion& motion) const = 0;
  /// The bytes of a STEP file with one planar face per triangle.
  [[nodiscard]] virtual std::string faceted(const TriangleMesh& mesh,
                                            const std::string& unit) const = 0;

 protected:
  StepKernel() = default;
  StepKernel(const StepKernel&) = default;
  StepKernel& operator=(const StepKernel&) = default;
};

/// The module's one entry: a kernel that lives as long as the program.
using StepKernelEntry = const StepKernel* (*)();
constexpr const char* kStepKernelEntry = "mortise_step_kernel";

}  // namespace mortise
