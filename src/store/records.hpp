// SPDX-License-Identifier: GPL-3.0-or-later
// The parts that run and knots files have in common, to and from HDF5.
#pragma once

#include <string>
#include <vector>

#include "mortise/core/knots.hpp"
#include "mortise/core/rigid_motion.hpp"
#include "mortise/store/provenance.hpp"
#include "store/hdf5_file.hpp"

namespace mortise::hdf5 {

/// Root attributes: what the file is ("run", "knots"), its format version, its provenance.
void write_head(Writer& file, const std::string& kind, int format_version,
                const Provenance& provenance);
/// Checks kind and format version, returns the provenance.
[[nodiscard]] Provenance read_head(const Reader& file, const std::string& kind, int format_version);

/// <group>/knots (N x 4) and <group>/weights (N x 2: real, imaginary).
void write_knots(Writer& file, const std::string& group, const Knots& knots);
[[nodiscard]] Knots read_knots(const Reader& file, const std::string& group);

/// A group with one attribute per figure.
void write_figures(Writer& file, const std::string& group, const std::vector<Figure>& figures);
[[nodiscard]] std::vector<Figure> read_figures(const Reader& file, const std::string& group);

/// Throws InputError unless the names can be HDF5 links: unique, not empty, not ".", no "/" and no
/// NUL.
void check_names(const std::vector<std::string>& names, const std::string& where);

}  // namespace mortise::hdf5
