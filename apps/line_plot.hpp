// SPDX-License-Identifier: GPL-3.0-or-later
// Line plots as SVG.
#pragma once

#include <string>
#include <vector>

namespace mortise::app {

struct PlotLine {
  std::string name;
  std::vector<double> values;
};
struct PlotPanel {
  std::string title;
  std::vector<PlotLine> lines;
};

/// Panels above each other over one axis; each line is drawn as the range of its values per pixel.
/// @throws FileError if the file cannot be written
void write_line_plot(const std::string& path, const std::string& x_title,
                     const std::vector<double>& x, const std::vector<PlotPanel>& panels);

}  // namespace mortise::app
