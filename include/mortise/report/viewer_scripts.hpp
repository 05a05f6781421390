// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Scripts that show the best poses in PyMOL and ChimeraX.
#pragma once

#include <string>
#include <vector>

namespace mortise {

/// What a viewer's script loads, paths relative to the script.
struct ViewerFiles {
  std::string fixed;               ///< the fixed body
  std::vector<std::string> poses;  ///< the moving body at each pose, best first
  bool meshes = false;             ///< STL instead of molecules
};

/// A PyMOL script (.pml): the fixed body as a surface, the poses as cartoons, the best one shown.
[[nodiscard]] std::string pymol_script(const ViewerFiles& files);

/// The same for ChimeraX (.cxc).
[[nodiscard]] std::string chimerax_script(const ViewerFiles& files);

}  // namespace mortise
