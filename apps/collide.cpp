// SPDX-License-Identifier: GPL-3.0-or-later
// mortise collide: gap value, certified answer and gradient at each pose of a table.
#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <iomanip>
#include <memory>

#include "clock.hpp"
#include "commands.hpp"
#include "mortise/collision/collider.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/molecules/read_molecule.hpp"
#include "mortise/molecules/to_knots.hpp"
#include "mortise/parts/mesh_solid.hpp"
#include "mortise/parts/read_part.hpp"
#include "pose_csv.hpp"

namespace mortise::app {
namespace {

struct CollideFlags {
  CommonOptions common;
  std::string fixed, moving, poses, output;
  ColliderOptions collider;
  CollisionBodyOptions body;
};

// By the file's name: what is not a molecule's is a part's.
bool is_molecule(const std::string& text) {
  std::string path = parse_molecule_spec(text).path;
  for (const char* end :
       {".pdb", ".ent", ".cif", ".mmcif", ".pdb.gz", ".ent.gz", ".cif.gz", ".mmcif.gz"}) {
    const std::string suffix = end;
    if (path.size() >= suffix.size() &&
        path.compare(path.size() - suffix.size(), suffix.size(), suffix) == 0)
      return true;
  }
  return false;
}

CollisionBody read_body(const std::string& text, const CollideFlags& options) {
  if (is_molecule(text)) {
    const ReadMoleculeResult read = read_molecule(parse_molecule_spec(text));
    return {to_knots(read.molecule, {.radius = 0.0, .propensity = 0.0}), 0.0};
  }
  const ReadPartResult read = read_part(text);
  return collision_body(MeshSolid(read.mesh, {.threads = options.common.threads}), options.body);
}

const char* name(Contact contact) {
  return contact == Contact::kNo ? "no" : contact == Contact::kYes ? "yes" : "band";
}

std::array<double, 7> numbers(const GapValue& gap) {
  const Eigen::Vector3d &d = gap.translation_gradient, &e = gap.rotation_gradient;
  return {gap.value, d[0], d[1], d[2], e[0], e[1], e[2]};
}

void write_csv(const std::string& path, const std::vector<Collision>& answers) {
  std::ofstream file(path);
  file << "pose,answer,by,gap,dx,dy,dz,ex,ey,ez\n" << std::setprecision(9);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    file << i + 1 << ',' << name(answers[i].contact) << ','
         << (answers[i].by == DecidedBy::kTree ? "tree" : "sum");
    for (const double v : numbers(answers[i].gap)) file << ',' << v;
    file << '\n';
  }
  file.close();
  if (!file) throw FileError(path, "cannot be written");
}

void run(CollideFlags options) {
  options.collider.threads = options.body.threads = options.common.threads;
  options.collider.with_gap = true;
  const std::vector<RigidMotion> poses = read_pose_csv(options.poses);
  const CollisionBody fixed = read_body(options.fixed, options),
                      moving = read_body(options.moving, options);
  const Collider collider(fixed, moving, options.collider);
  std::vector<Collision> answers(poses.size());
  const Clock::time_point start = Clock::now();
  collider.evaluate(poses, answers, options.common.threads);
  const double seconds = seconds_since(start);
  if (!options.output.empty()) write_csv(options.output, answers);
  const auto count = [&](Contact contact) {
    return std::count_if(answers.begin(), answers.end(),
                         [&](const Collision& c) { return c.contact == contact; });
  };
  if (options.common.json) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const Collision& c : answers) {
      const Eigen::Vector3d &d = c.gap.translation_gradient, &e = c.gap.rotation_gradient;
      rows.push_back({{"answer", name(c.contact)},
                      {"by", c.by == DecidedBy::kTree ? "tree" : "sum"},
                      {"gap", c.gap.value},
                      {"translation_gradient", {d[0], d[1], d[2]}},
                      {"rotation_gradient", {e[0], e[1], e[2]}}});
    }
    const nlohmann::ordered_json figures = {{"poses", rows},
                                            {"band", collider.tree_band()},
                                            {"growth", collider.growth()},
                                            {"modes", collider.gap_function().modes()},
                                            {"fixed_balls", fixed.balls.size()},
                                            {"moving_balls", moving.balls.size()},
                                            {"seconds", seconds}};
    std::printf("%s\n", figures.dump().c_str());
    return;
  }
  if (options.common.quiet) return;
  std::printf("balls    %ld fixed, %ld moving\n", static_cast<long>(fixed.balls.size()),
              static_cast<long>(moving.balls.size()));
  std::printf("band     %.4g: closer than this the answer may be \"band\"\n", collider.tree_band());
  std::printf("answers  %ld yes, %ld no, %ld band\n", static_cast<long>(count(Contact::kYes)),
              static_cast<long>(count(Contact::kNo)), static_cast<long>(count(Contact::kBand)));
  std::printf("time     %.3f s, %.0f poses per second\n", seconds,
              static_cast<double>(poses.size()) / std::max(seconds, 1e-9));
}

}  // namespace

void add_collide(CLI::App& program) {
  auto options = std::make_shared<CollideFlags>();
  CLI::App* command = program.add_subcommand(
      "collide",
      "Say for each pose of a table whether two bodies collide, with gap value and gradient");
  command->add_option("fixed", options->fixed, "Molecule (PDB, mmCIF) or part (mesh, STEP)")
      ->required();
  command->add_option("moving", options->moving, "The body the poses move, of the same kind")
      ->required();
  command
      ->add_option("--poses", options->poses,
                   "CSV with columns qw, qx, qy, qz, tx, ty, tz; others are skipped")
      ->required();
  command->add_option(
      "-o,--output", options->output,
      "CSV: pose, answer (yes, no or band), what decided, gap value, its gradient by "
      "translation and by rotation about the moving body's origin");
  command->add_option("--modes", options->collider.modes, "Fourier modes of the gap function")
      ->capture_default_str()
      ->check(CLI::Range(200, 10000000));
  command
      ->add_option("--grid", options->body.grid,
                   "Parts: nodes along the longest side; the band is about 3.5 cells of both")
      ->capture_default_str()
      ->check(CLI::Range(2, 1024));
  add_common_options(
      *command, options->common,
      "  mortise collide block.stl peg.stl --poses poses.csv -o answers.csv\n"
      "  mortise export run.h5 --format csv -o poses.csv && \\\n"
      "    mortise collide receptor.pdb ligand.pdb --poses poses.csv --json\n"
      "\"no\" and \"yes\" are certain; \"band\" means closer than the band that is printed.\n");
  command->callback([options] { run(*options); });
}

}  // namespace mortise::app
