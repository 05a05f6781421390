// SPDX-License-Identifier: GPL-3.0-or-later
// Reading, writing and counting a benchmark's tables.
#include <algorithm>
#include <boost/math/statistics/univariate_statistics.hpp>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "mortise/core/errors.hpp"
#include "mortise/runs/benchmark.hpp"
#include "mortise/runs/run_kind.hpp"
#include "mortise/store/atomic_file.hpp"
#include "mortise/store/csv.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPairsHeader =
    "name,unbound_interface_rmsd,fixed,moving,reference_fixed,reference_moving";
constexpr const char* kOptionsMark = "# mortise benchmark ";

std::string header() {
  std::string text;
  for (const char* column : kResultColumns) text += (text.empty() ? "" : ",") + std::string(column);
  return text;
}

// Lines without their ends, blank ones included.
std::vector<std::string> lines_of(const std::string& path) {
  std::istringstream text(read_whole_file(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    lines.push_back(line);
  }
  return lines;
}

std::optional<double> number(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

std::size_t column_index(const std::string& column) {
  const auto* const found = std::find(kResultColumns.begin(), kResultColumns.end(), column);
  if (found == kResultColumns.end()) throw std::logic_error("no column " + column);
  return static_cast<std::size_t>(found - kResultColumns.begin());
}

BenchmarkPair parse_pair(const std::string& path, long at, const std::string& line) {
  const std::vector<std::string> cells = csv_cells(line);
  if (cells.size() != 6)
    throw FileError(path, at, "expected 6 cells, found " + std::to_string(cells.size()));
  const std::string& name = cells[0];
  if (name.empty() || name.front() == '.' || name.find('/') != std::string::npos)
    throw FileError(path, at,
                    "expected a pair's name that can be a file's, found \"" + name + "\"");
  const std::optional<double> rmsd = number(cells[1]);
  if (!rmsd || *rmsd < 0.0)
    throw FileError(path, at,
                    "unbound_interface_rmsd: expected a number >= 0, found \"" + cells[1] + "\"");
  const auto beside = [&](const std::string& file) {
    return (fs::path(path).parent_path() / file).string();
  };
  return {name, *rmsd, beside(cells[2]), beside(cells[3]), beside(cells[4]), beside(cells[5])};
}

}  // namespace

std::vector<BenchmarkPair> read_benchmark_pairs(const std::string& path) {
  const std::vector<std::string> lines = lines_of(path);
  if (lines.empty() || lines.front() != kPairsHeader)
    throw FileError(path, 1, std::string("expected the header ") + kPairsHeader);
  std::vector<BenchmarkPair> pairs;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (lines[i].empty()) continue;
    const auto at = static_cast<long>(i) + 1;
    pairs.push_back(parse_pair(path, at, lines[i]));
    for (std::size_t k = 0; k + 1 < pairs.size(); ++k)
      if (pairs[k].name == pairs.back().name)
        throw FileError(path, at, "pair " + pairs[k].name + " is there twice");
  }
  if (pairs.empty()) throw FileError(path, "expected at least one pair, found none");
  return pairs;
}

std::string difficulty(double unbound_interface_rmsd) {
  if (unbound_interface_rmsd < 1.5) return "easy";
  return unbound_interface_rmsd > 2.2 ? "hard" : "medium";
}

std::string& ResultRow::operator[](const std::string& column) {
  return cells[column_index(column)];
}
const std::string& ResultRow::operator[](const std::string& column) const {
  return cells[column_index(column)];
}

std::string csv_line(const ResultRow& row) {
  std::string text;
  for (std::size_t i = 0; i < row.cells.size(); ++i)
    text += (i == 0 ? "" : ",") + csv_field(row.cells[i]);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

ResultRow parse_result_row(const std::string& line) {
  std::vector<std::string> cells = csv_cells(line);
  ResultRow row;
  if (cells.size() != row.cells.size())
    throw InputError("expected " + std::to_string(row.cells.size()) + " cells, found " +
                     std::to_string(cells.size()));
  std::move(cells.begin(), cells.end(), row.cells.begin());
  return row;
}

std::vector<ResultRow> read_results(const std::string& path, const std::string& options) {
  using Json = nlohmann::ordered_json;
  if (!fs::exists(path)) return {};
  const std::vector<std::string> lines = lines_of(path);
  const std::string mark = kOptionsMark;
  if (lines.size() < 2 || lines[0].compare(0, mark.size(), mark) != 0 || lines[1] != header())
    throw FileError(path, "expected a file that mortise benchmark wrote (--force replaces it)");
  const Json recorded = Json::parse(lines[0].substr(mark.size()), nullptr, false);
  if (!recorded.is_object()) throw FileError(path, 1, "expected the options as a JSON object");
  expect_same_options(recorded.dump(), options, path);
  std::vector<ResultRow> rows;
  for (std::size_t i = 2; i < lines.size(); ++i) {
    try {
      if (!lines[i].empty()) rows.push_back(parse_result_row(lines[i]));
    } catch (const InputError& e) {
      throw FileError(path, static_cast<long>(i) + 1, e.what());
    }
  }
  return rows;
}

void write_results(const std::string& path, const std::string& options,
                   const std::vector<ResultRow>& rows) {
  std::string text = kOptionsMark + options + "\n" + header() + "\n";
  for (const ResultRow& row : rows) text += csv_line(row) + "\n";
  write_file_atomically(path, text);
}

std::vector<SuccessCount> count_successes(const std::vector<ResultRow>& rows) {
  constexpr std::pair<const char*, const char*> kCriteria[] = {
      {"acceptable", "first_acceptable"},
      {"acceptable_by_rmsd", "first_acceptable_by_rmsd"},
      {"irmsd_2_5", "first_irmsd_2_5"},
      {"medium", "first_medium"}};
  std::vector<SuccessCount> counts;
  for (const char* cls : {"all", "easy", "medium", "hard"}) {
    for (const auto& [criterion, column] : kCriteria) {
      SuccessCount count;
      count.difficulty = cls;
      count.criterion = criterion;
      std::vector<double> seconds;
      for (const ResultRow& row : rows) {
        if (count.difficulty != "all" && row["difficulty"] != count.difficulty) continue;
        ++count.pairs;
        if (!row["error"].empty()) {
          ++count.failed;
          continue;
        }
        if (const std::optional<double> s = number(row["seconds"])) seconds.push_back(*s);
        const std::optional<double> first = number(row[column]);
        for (std::size_t k = 0; k < kSuccessRanks.size(); ++k)
          if (first && *first <= kSuccessRanks[k]) ++count.successes[k];
      }
      if (count.pairs == 0) continue;
      if (!seconds.empty()) count.median_seconds = boost::math::statistics::median(seconds);
      counts.push_back(count);
    }
  }
  return counts;
}

std::string success_csv(const std::vector<SuccessCount>& counts) {
  std::ostringstream text;
  text << "difficulty,criterion,pairs,failed";
  for (const int rank : kSuccessRanks) text << ",top_" << rank;
  text << ",median_seconds\n";
  for (const SuccessCount& count : counts) {
    text << count.difficulty << ',' << count.criterion << ',' << count.pairs << ',' << count.failed;
    for (const int successes : count.successes) text << ',' << successes;
    text << ',';
    if (count.median_seconds) text << *count.median_seconds;
    text << '\n';
  }
  return text.str();
}

std::string success_text(const std::vector<SuccessCount>& counts) {
  char line[160];
  std::snprintf(line, sizeof line, "%-8s %-20s %6s", "class", "pairs with a pose", "pairs");
  std::string text = line;
  for (const int rank : kSuccessRanks) {
    std::snprintf(line, sizeof line, " %8s", ("top " + std::to_string(rank)).c_str());
    text += line;
  }
  text += "  median s\n";
  for (const SuccessCount& count : counts) {
    std::snprintf(line, sizeof line, "%-8s %-20s %6d", count.difficulty.c_str(),
                  count.criterion.c_str(), count.pairs);
    text += line;
    for (const int successes : count.successes) {
      std::snprintf(line, sizeof line, " %8d", successes);
      text += line;
    }
    if (count.median_seconds) {
      std::snprintf(line, sizeof line, " %9.2f", *count.median_seconds);
      text += line;
    }
    text += "\n";
  }
  return text;
}

}  // namespace mortise
