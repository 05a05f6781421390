// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies of every kind, read by one function.
#include "mortise/store/body.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>

#include "mortise/core/errors.hpp"
#include "mortise/molecules/radii.hpp"
#include "mortise/parts/ball_mesh.hpp"
#include "mortise/parts/mesh_solid.hpp"
#include "mortise/store/balls_file.hpp"

namespace mortise {
namespace {

constexpr std::array<std::string_view, 4> kMoleculeEndings = {".pdb", ".ent", ".cif", ".mmcif"};
constexpr std::array<std::string_view, 6> kPartEndings = {".stl", ".obj",  ".ply",
                                                          ".off", ".step", ".stp"};
constexpr std::array<std::string_view, 4> kPartWords = {"solid", "ply", "OFF", "ISO-10303"};

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

template <std::size_t N>
bool ends_in(const std::string& name, const std::array<std::string_view, N>& endings) {
  return std::any_of(endings.begin(), endings.end(),
                     [&](std::string_view ending) { return name.ends_with(ending); });
}

Body make_body(BodyRecord record, const MoleculeSpec& spec, BodyKind kind,
               const ReadBodyOptions& options) {
  Body body;
  body.record = std::move(record);
  body.record.kind = name_of(kind);
  if (kind == BodyKind::kMolecule) {
    ReadMoleculeResult read = read_molecule(spec, options.molecule);
    body.shape = std::move(read.molecule);
    body.decisions = std::move(read.decisions);
    body.record.unit = "angstrom";
  } else if (kind == BodyKind::kPart) {
    ReadPartResult read = read_part(spec.path, options.part);
    body.decisions = std::move(read.decisions);
    body.record.unit = read.unit;
    body.deviation = read.deviation;
    auto solid =
        std::make_shared<MeshSolid>(read.mesh, MeshSolidOptions{.threads = options.threads});
    body.shape = Part{std::move(read.mesh), std::move(solid)};
  } else {
    body.shape = read_balls(spec.path);
  }
  return body;
}

// Of a name that need not exist any more: what follows the recorded path says model and chains.
MoleculeSpec recorded_spec(const BodyRecord& record, const std::string& path) {
  MoleculeSpec spec = record.spec.starts_with(record.path)
                          ? parse_molecule_spec("body.pdb" + record.spec.substr(record.path.size()))
                          : parse_molecule_spec(record.spec);
  spec.path = path;
  return spec;
}

}  // namespace

Body::Body(Molecule molecule) : shape(std::move(molecule)) {
  record.kind = name_of(BodyKind::kMolecule);
  record.unit = "angstrom";
}
Body::Body(Part part) : shape(std::move(part)) { record.kind = name_of(BodyKind::kPart); }
Body::Body(Knots balls) : shape(std::move(balls)) { record.kind = name_of(BodyKind::kBalls); }

const char* name_of(BodyKind kind) {
  return kind == BodyKind::kMolecule ? "molecule" : kind == BodyKind::kPart ? "part" : "balls";
}

std::string body_path(const std::string& spec) { return parse_molecule_spec(spec).path; }

BodyKind body_kind(const std::string& spec) {
  const std::string path = body_path(spec);
  std::string name = lower(path);
  if (name.ends_with(".gz")) name.resize(name.size() - 3);
  if (ends_in(name, kMoleculeEndings)) return BodyKind::kMolecule;
  if (ends_in(name, kPartEndings)) return BodyKind::kPart;
  if (is_balls_file(path)) return BodyKind::kBalls;
  std::string head(16, '\0');
  std::ifstream(path, std::ios::binary)
      .read(head.data(), static_cast<std::streamsize>(head.size()));
  const bool mesh = std::any_of(kPartWords.begin(), kPartWords.end(),
                                [&](std::string_view word) { return head.starts_with(word); });
  return mesh ? BodyKind::kPart : BodyKind::kMolecule;
}

Body read_body(const std::string& text, const ReadBodyOptions& options) {
  const MoleculeSpec spec = parse_molecule_spec(text);
  const BodyKind kind = body_kind(text);
  if (kind != BodyKind::kMolecule && (spec.model != 0 || !spec.chains.empty()))
    throw InputError(text + ": model and chains are for molecules; " + spec.path + " is of " +
                     (kind == BodyKind::kPart ? "a part" : "balls"));
  BodyRecord record;
  record.path = spec.path;
  record.spec = text;
  Body body = make_body(std::move(record), spec, kind, options);
  body.record.sha256 = sha256_of_file(spec.path);
  return body;
}

Body read_recorded_body(const BodyRecord& record, const Provenance& provenance,
                        const std::string& name, const LocateOptions& where,
                        const ReadBodyOptions& options) {
  LocateOptions place = where;
  if (!where.path.empty()) {
    const MoleculeSpec given = parse_molecule_spec(where.path);
    const MoleculeSpec recorded = recorded_spec(record, given.path);
    if ((given.model != 0 || !given.chains.empty()) &&
        (given.model != recorded.model || given.chains != recorded.chains))
      throw InputError("the run's " + name + " input is " + record.spec + ", got " + where.path);
    place.path = given.path;
  }
  BodyRecord bare = record;
  bare.knots = {};
  const std::string path = locate_input(record, provenance, name, place);
  const BodyKind kind = record.kind == name_of(BodyKind::kPart)    ? BodyKind::kPart
                        : record.kind == name_of(BodyKind::kBalls) ? BodyKind::kBalls
                                                                   : BodyKind::kMolecule;
  return make_body(std::move(bare), recorded_spec(record, path), kind, options);
}

Body moved_body(const Body& body, const RigidMotion& motion) {
  Body moved = body;
  if (auto* molecule = std::get_if<Molecule>(&moved.shape)) {
    for (Atom& atom : molecule->atoms) atom.position = motion * atom.position;
  } else if (auto* part = std::get_if<Part>(&moved.shape)) {
    part->mesh.vertices = motion * part->mesh.vertices;
    part->solid = std::make_shared<MeshSolid>(part->mesh);
  } else {
    auto& points = std::get<Knots>(moved.shape).points;
    points.topRows<3>() = motion * Eigen::Matrix3Xd(points.topRows<3>());
  }
  return moved;
}

Body read_input_body(const BodyRecord& record, const Provenance& provenance,
                     const std::string& name, const LocateOptions& where) {
  ReadBodyOptions options{
      .molecule = {.keep_hydrogens = true},
      .part = {.repair = {.allow_open = true, .find_self_intersections = false}}};
  const nlohmann::json recorded =
      nlohmann::json::parse(provenance.options_json, nullptr, /*allow_exceptions=*/false);
  if (recorded.is_object() && recorded.contains("deviation") && recorded["deviation"].is_number())
    options.part.absolute_deviation = recorded["deviation"].get<double>();
  return read_recorded_body(record, provenance, name, where, options);
}

TriangleMesh body_mesh(const Body& body) {
  if (const Part* part = body.part()) return part->mesh;
  if (const Knots* balls = body.balls()) return ball_mesh(balls->points);
  return ball_mesh(atom_balls(*body.molecule()));
}

}  // namespace mortise
