// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The knots file: one body's weighted balls and where they come from, as HDF5.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mortise/core/knots.hpp"
#include "mortise/parts/sphere_tree.hpp"
#include "mortise/store/provenance.hpp"

namespace mortise {

/// Layout of the knots file; a reader refuses any other.
inline constexpr int kKnotsFormatVersion = 1;

struct KnotsFile {
  Provenance provenance;
  std::string source_path;    ///< the body's file, as given
  std::string source_sha256;  ///< 64 hex digits; may be empty
  Knots knots;
  std::optional<SphereTree> tree;  ///< over the knots, in their order
  std::vector<Figure> figures;     ///< such as hausdorff
};

/// Writes as write_file_atomically does; equal contents give equal bytes.
/// @throws InputError as check_knots or if the tree is not one over as many knots, FileError as
/// write_file_atomically
void write_knots_file(const std::string& path, const KnotsFile& file);

/// @throws FileError as read_run
[[nodiscard]] KnotsFile read_knots_file(const std::string& path);

/// What a file's first bytes and root attributes say it is.
enum class StoredKind {
  kRun,
  kKnots,
  kOtherHdf5,  ///< HDF5, but none of Mortise's
  kNotHdf5,
};

/// @throws FileError if the file is missing, unreadable or a damaged HDF5 file
[[nodiscard]] StoredKind stored_kind(const std::string& path);

}  // namespace mortise
