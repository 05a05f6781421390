// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The two bodies of a run as a report shows them, and finding their files again.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mortise/molecules/molecule.hpp"
#include "mortise/parts/triangle_mesh.hpp"
#include "mortise/store/inputs.hpp"
#include "mortise/store/run_file.hpp"

namespace mortise {

/// One body: a molecule in a run of two molecules, else a mesh (of balls, if it is no part). The
/// other is empty. Both are empty if the file was not found and SearchPlaces::allow_missing allows
/// that.
struct ReportBody {
  std::string found;  ///< path of the file as it was found now
  Molecule molecule;  ///< input frame; waters left out
  TriangleMesh mesh;  ///< input frame
  std::string unit;   ///< of the coordinates: "angstrom", "mm", ...; empty = unknown

  Eigen::Matrix3Xd stand_in =
      Eigen::Matrix3Xd(3, 0);  ///< 3 x N, input frame: centres of the run's knots, if missing

  [[nodiscard]] bool is_mesh() const noexcept { return mesh.size() > 0; }
  [[nodiscard]] bool is_missing() const noexcept { return !is_mesh() && molecule.atoms.empty(); }
};

struct ReportBodies {
  ReportBody fixed;
  ReportBody moving;
  std::vector<std::string> notices;  ///< for the user: "the receptor's file is now at ..."
};

/// Where a body's file may have gone.
struct SearchPlaces {
  LocateOptions fixed;                   ///< as locate_input
  LocateOptions moving;                  ///< likewise
  std::vector<std::string> directories;  ///< looked through for a file of the recorded SHA-256
  std::vector<std::string> trees;        ///< likewise, with all directories below
  bool allow_missing = false;            ///< go on without a body whose file is not found
};

/// Finds and reads both bodies of a run: where the run says, else by name or contents in the
/// directories (not below them) and trees; only files of the same ending, at most 1 GB each, in a
/// tree the first 100,000.
/// @throws FileError naming the body, the SHA-256 looked for and where, if no file has its
/// contents, and what a file of its name has instead; as read_input_body; InputError for
/// a tree that is no directory
[[nodiscard]] ReportBodies read_report_bodies(const Run& run, const SearchPlaces& places = {});

/// 3 x N points of a body, input frame: heavy atoms, vertices of the mesh that a triangle uses, or
/// the stand-in.
[[nodiscard]] Eigen::Matrix3Xd report_points(const ReportBody& body);

}  // namespace mortise
