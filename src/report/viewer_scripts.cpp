// SPDX-License-Identifier: GPL-3.0-or-later
// PyMOL and ChimeraX scripts for the best poses.
#include "mortise/report/viewer_scripts.hpp"

#include <filesystem>

namespace mortise {
namespace {

// "fixed" alone is a word of PyMOL's selection language. Nor may a comment hold a semicolon.
constexpr const char* kPymolFixed = "fixed_body";

// PyMOL as free software reads no STL: a part becomes a compiled graphics object. The files are
// those of format_stl: binary.
constexpr const char* kLoadStl = R"(python
import struct
from pymol import cgo, cmd

def load_stl(path, name, colour):
    with open(path, 'rb') as file:
        data = file.read()
    made = [cgo.BEGIN, cgo.TRIANGLES, cgo.COLOR, *colour]
    for k in range(struct.unpack_from('<I', data, 80)[0]):
        v = struct.unpack_from('<12f', data, 84 + 50 * k)
        made += [cgo.NORMAL, *v[:3]]
        for c in (3, 6, 9):
            made += [cgo.VERTEX, *v[c:c + 3]]
    cmd.load_cgo(made + [cgo.END], name)

)";

std::string stem(const std::string& path) { return std::filesystem::path(path).stem().string(); }

}  // namespace

std::string pymol_script(const ViewerFiles& files) {
  std::string text =
      "# Best poses, made by Mortise. In this folder: pymol poses.pml\n"
      "# Only the best pose is shown, the list of objects on the right switches the others on.\n";
  if (files.meshes) {
    text += kLoadStl;
    text += "load_stl('" + files.fixed + "', '" + kPymolFixed + "', (0.54, 0.66, 0.80))\n";
    for (const std::string& pose : files.poses)
      text += "load_stl('" + pose + "', '" + stem(pose) + "', (0.91, 0.52, 0.17))\n";
    text += "python end\nset cgo_transparency, 0.4, " + std::string(kPymolFixed) + "\n";
  } else {
    const std::string fixed = kPymolFixed;
    text += "load " + files.fixed + ", " + fixed + "\n";
    for (const std::string& pose : files.poses) text += "load " + pose + ", " + stem(pose) + "\n";
    text += "hide everything\n";
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
    text += "util.cnc\nset surface_color, lightblue, " + fixed + "\n";
  }
  for (std::size_t i = 1; i < files.poses.size(); ++i)
    text += "disable " + stem(files.poses[i]) + "\n";
  text += "bg_color white\n";
  const std::string shown =
      kPymolFixed + (files.poses.empty() ? std::string() : " or " + stem(files.poses.front()));
  if (files.meshes) return text + "set depth_cue, 0\nzoom all, complete=1\n";
  return text + "orient " + shown + "\n";
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
