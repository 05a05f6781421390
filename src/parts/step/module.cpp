// SPDX-License-Identifier: GPL-3.0-or-later
// The STEP module: what the library asks of OpenCASCADE, one call at a time.
#include <Standard_Failure.hxx>
#include <mutex>

#include "mortise/core/errors.hpp"
#include "parts/step/brep.hpp"

namespace mortise {
namespace {

class OcctKernel final : public StepKernel {
 public:
  Tessellation tessellate(const std::string& path, const Fineness& fineness,
                          bool relative) const override {
    const std::lock_guard lock(mutex_);
    const brep::UnitShape part = brep::read(path);
    Tessellation result;
    result.unit = part.unit;
    result.has_solid = brep::has_solid(part.shape);
    Fineness in_millimetres = fineness;
    in_millimetres.deviation *= relative ? brep::diagonal(part.shape) : part.millimetres;
    result.deviation = in_millimetres.deviation / part.millimetres;
    if (!(in_millimetres.deviation > 0.0))
      throw FileError(path, "expected a solid, found a shape without size");
    try {
      result.soup = brep::tessellate(part.shape, in_millimetres);
    } catch (const Standard_Failure& failure) {
      throw FileError(path, std::string("tessellation fails: ") + failure.GetMessageString());
    }
    result.soup.vertices /= part.millimetres;
    return result;
  }

  std::string moved(const std::string& path, const RigidMotion& motion) const override {
    const std::lock_guard lock(mutex_);
    brep::UnitShape part = brep::read(path);
    RigidMotion in_millimetres = motion;
    in_millimetres.translation *= part.millimetres;
    try {
      part.shape = brep::moved(part.shape, in_millimetres);
    } catch (const Standard_Failure& failure) {
      throw FileError(path, std::string("cannot be moved: ") + failure.GetMessageString());
    }
    return brep::to_step(part);
  }

  std::string faceted(const TriangleMesh& mesh, const std::string& unit) const override {
    const std::lock_guard lock(mutex_);
    brep::UnitShape part;
    part.unit = unit;
    part.millimetres = brep::millimetres_per(unit);
    TriangleMesh scaled = mesh;
    scaled.vertices *= part.millimetres;
    try {
      part.shape = brep::faceted(scaled);
    } catch (const Standard_Failure& failure) {
      throw InputError(std::string("format_step: ") + failure.GetMessageString());
    }
    return brep::to_step(part);
  }

 private:
  mutable std::mutex mutex_;  // OpenCASCADE's STEP options are global
};

}  // namespace
}  // namespace mortise

extern "C" __attribute__((visibility("default"))) const mortise::StepKernel* mortise_step_kernel() {
  static const mortise::OcctKernel kernel;
  return &kernel;
}
