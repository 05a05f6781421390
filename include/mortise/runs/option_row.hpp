// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// One option of a run, described once: for the command line, its help, the run file and the check.
#pragma once

#include <limits>
#include <string>
#include <variant>

namespace mortise {

/// What an option decides. A finished search can be ranked anew with other options of ranking.
enum class OptionScope {
  kReading,  ///< what is taken from the input files
  kSearch,   ///< what the search finds
  kRanking,  ///< how candidates become ranked poses
};

/// An option that is spelled as text: an axis, a choice of words, a list.
template <class Options>
struct TextForm {
  std::string (*print)(const Options&);         ///< what parse() reads back
  void (*parse)(Options&, const std::string&);  ///< @throws InputError saying what is expected
};

/// A row of the table of options. Its default is the one of the struct Options.
template <class Options>
struct OptionRow {
  using Real = double& (*)(Options&);
  using Integer = int& (*)(Options&);
  using Switch = bool& (*)(Options&);
  using Text = std::string& (*)(Options&);

  const char* name;  ///< key in the run file: "per_rotation"; the flag is --per-rotation
  OptionScope scope;
  const char* help;  ///< what the user gets, then the unit
  std::variant<Real, Integer, Switch, Text, TextForm<Options>> field;
  double least = -std::numeric_limits<double>::infinity();  ///< numbers: smallest allowed
  double most = std::numeric_limits<double>::infinity();    ///< numbers: largest allowed
  bool above_least = false;                                 ///< `least` itself is not allowed
};

}  // namespace mortise
