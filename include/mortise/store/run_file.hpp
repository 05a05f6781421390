// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The run file: all that a search was asked, has done and has found, as one HDF5 file.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "mortise/core/knots.hpp"
#include "mortise/core/pose.hpp"
#include "mortise/core/rigid_motion.hpp"
#include "mortise/search/candidate.hpp"
#include "mortise/store/provenance.hpp"

namespace mortise {

/// Layout of the run file; a reader refuses any other.
inline constexpr int kRunFormatVersion = 2;

/// One of the two bodies: its file, and what the search made of it.
struct BodyRecord {
  std::string path;               ///< the file, as given; relative to Provenance::working_directory
  std::string spec;               ///< path with model and chains, as given: "complex.pdb#2:A"
  std::string sha256;             ///< of the file, 64 hex digits
  Knots knots;                    ///< input frame; may be empty
  RigidMotion search_from_input;  ///< carries input coordinates to the frame the search used
  std::string unit;  ///< of lengths: "angstrom" of molecules, of a part what its file says, such as
                     ///< "mm"; empty if it says nothing
  std::string kind = "molecule";  ///< "molecule", "part" or "balls"
};

/// The rotations searched and which of them are done.
struct RotationRecord {
  Eigen::Matrix4Xd quaternions =
      Eigen::Matrix4Xd(4, 0);      ///< 4 x N: w, x, y, z of unit length, search frame
  double covering_radius = 0.0;    ///< radians
  std::vector<std::uint8_t> done;  ///< N: 1 = searched
};

/// One further number per pose, such as interface_rmsd; NaN = absent.
struct MetricColumn {
  std::string name;
  std::vector<double> values;  ///< one per pose
};

struct Run {
  std::string kind = "dock";  ///< "dock" or "mate"
  Provenance provenance;
  bool complete = false;        ///< false while the search is unfinished
  double seconds = 0.0;         ///< wall time spent, resumed parts included
  std::vector<Figure> figures;  ///< timing and quality figures, such as seconds_search
  BodyRecord fixed;
  BodyRecord moving;
  RotationRecord rotations;
  PoseList poses;  ///< in rank order
  std::vector<MetricColumn> metrics;
  std::vector<Candidate> candidates;  ///< of the rotations done, by rotation, best first within
                                      ///< one: what an unfinished search goes on from and what a
                                      ///< finished one can be ranked from anew
};

/// Whether both bodies are molecules.
[[nodiscard]] bool of_molecules(const Run& run);

/// Puts columns into the run, in place of earlier ones of their names.
void set_metric_columns(Run& run, std::vector<MetricColumn> columns);

/// Throws InputError naming `who` and the field unless all lengths agree, indices are in range and
/// names can be stored (unique, not empty, not ".", without "/").
void check_run(const Run& run, const char* who);

/// Writes the run as write_file_atomically does. Equal runs give equal bytes.
/// @throws InputError as check_run, FileError as write_file_atomically
void write_run(const std::string& path, const Run& run);

/// Reads a run back, bit for bit.
/// @throws FileError if the file is missing, not HDF5, truncated, damaged, not a Mortise run, or of
/// another format
///         version; a missing or misshapen dataset is named
[[nodiscard]] Run read_run(const std::string& path);

/// The run as an HDF5 file's bytes, as write_run would write them.
[[nodiscard]] std::string serialize_run(const Run& run);

}  // namespace mortise
