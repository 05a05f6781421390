// SPDX-License-Identifier: GPL-3.0-or-later
// From a file to a repaired mesh.
#include "mortise/parts/read_part.hpp"

#include <algorithm>

#include "mortise/core/errors.hpp"
#include "parts/mesh_files.hpp"
#include "parts/step/load_kernel.hpp"

namespace mortise {
namespace {

void check(const ReadPartOptions& options) {
  const auto require = [](bool good, const char* name, const char* range, double value) {
    if (!good)
      throw InputError(std::string("read_part: ") + name + " must be " + range + ", got " +
                       std::to_string(value));
  };
  require(options.deviation > 0.0 && options.deviation < 1.0, "deviation", "in (0, 1)",
          options.deviation);
  require(options.absolute_deviation >= 0.0, "absolute_deviation", ">= 0",
          options.absolute_deviation);
  require(options.angle > 0.0 && options.angle < 3.0, "angle", "in (0, 3)", options.angle);
}

}  // namespace

ReadPartResult read_part(const std::string& path, const ReadPartOptions& options) {
  check(options);
  ReadPartResult result;
  TriangleMesh soup;
  {
    const std::string bytes = parts::read_bytes(path);
    switch (parts::detect_format(path, bytes)) {
      case parts::MeshFormat::kStlAscii:
        soup = parts::read_stl_ascii(path, bytes);
        break;
      case parts::MeshFormat::kStlBinary:
        soup = parts::read_stl_binary(path, bytes, result.decisions);
        break;
      case parts::MeshFormat::kObj:
        soup = parts::triangulate(path, parts::read_obj(path, bytes), result.decisions);
        break;
      case parts::MeshFormat::kPly:
        soup = parts::triangulate(path, parts::read_ply(path, bytes), result.decisions);
        break;
      case parts::MeshFormat::kOff:
        soup = parts::triangulate(path, parts::read_off(path, bytes), result.decisions);
        break;
      case parts::MeshFormat::kStep: {
        const bool relative = options.absolute_deviation == 0.0;
        auto step = load_step_kernel().tessellate(
            path, {relative ? options.deviation : options.absolute_deviation, options.angle},
            relative);
        soup = std::move(step.soup);
        result.unit = step.unit;
        result.deviation = step.deviation;
        break;
      }
    }
  }
  try {
    RepairResult repaired = repair_mesh(soup, options.repair);
    result.mesh = std::move(repaired.mesh);
    result.closed = repaired.closed;
    result.volume = repaired.volume;
    result.decisions.insert(result.decisions.end(), repaired.decisions.begin(),
                            repaired.decisions.end());
  } catch (const FileError&) {
    throw;
  } catch (const InputError& error) {
    throw FileError(path, error.what());
  }
  return result;
}

}  // namespace mortise
