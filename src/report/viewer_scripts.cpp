// SPDX-License-Identifier: GPL-3.0-or-later
// PyMOL and ChimeraX scripts for the best poses.
#include "mortise/report/viewer_scripts.hpp"

#include <filesystem>

namespace mortise {
namespace {

std::string stem(const std::string& path) { return std::filesystem::path(path).stem().string(); }

}  // namespace

std::string pymol_script(const ViewerFiles& files) {
  std::string text =
      "# Best poses, made by Mortise. In this folder: pymol poses.pml\n"
      "# Only the best pose is shown; the list of objects on the right switches the others on.\n";
  const std::string fixed = stem(files.fixed);
  text += "load " + files.fixed + ", " + fixed + "\n";
  for (const std::string& pose : files.poses) text += "load " + pose + ", " + stem(pose) + "\n";
  text += "hide everything\n";
  if (files.meshes) {
    text += "show cgo\n";  // PyMOL reads STL as a compiled object with its own colours
  } else {
    text += "show cartoon, polymer\nshow sticks, organic\nshow nonbonded\n";
    text += "show surface, " + fixed + "\n";
    text += "set transparency, 0.25, " + fixed + "\n";
    text += "color lightblue, " + fixed + "\n";
    for (const std::string& pose : files.poses) text += "color orange, " + stem(pose) + "\n";
    if (!files.poses.empty()) {
      const std::string best = stem(files.poses.front());
      text += "select interface, byres ((" + fixed + " within 5 of " + best + ") or (" + best +
              " within 5 of " + fixed + "))\nshow sticks, interface\ndeselect\n";
    }
    text += "util.cnc\n";
  }
  for (std::size_t i = 1; i < files.poses.size(); ++i)
    text += "disable " + stem(files.poses[i]) + "\n";
  return text + "bg_color white\norient\n";
}

std::string chimerax_script(const ViewerFiles& files) {
  std::string text =
      "# Best poses, made by Mortise. Open this file in ChimeraX; only the best pose is shown,\n"
      "# the model panel switches the others on.\n";
  text += "open " + files.fixed + "\n";
  for (const std::string& pose : files.poses) text += "open " + pose + "\n";
  const std::string last = std::to_string(files.poses.size() + 1);
  if (files.meshes) {
    text += "color #1 #8aa6c6 transparency 40\n";
    if (!files.poses.empty()) text += "color #2-" + last + " #e08a3f\n";
  } else {
    text += "hide atoms\ncartoon\nsurface #1\ncolor #1 #8aa6c6\ntransparency #1 25 target s\n";
    if (!files.poses.empty()) {
      text += "color #2-" + last + " #e08a3f\n";
      text += "show (#1 :<5 & #2) | (#2 :<5 & #1) atoms\n";
      text += "color byhetero\n";
    }
  }
  if (files.poses.size() > 1) text += "hide #3-" + last + " models\n";
  return text + "set bgColor white\nlighting soft\nview\n";
}

}  // namespace mortise
