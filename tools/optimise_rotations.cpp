// SPDX-License-Identifier: GPL-3.0-or-later
// Makes the stored rotation sets: searches for unions of icosahedral cosets with a small covering
// radius.
//
// The set is { g p h : g in I, p a representative, h in H }, I the 60 rotations of the icosahedron
// and H another group (trivial if no more symmetry is wanted). Left and right multiplication are
// isometries of SO(3), so only the Voronoi cells of the representatives are needed. From random
// representatives the program minimises
//
//   f_p = (1/p) log sum_v R_v^p,    v the corners of the cells, R_v their distance from the
//   representative,
//
// by L-BFGS for p = 8, 16, ... : f_p tends to the logarithm of the covering radius (halved). Then
// it kicks some members about, or moves one into the deepest hole, and keeps what has become
// better.
#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <deque>
#include <fstream>
#include <iomanip>
#include <numbers>
#include <random>
#include <vector>

#include "mortise/core/errors.hpp"
#include "mortise/core/rigid_motion.hpp"
#include "rotations/groups.hpp"
#include "symmetric_set.hpp"

namespace {

using Eigen::Index;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using mortise::displaced;
using mortise::SymmetricSet;
using Points = mortise::Rotations;

constexpr double kDegrees = 180.0 / std::numbers::pi;

/// Lowers f_power by L-BFGS from `p`, in place; stops after `steps`, or when no step helps.
SymmetricSet::Value minimise(SymmetricSet& set, Points& p, double power, int steps) {
  constexpr std::size_t kMemory = 12;
  std::deque<std::pair<Eigen::VectorXd, Eigen::VectorXd>> history;
  auto now = set.evaluate(p, power);
  const double longest = 0.1 * set.ball();
  for (int step = 0; step < steps; ++step) {
    Eigen::VectorXd direction = now.gradient;
    std::vector<double> alpha(history.size());
    for (std::size_t k = history.size(); k-- > 0;) {
      const auto& [s, y] = history[k];
      alpha[k] = s.dot(direction) / s.dot(y);
      direction -= alpha[k] * y;
    }
    if (!history.empty()) {
      const auto& [s, y] = history.back();
      direction *= s.dot(y) / y.squaredNorm();
    }
    for (std::size_t k = 0; k < history.size(); ++k) {
      const auto& [s, y] = history[k];
      direction += (alpha[k] - y.dot(direction) / s.dot(y)) * s;
    }
    direction = -direction;
    if (direction.dot(now.gradient) >= 0.0) {
      history.clear();
      direction = -now.gradient;
    }
    double size = direction.lpNorm<Eigen::Infinity>();
    if (!(size > 0.0)) break;
    double t = history.empty() ? 0.2 * longest / size : std::min(1.0, longest / size);
    bool accepted = false;
    for (int attempt = 0; attempt < 8; ++attempt, t *= 0.3) {
      Points moved = p;
      for (std::size_t i = 0; i < p.size(); ++i)
        moved[i] = displaced(p[i], t * direction.segment<3>(3 * static_cast<Index>(i)));
      auto next = set.evaluate(moved, power);
      if (!(next.f < now.f + 1e-4 * t * direction.dot(now.gradient))) continue;
      const Eigen::VectorXd s = t * direction;
      const Eigen::VectorXd y = next.gradient - now.gradient;
      if (s.dot(y) > 1e-10 * s.norm() * y.norm()) history.emplace_back(s, y);
      if (history.size() > kMemory) history.pop_front();
      p = std::move(moved);
      now = std::move(next);
      accepted = true;
      break;
    }
    if (accepted) continue;
    if (history.empty()) break;
    history.clear();
  }
  return now;
}

/// Lowers the covering radius from `p`, in place, raising the exponent step by step.
SymmetricSet::Value anneal(SymmetricSet& set, Points& p, double power, int steps, double hopeless) {
  SymmetricSet::Value value;
  for (; power < 10'000.0; power *= 2.0) {
    value = minimise(set, p, power, steps);
    if (power >= 64.0 && value.radius > 1.12 * hopeless) break;
    if (power >= 1000.0 && value.radius > 1.02 * hopeless) break;
  }
  return value;
}

/// A neighbour of the set `p` in the search: a few members jostled about the deepest hole or
/// anywhere, or one moved there.
Points kicked(const Points& p, const Quaterniond& deepest, double ball, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<std::size_t> pick(0, p.size() - 1);
  Points moved = p;
  const double noise = ball * std::uniform_real_distribution<double>(0.05, 0.5)(random);
  const int kind = std::uniform_int_distribution<int>(0, 2)(random);
  const Quaterniond centre = kind == 0 ? p[pick(random)] : deepest;
  const double reach = ball * std::uniform_real_distribution<double>(4.0, 12.0)(random);
  for (Quaterniond& q : moved)
    if (mortise::rotation_angle(q, centre) < reach)
      q = displaced(q, noise * Vector3d(normal(random), normal(random), normal(random)));
  if (kind == 2) moved[pick(random)] = deepest;
  return moved;
}

/// The representatives p h of the left cosets, each moved by I to where it is nearest the identity.
Points coset_representatives(const Points& p, const Points& left, const Points& right) {
  Points all;
  for (const Quaterniond& point : p)
    for (const Quaterniond& h : right) {
      Quaterniond best = point * h;
      for (const Quaterniond& g : left) {
        const Quaterniond moved = g * point * h;
        if (std::abs(moved.w()) > std::abs(best.w())) best = moved;
      }
      all.push_back(mortise::canonical(best));
    }
  std::sort(all.begin(), all.end(), [](const Quaterniond& a, const Quaterniond& b) {
    return std::array{-a.w(), a.x(), a.y(), a.z()} < std::array{-b.w(), b.x(), b.y(), b.z()};
  });
  return all;
}

/// The file's representatives, one for each orbit under the two groups.
Points read_representatives(const std::string& path, const Points& left, const Points& right) {
  std::ifstream file(path);
  if (!file) throw mortise::FileError(path, "cannot be read");
  std::string line;
  while (file.peek() == '#') std::getline(file, line);
  std::getline(file, line);  // covering radius
  Points p;
  double w = 0.0, x = 0.0, y = 0.0, z = 0.0;
  while (file >> w >> x >> y >> z) {
    const Quaterniond q = Quaterniond(w, x, y, z).normalized();
    bool known = false;
    for (const Quaterniond& member : p)
      for (const Quaterniond& h : right)
        for (const Quaterniond& g : left)
          known = known || mortise::rotation_angle(g * member * h, q) < 1e-8;
    if (!known) p.push_back(q);
  }
  return p;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program{"Searches for an even rotation set: cosets of the icosahedral group"};
  std::size_t representatives = 60;
  int starts = 10, steps = 60, kicks = 0, patience = 100;
  unsigned seed = 1;
  std::string right_name = "C1", input, output;
  program.add_option("--cosets", representatives, "Cosets of the icosahedral group: count / 60");
  program.add_option("--right", right_name, "Group acting from the right: Cn, Dn, T, O, I");
  program.add_option("--starts", starts, "Random starts");
  program.add_option("--steps", steps, "L-BFGS steps per exponent");
  program.add_option("--kicks", kicks, "Disturbed restarts from each start's result");
  program.add_option("--patience", patience, "Kicks without a gain before the next start");
  program.add_option("--seed", seed, "Of the random starts");
  program.add_option("--from", input,
                     "File of a set with these groups: the first start goes on from it");
  program.add_option("-o", output, "Where the best set so far is kept");
  CLI11_PARSE(program, argc, argv);
  try {
    const Points left = mortise::rotation_group("I");
    const Points right = mortise::rotation_group(right_name);
    if (representatives % right.size() != 0)
      throw mortise::InputError("--cosets must be a multiple of the order of --right");
    const std::size_t free = representatives / right.size();
    const auto write = [&](const std::string& path, const Points& p, double radius) {
      std::ofstream file(path);
      file << "# Representatives (w x y z) of " << representatives
           << " left cosets of the icosahedral rotation group; covering radius in degrees first.\n"
           << "# Made by optimise_rotations --cosets " << representatives << " --right "
           << right_name << " --steps " << steps << " --kicks " << kicks << " --patience "
           << patience << " --seed " << seed << (input.empty() ? "\n" : ", from an earlier set\n")
           << std::setprecision(9) << kDegrees * radius << "\n"
           << std::fixed << std::setprecision(12);
      for (const Quaterniond& q : coset_representatives(p, left, right))
        file << q.w() << ' ' << q.x() << ' ' << q.y() << ' ' << q.z() << '\n';
    };
    double best = 1e300;
    for (int start = 0; start < starts; ++start) {
      std::mt19937_64 random(seed * 1'000'003ULL + static_cast<unsigned>(start));
      std::normal_distribution<double> normal;
      Points p(free);
      for (Quaterniond& q : p) {
        for (double& c : q.coeffs()) c = normal(random);
        q.normalize();
      }
      SymmetricSet set(left, right, free);
      const bool go_on = start == 0 && !input.empty();
      if (go_on) p = read_representatives(input, left, right);
      if (p.size() != free)
        throw mortise::FileError(input, "expected " + std::to_string(free) +
                                            " representatives up to symmetry, found " +
                                            std::to_string(p.size()));
      auto value = anneal(set, p, go_on ? 1024.0 : 8.0, steps, best);
      const auto keep = [&] {
        if (value.radius >= best) return;
        best = value.radius;
        if (!output.empty()) write(output, p, best);
      };
      keep();
      int since = 0;
      for (int kick = 0; kick < kicks && since < patience && value.radius < 1.03 * best; ++kick) {
        Points trial = kicked(p, value.deepest, set.ball(), random);
        const auto result = anneal(set, trial, 32.0, steps, value.radius);
        ++since;
        if (!(result.radius < value.radius)) continue;
        since = 0;
        p = std::move(trial);
        value = result;
        keep();
      }
      std::printf("start %d: %.4f degrees, best %.4f\n", start, kDegrees * value.radius,
                  kDegrees * best);
      std::fflush(stdout);
    }
  } catch (const mortise::InputError& e) {
    std::fprintf(stderr, "optimise_rotations: error: %s\n", e.what());
    return 1;
  }
  return 0;
}
