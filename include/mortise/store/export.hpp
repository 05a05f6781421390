// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A run's poses in the formats of other programs. The layouts are described in docs/formats.md.
#pragma once

#include <string>
#include <vector>

#include "mortise/molecules/molecule.hpp"
#include "mortise/store/body.hpp"
#include "mortise/store/inputs.hpp"
#include "mortise/store/run_file.hpp"

namespace mortise {

enum class ExportFormat { kPdb, kMmcif, kCsv, kJson, kZdock, kStl, kPly, kStep };

/// "pdb", "cif", "csv", "json", "zdock", "stl", "ply", "step". @throws InputError for any other
/// name, listing these
[[nodiscard]] ExportFormat parse_export_format(const std::string& name);

struct ExportOptions {
  int top = 0;           ///< best poses written; 0 = 10 as structures, 1 as parts, all as tables
  int pose = 0;          ///< only the pose of this rank, from 1; 0 = the top ones
  bool complex = false;  ///< structures and parts: the fixed body too, in every model
};

/// Indices into run.poses.poses of the poses that the options choose, in rank order.
/// @throws InputError if there are no poses, no such rank, or a number is negative
[[nodiscard]] std::vector<std::size_t> chosen_poses(const Run& run, ExportFormat format,
                                                    const ExportOptions& options);

/// One row per pose: rank, score, channels, qw qx qy qz, tx ty tz, rotation_index, cluster,
/// metrics. Numbers read back bit for bit; an absent metric is an empty field.
[[nodiscard]] std::string export_csv(const Run& run, const ExportOptions& options = {});

/// The same as one JSON object, with the two inputs; an absent metric is null.
[[nodiscard]] std::string export_json(const Run& run, const ExportOptions& options = {});

/// A multi-MODEL PDB file of the moved body; the MODEL number is the rank. With options.complex the
/// fixed body comes first in each model and moving chains that share a name with a fixed one get a
/// free letter, named in a REMARK.
/// @param fixed   used with options.complex only
/// @throws InputError for a run of parts, and where the format has no room (see format_pdb_atoms)
[[nodiscard]] std::string export_pdb(const Run& run, const Molecule& fixed, const Molecule& moving,
                                     const ExportOptions& options = {});

/// The same as mmCIF; pdbx_PDB_model_num is the rank.
[[nodiscard]] std::string export_mmcif(const Run& run, const Molecule& fixed,
                                       const Molecule& moving, const ExportOptions& options = {});

/// A run's bodies as surfaces, read once for all its poses.
struct ExportParts {
  TriangleMesh fixed;  ///< empty unless ExportOptions::complex
  TriangleMesh moving;
  std::string fixed_unit, moving_unit;
  std::string moving_path;  ///< where it was found
};

/// @throws InputError for a run of two molecules; as read_input_body
[[nodiscard]] ExportParts read_export_parts(const Run& run, const LocateOptions& fixed,
                                            const LocateOptions& moving,
                                            const ExportOptions& options = {});

/// The moving part at one pose, by index, in the fixed part's frame, as the bytes of an STL, PLY or
/// STEP file. A STEP input written as STEP keeps its curved faces; otherwise, and with
/// options.complex, the triangles are written, in the unit of whichever part knows one; mm if none
/// does.
/// @throws InputError for a run of molecules, an index out of range, another format, or a complex
/// of two units; as format_step
[[nodiscard]] std::string export_part(const Run& run, ExportFormat format, std::size_t pose,
                                      const ExportParts& parts, const ExportOptions& options = {});

/// The .out layout of ZDOCK 3.0.2, on a grid of 0.001 so that whole steps place every atom within
/// 0.001 A.
/// @throws InputError for a run of parts, for input paths with blanks (the layout cannot carry
/// them), and for
///         translations beyond 1,000,000 A
[[nodiscard]] std::string export_zdock(const Run& run, const ExportOptions& options = {});

}  // namespace mortise
