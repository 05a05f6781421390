// SPDX-License-Identifier: GPL-3.0-or-later
// mortise collide: gap value, certified answer and gradient at each pose of a table.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iomanip>
#include <memory>
#include <span>
#include <sstream>

#include "clock.hpp"
#include "commands.hpp"
#include "mortise/collision/collider.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/runs/body_forms.hpp"
#include "mortise/store/atomic_file.hpp"
#include "mortise/store/body.hpp"
#include "output_guard.hpp"
#include "pose_csv.hpp"

namespace mortise::app {
namespace {

struct CollideFlags {
  CommonOptions common;
  std::string fixed, moving, poses, output, certificate = "trees";
  ColliderOptions collider = {.tree_steps = 2000000};
  CollisionBodyOptions body;
};

CollisionBody collision_body_of(const std::string& spec, CollideFlags options) {
  const Body body = read_body(spec, {.threads = options.common.threads});
  const Part* part = body.part();
  if (part == nullptr)
    return {body_knots(body, {.radius = 0.0, .propensity = 0.0}, options.body.grid), 0.0};
  if (!options.common.quiet)
    for (const std::string& decision : body.decisions)
      std::fprintf(stderr, "mortise: %s: %s\n", spec.c_str(), decision.c_str());
  options.body.deviation = body.deviation;  // of a STEP file's triangles from its surface
  return collision_body(*part->solid, options.body);
}

const char* name(Contact contact) {
  return contact == Contact::kNo ? "no" : contact == Contact::kYes ? "yes" : "band";
}

std::array<double, 7> numbers(const GapValue& gap) {
  const Eigen::Vector3d &d = gap.translation_gradient, &e = gap.rotation_gradient;
  return {gap.value, d[0], d[1], d[2], e[0], e[1], e[2]};
}

const char* name(DecidedBy by) { return by == DecidedBy::kTree ? "tree" : "sum"; }

void write_csv(const std::string& path, const std::vector<Collision>& answers) {
  std::ostringstream text;
  text << "pose,answer,by,gap,dx,dy,dz,ex,ey,ez,modes\n" << std::setprecision(9);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    text << i + 1 << ',' << name(answers[i].contact) << ',' << name(answers[i].by);
    for (const double v : numbers(answers[i].gap)) text << ',' << v;
    text << ',' << answers[i].modes << '\n';
  }
  write_file_atomically(path, text.str());
}

void check_files(const CollideFlags& options) {
  if (!options.output.empty())
    check_output_file(options.output,
                      {options.poses, body_path(options.fixed), body_path(options.moving)}, true,
                      "");
}

// In pieces, so that progress shows and Ctrl-C is heard.
std::vector<Collision> answers_of(const Collider& collider, const std::vector<RigidMotion>& poses,
                                  const CommonOptions& common) {
  constexpr std::size_t kPiece = 2048;
  std::vector<Collision> answers(poses.size());
  const auto progress = make_progress("collide", common);
  for (std::size_t done = 0; done < poses.size();) {
    const std::size_t count = std::min(kPiece, poses.size() - done);
    collider.evaluate(std::span(poses).subspan(done, count),
                      std::span(answers).subspan(done, count), common.threads);
    done += count;
    if (!progress(done, poses.size())) throw Interrupted("no answers were written");
  }
  return answers;
}

void run(CollideFlags options) {
  options.collider.threads = options.body.threads = options.common.threads;
  options.collider.with_gap = true;
  if (options.certificate == "sum") options.collider.tree_steps = 0;
  check_files(options);
  const std::vector<RigidMotion> poses = read_pose_csv(options.poses);
  const CollisionBody fixed = collision_body_of(options.fixed, options),
                      moving = collision_body_of(options.moving, options);
  if (interrupted()) throw Interrupted("no answers were written");
  const Collider collider(fixed, moving, options.collider);
  const Clock::time_point start = Clock::now();
  const std::vector<Collision> answers = answers_of(collider, poses, options.common);
  const double seconds = seconds_since(start);
  if (!options.output.empty()) write_csv(options.output, answers);
  const auto count = [&](const auto& is) {
    return static_cast<long>(std::count_if(answers.begin(), answers.end(), is));
  };
  const long yes = count([](const Collision& c) { return c.contact == Contact::kYes; });
  const long no = count([](const Collision& c) { return c.contact == Contact::kNo; });
  const long by_sum = count([](const Collision& c) { return c.by == DecidedBy::kSum; });
  const long band = static_cast<long>(answers.size()) - yes - no;
  double modes = 0.0;  // of the sum, in the mean of the poses that it was asked for
  for (const Collision& c : answers) modes += c.modes;
  modes /= static_cast<double>(std::max(by_sum, 1L));
  if (options.common.json) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const Collision& c : answers) {
      const Eigen::Vector3d &d = c.gap.translation_gradient, &e = c.gap.rotation_gradient;
      rows.push_back({{"answer", name(c.contact)},
                      {"by", name(c.by)},
                      {"modes", c.modes},
                      {"gap", c.gap.value},
                      {"translation_gradient", {d[0], d[1], d[2]}},
                      {"rotation_gradient", {e[0], e[1], e[2]}}});
    }
    nlohmann::ordered_json figures = {{"poses", rows},
                                      {"yes", yes},
                                      {"no", no},
                                      {"in_band", band},
                                      {"by_sum", by_sum},
                                      {"band", collider.tree_band()},
                                      {"sum_band", nullptr},
                                      {"modes", options.collider.modes},
                                      {"mean_modes", modes},
                                      {"fixed_balls", fixed.balls.size()},
                                      {"moving_balls", moving.balls.size()},
                                      {"seconds", seconds}};
    if (by_sum > 0 && std::isfinite(collider.sum_band())) figures["sum_band"] = collider.sum_band();
    std::printf("%s\n", figures.dump().c_str());
    return;
  }
  if (options.common.quiet) return;
  std::printf("balls    %ld fixed, %ld moving\n", static_cast<long>(fixed.balls.size()),
              static_cast<long>(moving.balls.size()));
  if (options.certificate == "sum")
    std::printf(
        "band     %.4g: \"no\" is certain, and given to all that are farther apart; "
        "the sum has no \"yes\"\n",
        collider.sum_band());
  else if (collider.tree_band() > 0.0)
    std::printf("band     %.4g: closer than this the answer may be \"band\"\n",
                collider.tree_band());
  else
    std::printf("band     none: answers are exact\n");
  std::printf("answers  %ld yes, %ld no, %ld band\n", yes, no, band);
  if (by_sum > 0)
    std::printf("by sum   %ld, after %.0f of %d modes in the mean; its band is %.4g\n", by_sum,
                modes, options.collider.modes, collider.sum_band());
  std::printf("time     %.3f s, %.0f poses per second\n", seconds,
              static_cast<double>(poses.size()) / std::max(seconds, 1e-9));
}

}  // namespace

void add_collide(CLI::App& program) {
  auto options = std::make_shared<CollideFlags>();
  CLI::App* command = program.add_subcommand(
      "collide",
      "Say for each pose of a table whether two bodies collide, with gap value and gradient");
  command
      ->add_option("fixed", options->fixed,
                   "Molecule (PDB, mmCIF), part (mesh, STEP) or balls (.xyzr, decompose's file)")
      ->required();
  command->add_option("moving", options->moving, "The body the poses move, of any kind")
      ->required();
  command
      ->add_option("--poses", options->poses,
                   "CSV with columns qw, qx, qy, qz, tx, ty, tz; other columns are skipped")
      ->required();
  command->add_option(
      "-o,--output", options->output,
      "CSV: pose, answer (yes, no or band), what decided, gap value (common volume by the modes "
      "kept; overlapping atoms count each), its gradient by translation and by rotation about "
      "the moving body's origin, modes that the sum took to answer");
  command->add_option("--modes", options->collider.modes, "Fourier modes of the gap function")
      ->capture_default_str()
      ->check(CLI::Range(200, 10000000));
  command
      ->add_option("--grid", options->body.grid,
                   "Parts: nodes along the longest side; the band is about 3.5 cells")
      ->capture_default_str()
      ->check(CLI::Range(2, 1024));
  command
      ->add_option("--tree-steps", options->collider.tree_steps,
                   "Parts: pairs of balls examined per pose before the sum of modes decides")
      ->capture_default_str()
      ->check(CLI::Range(1, 2000000000));
  command
      ->add_option("--certificate", options->certificate,
                   "What answers: trees of balls, and the sum where these run out of steps; or the "
                   "truncated sum alone, which stops as soon as a miss is certain")
      ->capture_default_str()
      ->check(CLI::IsMember({"trees", "sum"}));
  add_common_options(
      *command, options->common,
      "  mortise collide block.stl peg.stl --poses poses.csv -o answers.csv\n"
      "  mortise export run.h5 --format csv -o poses.csv && \\\n"
      "    mortise collide receptor.pdb ligand.pdb --poses poses.csv --json\n"
      "\"no\" and \"yes\" are certain, by trees of balls around and inside the "
      "bodies; \"band\" means\n"
      "closer than the band that is printed. A truncated sum narrows it where the "
      "trees were stopped.\n"
      "Of molecules and balls the bodies are the balls, and answers are exact. Bodies of two kinds "
      "need\n"
      "one unit of length.\n");
  command->callback([options] { run(*options); });
}

}  // namespace mortise::app
