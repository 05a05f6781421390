// SPDX-License-Identifier: GPL-3.0-or-later
// The STEP module: what the library asks of OpenCASCADE. Files are read in a child process: damaged
// ones crash OpenCASCADE 7.6.
#include <Standard_Failure.hxx>
#include <array>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <stdexcept>

#include "mortise/core/errors.hpp"
#include "parts/step/brep.hpp"
#include "parts/step/guarded.hpp"

namespace mortise {
namespace {

/// Values one after another; both ends are the same program.
class Packed {
 public:
  Packed() = default;
  explicit Packed(std::string bytes) : bytes_(std::move(bytes)) {}

  template <class T>
  void put(const T* values, Eigen::Index count) {
    bytes_.append(reinterpret_cast<const char*>(values),
                  sizeof(T) * static_cast<std::size_t>(count));
  }
  template <class T>
  void take(T* values, Eigen::Index count) {
    const std::size_t size = sizeof(T) * static_cast<std::size_t>(count);
    if (bytes_.size() - at_ < size)
      throw std::runtime_error("STEP module: its child sent too little");
    if (size > 0) std::memcpy(values, bytes_.data() + at_, size);
    at_ += size;
  }
  [[nodiscard]] std::string& bytes() { return bytes_; }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

/// Processor time that a file of this size may take: a minute and a minute per megabyte.
unsigned seconds_for(const std::string& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  return 60 + (error ? 0U : static_cast<unsigned>(std::min<std::uintmax_t>(size >> 20, 1000)) * 60);
}

StepKernel::Tessellation tessellation_of(const std::string& path, const Fineness& fineness,
                                         bool relative) {
  const brep::UnitShape part = brep::read(path);
  StepKernel::Tessellation result;
  result.unit = part.unit;
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

class OcctKernel final : public StepKernel {
 public:
  Tessellation tessellate(const std::string& path, const Fineness& fineness,
                          bool relative) const override {
    Packed packed(guarded(path, seconds_for(path), [&] {
      const Tessellation result = tessellation_of(path, fineness, relative);
      Packed pack;
      const std::array<Eigen::Index, 3> sizes = {static_cast<Eigen::Index>(result.unit.size()),
                                                 result.soup.vertices.cols(), result.soup.size()};
      pack.put(sizes.data(), 3);
      pack.put(result.unit.data(), sizes[0]);
      pack.put(&result.deviation, 1);
      pack.put(result.soup.vertices.data(), 3 * sizes[1]);
      pack.put(result.soup.triangles.data(), 3 * sizes[2]);
      return std::move(pack.bytes());
    }));
    Tessellation result;
    std::array<Eigen::Index, 3> sizes = {0, 0, 0};
    packed.take(sizes.data(), 3);
    result.unit.resize(static_cast<std::size_t>(sizes[0]));
    packed.take(result.unit.data(), sizes[0]);
    packed.take(&result.deviation, 1);
    result.soup.vertices.resize(3, sizes[1]);
    result.soup.triangles.resize(3, sizes[2]);
    packed.take(result.soup.vertices.data(), 3 * sizes[1]);
    packed.take(result.soup.triangles.data(), 3 * sizes[2]);
    return result;
  }

  std::string moved(const std::string& path, const RigidMotion& motion) const override {
    return guarded(path, seconds_for(path), [&] {
      brep::UnitShape part = brep::read(path);
      RigidMotion in_millimetres = motion;
      in_millimetres.translation *= part.millimetres;
      try {
        part.shape = brep::moved(part.shape, in_millimetres);
      } catch (const Standard_Failure& failure) {
        throw FileError(path, std::string("cannot be moved: ") + failure.GetMessageString());
      }
      return brep::to_step(part);
    });
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
