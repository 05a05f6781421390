// SPDX-License-Identifier: GPL-3.0-or-later
// Writes SVG by hand: a frame, three ticks and a polyline per curve need no library.
#include "line_plot.hpp"

#include <algorithm>
#include <cstdio>
#include <sstream>

#include "mortise/store/atomic_file.hpp"

namespace mortise::app {
namespace {

constexpr int kLeft = 80, kWidth = 800, kHeight = 120, kGap = 34, kTop = 20;
constexpr const char* kColours[] = {"#1f3b4d", "#d1495b", "#66a182"};

std::string number(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", v);
  return text;
}

// Least and largest value of each pixel column, as one line up and down.
std::string outline(const std::vector<double>& values, double low, double high, int top) {
  std::string points;
  const std::size_t count = values.size();
  for (int column = 0; column < kWidth; ++column) {
    const std::size_t first = count * static_cast<std::size_t>(column) / kWidth;
    const std::size_t last =
        std::max(first + 1, count * static_cast<std::size_t>(column + 1) / kWidth);
    if (first >= count) break;
    const auto [least, most] =
        std::minmax_element(values.begin() + static_cast<std::ptrdiff_t>(first),
                            values.begin() + static_cast<std::ptrdiff_t>(std::min(last, count)));
    for (const double v : {*least, *most}) {
      char text[48];
      std::snprintf(text, sizeof text, "%d,%.1f ", kLeft + column,
                    top + kHeight * (1.0 - (v - low) / (high - low)));
      points += text;
    }
  }
  return points;
}

}  // namespace

void write_line_plot(const std::string& path, const std::string& x_title,
                     const std::vector<double>& x, const std::vector<PlotPanel>& panels) {
  const int bottom = kTop + static_cast<int>(panels.size()) * (kHeight + kGap);
  std::ostringstream file;
  file << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << kLeft + kWidth + 20
       << "\" height=\"" << bottom + 20 << "\" font-family=\"sans-serif\" font-size=\"11\">\n"
       << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  int top = kTop;
  for (const PlotPanel& panel : panels) {
    double low = 0.0, high = 0.0;
    for (const PlotLine& line : panel.lines)
      for (const double v : line.values) low = std::min(low, v), high = std::max(high, v);
    if (!(high > low)) high = low + 1.0;
    file << "<rect x=\"" << kLeft << "\" y=\"" << top << "\" width=\"" << kWidth << "\" height=\""
         << kHeight << "\" fill=\"none\" stroke=\"#bbb\"/>\n<text x=\"" << kLeft << "\" y=\""
         << top - 5 << "\">" << panel.title << "</text>\n";
    for (const double v : {low, 0.5 * (low + high), high})
      file << "<text x=\"" << kLeft - 6 << "\" y=\""
           << static_cast<double>(top) + kHeight * (1.0 - (v - low) / (high - low)) + 4.0
           << "\" text-anchor=\"end\">" << number(v) << "</text>\n";
    for (std::size_t i = 0; i < panel.lines.size(); ++i) {
      const char* colour = kColours[i % 3];
      file << "<polyline fill=\"none\" stroke=\"" << colour << "\" stroke-width=\"0.8\" points=\""
           << outline(panel.lines[i].values, low, high, top) << "\"/>\n<text x=\""
           << kLeft + kWidth - 14 * static_cast<int>(panel.lines.size() - i) << "\" y=\"" << top - 5
           << "\" fill=\"" << colour << "\">" << panel.lines[i].name << "</text>\n";
    }
    top += kHeight + kGap;
  }
  if (!x.empty())
    for (const double share : {0.0, 0.5, 1.0})
      file << "<text x=\"" << kLeft + share * kWidth << "\" y=\"" << bottom - kGap + 14
           << "\" text-anchor=\"middle\">" << number(x.front() + share * (x.back() - x.front()))
           << "</text>\n";
  file << "<text x=\"" << kLeft + kWidth / 2 << "\" y=\"" << bottom << "\" text-anchor=\"middle\">"
       << x_title << "</text>\n</svg>\n";
  write_file_atomically(path, file.str());
}

}  // namespace mortise::app
