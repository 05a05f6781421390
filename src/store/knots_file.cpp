// SPDX-License-Identifier: GPL-3.0-or-later
// The knots file, and telling Mortise's files apart.
#include "mortise/store/knots_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "mortise/core/errors.hpp"
#include "mortise/store/atomic_file.hpp"
#include "store/records.hpp"

namespace mortise {
namespace {

// /tree: balls (T x 4), and of each its first child, how many it has and which knot a leaf is.
void write_tree(hdf5::Writer& out, const SphereTree& tree) {
  const auto size = static_cast<hsize_t>(tree.size());
  out.group("/tree");
  out.array("/tree/balls", {size, 4}, tree.balls.data());
  out.array("/tree/first_child", {size}, tree.first_child.data());
  out.array("/tree/children", {size}, tree.children.data());
  out.array("/tree/leaf", {size}, tree.leaf.data());
}

SphereTree read_tree(const hdf5::Reader& in) {
  const hdf5::Shape shape = in.shape("/tree/balls");
  const hsize_t size = shape.empty() ? 0 : shape[0];
  const std::vector<double> balls = in.reals("/tree/balls", {size, 4});
  SphereTree tree;
  tree.balls.resize(4, static_cast<Eigen::Index>(size));
  std::copy(balls.begin(), balls.end(), tree.balls.data());
  const auto integers = [&](const char* name) {
    const std::vector<std::int32_t> values = in.integers(name, {size});
    return Eigen::VectorXi(
        Eigen::Map<const Eigen::VectorXi>(values.data(), static_cast<Eigen::Index>(size)));
  };
  tree.first_child = integers("/tree/first_child");
  tree.children = integers("/tree/children");
  tree.leaf = integers("/tree/leaf");
  return tree;
}

}  // namespace

void write_knots_file(const std::string& path, const KnotsFile& file) {
  check_knots(file.knots, "write_knots_file");
  std::vector<std::string> names;
  for (const Figure& figure : file.figures) names.push_back(figure.name);
  hdf5::check_names(names, "write_knots_file: figures");
  hdf5::Writer out;
  hdf5::write_head(out, "knots", kKnotsFormatVersion, file.provenance);
  hdf5::write_figures(out, "/figures", file.figures);
  out.group("/body");
  out.attribute("/body", "path", file.source_path);
  out.attribute("/body", "sha256", file.source_sha256);
  hdf5::write_knots(out, "/body", file.knots);
  if (file.tree) {
    check_sphere_tree(*file.tree, file.knots.size(), "write_knots_file: tree");
    write_tree(out, *file.tree);
  }
  write_file_atomically(path, out.bytes());
}

KnotsFile read_knots_file(const std::string& path) {
  const hdf5::Reader in(path);
  KnotsFile file;
  file.provenance = hdf5::read_head(in, "knots", kKnotsFormatVersion);
  file.figures = hdf5::read_figures(in, "/figures");
  file.source_path = in.text("/body", "path");
  file.source_sha256 = in.text("/body", "sha256");
  file.knots = hdf5::read_knots(in, "/body");
  try {
    check_knots(file.knots, "/body/knots");
    if (in.has("/tree")) {
      file.tree = read_tree(in);
      check_sphere_tree(*file.tree, file.knots.size(), "/tree");
    }
  } catch (const FileError&) {
    throw;
  } catch (const InputError& e) {
    in.fail(e.what());
  }
  return file;
}

StoredKind stored_kind(const std::string& path) {
  if (!std::filesystem::exists(path)) throw FileError(path, "expected a file, found none");
  std::string start(8, '\0');
  std::ifstream(path, std::ios::binary).read(start.data(), 8);
  if (!hdf5::has_signature(start)) return StoredKind::kNotHdf5;
  const hdf5::Reader in(path);
  if (!in.has_attribute("/", "mortise_file")) return StoredKind::kOtherHdf5;
  const std::string kind = in.text("/", "mortise_file");
  return kind == "run"     ? StoredKind::kRun
         : kind == "knots" ? StoredKind::kKnots
                           : StoredKind::kOtherHdf5;
}

}  // namespace mortise
