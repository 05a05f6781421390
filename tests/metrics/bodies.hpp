// SPDX-License-Identifier: GPL-3.0-or-later
// Small made-up molecules for the tests of metrics.
#pragma once

#include <array>
#include <random>
#include <string>
#include <vector>

#include "mortise/core/rigid_motion.hpp"
#include "mortise/molecules/molecule.hpp"

namespace mortise::testing_bodies {

inline Atom make_atom(const std::string& name, const std::string& residue, const std::string& chain,
                      int number, const Eigen::Vector3d& position) {
  Atom atom;
  atom.name = name;
  atom.residue_name = residue;
  atom.chain = chain;
  atom.residue_number = number;
  atom.element = name.substr(0, 1);
  atom.position = position;
  return atom;
}

// One CA per residue, numbered from 1, named by `names` in turn.
inline Molecule calpha_chain(const std::string& chain,
                             const std::vector<Eigen::Vector3d>& positions) {
  const std::array<const char*, 5> names{"ALA", "TRP", "LYS", "GLU", "SER"};
  Molecule out;
  for (std::size_t i = 0; i < positions.size(); ++i)
    out.atoms.push_back(
        make_atom("CA", names[i % names.size()], chain, static_cast<int>(i) + 1, positions[i]));
  return out;
}

inline Molecule moved(const RigidMotion& motion, Molecule molecule) {
  for (Atom& a : molecule.atoms) a.position = motion * a.position;
  return molecule;
}

// A compact blob of `count` residues with five to eight atoms each and random names, in a ball
// around `centre` of protein density.
inline Molecule random_protein(std::mt19937& random, const std::string& chain, int count,
                               const Eigen::Vector3d& centre) {
  const std::array<const char*, 8> names{"ALA", "TRP", "LYS", "GLU", "SER", "MSE", "GLY", "PHE"};
  const std::array<const char*, 8> atoms{"N", "CA", "C", "O", "CB", "CG", "CD", "OE1"};
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::uniform_int_distribution<int> pick(0, 7);
  const double radius = std::cbrt(3.0 * 130.0 * count / (4.0 * 3.14159));  // 130 A^3 per residue
  Molecule out;
  for (int i = 0; i < count; ++i) {
    Eigen::Vector3d at;
    do at = Eigen::Vector3d(uniform(random), uniform(random), uniform(random));
    while (at.norm() > 1.0);
    at = (centre + radius * at).eval();
    const std::string name = names[pick(random)];
    const int size = 5 + pick(random) % 4;
    for (int k = 0; k < size; ++k) {
      const Eigen::Vector3d shift(uniform(random), uniform(random), uniform(random));
      out.atoms.push_back(make_atom(atoms[k], name, chain, i + 1, at + 2.5 * shift));
    }
  }
  return out;
}

inline Molecule jittered(std::mt19937& random, Molecule molecule, double sigma) {
  std::normal_distribution<double> normal(0.0, sigma);
  for (Atom& a : molecule.atoms)
    a.position += Eigen::Vector3d(normal(random), normal(random), normal(random));
  return molecule;
}

// Leaves out each atom, and each residue, with the given probability.
inline Molecule thinned(std::mt19937& random, const Molecule& molecule, double probability) {
  std::bernoulli_distribution drop(probability);
  Molecule out;
  for (const ResidueRange& range : residues(molecule)) {
    if (drop(random)) continue;
    for (std::size_t i = range.first; i < range.last; ++i)
      if (molecule.atoms[i].name == "CA" || !drop(random)) out.atoms.push_back(molecule.atoms[i]);
  }
  return out;
}

}  // namespace mortise::testing_bodies
