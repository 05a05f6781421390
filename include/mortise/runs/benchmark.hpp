// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A set of known complexes, docked: its pairs, rows of results, the file they are kept in, and the
/// counts of successes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mortise/runs/dock.hpp"

namespace mortise {

/// One known complex of the benchmark's table; files with model and chains, as read_molecule takes
/// them.
struct BenchmarkPair {
  std::string name;
  double unbound_interface_rmsd = 0.0;  ///< of the superposed unbound bodies, angstrom
  std::string fixed, moving, reference_fixed, reference_moving;
};

/// Reads a table with the header name,unbound_interface_rmsd,fixed,moving,reference_fixed,
/// reference_moving; its paths count from the table's folder.
/// @throws FileError with the line
[[nodiscard]] std::vector<BenchmarkPair> read_benchmark_pairs(const std::string& path);

/// "easy" below 1.5 angstrom, "hard" above 2.2, else "medium".
[[nodiscard]] std::string difficulty(double unbound_interface_rmsd);

/// Columns of the file of results; a row has one text for each.
inline constexpr std::array<const char*, 19> kResultColumns = {"name",
                                                               "difficulty",
                                                               "unbound_interface_rmsd",
                                                               "first_acceptable",
                                                               "first_acceptable_by_rmsd",
                                                               "first_irmsd_2_5",
                                                               "first_medium",
                                                               "first_high",
                                                               "best_interface_rmsd",
                                                               "best_ligand_rmsd",
                                                               "best_fnat",
                                                               "best_dockq",
                                                               "superposed_interface_rmsd",
                                                               "rotations",
                                                               "poses",
                                                               "seconds",
                                                               "cpu_seconds",
                                                               "peak_memory_mb",
                                                               "error"};

struct ResultRow {
  std::array<std::string, kResultColumns.size()> cells;  ///< empty = absent

  /// @param column  one of kResultColumns
  [[nodiscard]] std::string& operator[](const std::string& column);
  [[nodiscard]] const std::string& operator[](const std::string& column) const;
};

/// The row of a pair before it is docked: name, difficulty.
[[nodiscard]] ResultRow result_row(const BenchmarkPair& pair);

/// A pair docked from a random start and measured against its reference.
struct BenchmarkResult {
  Run run;  ///< with its metrics as columns; not complete if `watch` stopped it
  ResultRow row;
};

/// @param docking  its random_start is replaced by the pair's own: a seed made of `seed` and the
/// pair's name, whatever else is in the table
/// @throws InputError if a body is no molecule; as read_body(), plan_dock() and ReferenceComplex
[[nodiscard]] BenchmarkResult dock_known_pair(const BenchmarkPair& pair, DockOptions docking,
                                              std::uint64_t seed, const std::string& command_line,
                                              const RunWatch& watch = {});

/// One line without its end, and back. @throws InputError unless it has a cell for every column
[[nodiscard]] std::string csv_line(const ResultRow& row);
[[nodiscard]] ResultRow parse_result_row(const std::string& line);

/// The rows kept in a file of results, in its order; none if there is no file.
/// @param options  JSON object that the file's first line must hold
/// @throws InputError naming the first option that differs; FileError if it is no such file
[[nodiscard]] std::vector<ResultRow> read_results(const std::string& path,
                                                  const std::string& options);

/// Writes all rows in one step.
void write_results(const std::string& path, const std::string& options,
                   const std::vector<ResultRow>& rows);

inline constexpr std::array<int, 6> kSuccessRanks = {1, 5, 10, 100, 1000, 2000};

/// How many pairs of a class have a pose that meets a criterion among the first so many.
struct SuccessCount {
  std::string difficulty;  ///< "all", "easy", "medium" or "hard"
  std::string criterion;   ///< "acceptable", "acceptable_by_rmsd", "irmsd_2_5" or "medium"
  int pairs = 0;           ///< failed ones, which count as without success, included
  int failed = 0;
  std::array<int, kSuccessRanks.size()> successes = {};
  std::optional<double> median_seconds;  ///< of the pairs that did not fail
};

/// One entry per class that has pairs and per criterion.
[[nodiscard]] std::vector<SuccessCount> count_successes(const std::vector<ResultRow>& rows);

[[nodiscard]] std::string success_csv(const std::vector<SuccessCount>& counts);
/// The same for a person to read.
[[nodiscard]] std::string success_text(const std::vector<SuccessCount>& counts);

}  // namespace mortise
