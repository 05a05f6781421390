// SPDX-License-Identifier: GPL-3.0-or-later
// Pairing chains by name, then by content; residues by number, then by alignment.
#include "mortise/metrics/match_residues.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <tuple>

#include "metrics/polymer.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/metrics/align_sequences.hpp"
#include "mortise/metrics/superpose.hpp"

namespace mortise {
namespace {

using detail::PolymerResidue;

constexpr double kTrustedShare = 0.5;        // of the shorter chain
constexpr double kTrustedIdentity = 0.7;     // of pairs by number
constexpr std::size_t kChainsToPermute = 6;  // at most 6! assignments are compared

struct Chain {
  std::string name;
  std::vector<const PolymerResidue*> residues;
};

struct Candidate {
  ChainMatch summary;
  std::vector<std::pair<const PolymerResidue*, const PolymerResidue*>> pairs;
};

std::vector<Chain> split_chains(const std::vector<PolymerResidue>& residues) {
  std::vector<Chain> chains;
  for (const PolymerResidue& r : residues) {
    auto chain = std::find_if(chains.begin(), chains.end(),
                              [&](const Chain& c) { return c.name == r.chain; });
    if (chain == chains.end()) chain = chains.insert(chain, Chain{r.chain, {}});
    chain->residues.push_back(&r);
  }
  return chains;
}

Candidate make_candidate(const Chain& model, const Chain& reference, MatchMethod method) {
  Candidate out;
  out.summary.model_chain = model.name;
  out.summary.reference_chain = reference.name;
  out.summary.method = method;
  return out;
}

void add_pair(Candidate& candidate, const PolymerResidue* a, const PolymerResidue* b) {
  candidate.pairs.emplace_back(a, b);
  ++candidate.summary.matched;
  if (a->name == b->name) ++candidate.summary.identical;
}

double share_of_shorter(std::size_t count, const Chain& a, const Chain& b) {
  return static_cast<double>(count) /
         static_cast<double>(std::min(a.residues.size(), b.residues.size()));
}

std::optional<Candidate> match_by_number(const Chain& model, const Chain& reference) {
  // Numbers that occur more than once in a chain are told apart by their turn.
  using Key = std::tuple<int, std::string, int>;
  const auto keys = [](const Chain& chain) {
    std::map<std::pair<int, std::string>, int> turns;
    std::vector<Key> out;
    for (const PolymerResidue* r : chain.residues)
      out.emplace_back(r->number, r->insertion_code, turns[{r->number, r->insertion_code}]++);
    return out;
  };
  std::map<Key, const PolymerResidue*> by_key;
  const std::vector<Key> reference_keys = keys(reference);
  for (std::size_t i = 0; i < reference_keys.size(); ++i)
    by_key[reference_keys[i]] = reference.residues[i];

  Candidate out = make_candidate(model, reference, MatchMethod::kNumbering);
  const std::vector<Key> model_keys = keys(model);
  for (std::size_t i = 0; i < model_keys.size(); ++i)
    if (const auto found = by_key.find(model_keys[i]); found != by_key.end())
      add_pair(out, model.residues[i], found->second);
  const bool trusted = share_of_shorter(out.pairs.size(), model, reference) >= kTrustedShare &&
                       static_cast<double>(out.summary.identical) >=
                           kTrustedIdentity * static_cast<double>(out.summary.matched);
  if (!trusted) return std::nullopt;
  return out;
}

std::optional<Candidate> match_by_alignment(const Chain& model, const Chain& reference) {
  const auto names = [](const Chain& chain) {
    std::vector<std::string> out;
    for (const PolymerResidue* r : chain.residues) out.push_back(r->name);
    return out;
  };
  const std::vector<std::string> a = names(model);
  const std::vector<std::string> b = names(reference);
  Candidate out = make_candidate(model, reference, MatchMethod::kAlignment);
  for (const auto& [i, j] : align_sequences(a, b).columns)
    if (a[i] == b[j]) add_pair(out, model.residues[i], reference.residues[j]);
  if (share_of_shorter(out.summary.identical, model, reference) < kTrustedShare)
    return std::nullopt;
  return out;
}

Eigen::Vector3d representative(const PolymerResidue& residue) {
  for (const detail::PolymerAtom& atom : residue.atoms)
    if (atom.name == "CA" || atom.name == "C4'") return atom.position;
  return residue.atoms.front().position;
}

double superposed_rmsd(const std::vector<const Candidate*>& chosen) {
  std::size_t count = 0;
  for (const Candidate* c : chosen) count += c->pairs.size();
  Eigen::Matrix3Xd model(3, count);
  Eigen::Matrix3Xd reference(3, count);
  Eigen::Index k = 0;
  for (const Candidate* c : chosen)
    for (const auto& [a, b] : c->pairs) {
      model.col(k) = representative(*a);
      reference.col(k++) = representative(*b);
    }
  return superpose(model, reference).rmsd;
}

using CandidateTable = std::vector<std::vector<std::optional<Candidate>>>;

// The rows of the table each with at most one column, by most identical residues first come, first
// served.
std::vector<const Candidate*> assign_greedily(const CandidateTable& table) {
  std::vector<std::tuple<std::size_t, std::size_t, std::size_t>>
      order;  // (-identical, row, column)
  for (std::size_t i = 0; i < table.size(); ++i)
    for (std::size_t j = 0; j < table[i].size(); ++j)
      if (table[i][j]) order.emplace_back(~table[i][j]->summary.identical, i, j);
  std::sort(order.begin(), order.end());
  std::vector<const Candidate*> chosen;
  std::vector<char> row_used(table.size(), 0);
  std::vector<char> column_used(table.empty() ? 0 : table.front().size(), 0);
  for (const auto& [rank, i, j] : order) {
    if (row_used[i] != 0 || column_used[j] != 0) continue;
    row_used[i] = column_used[j] = 1;
    chosen.push_back(&*table[i][j]);
  }
  return chosen;
}

// Every assignment: of those within 5% of the most identical residues, the one that superposes best
// together with the chains already `settled`.
std::vector<const Candidate*> assign_exhaustively(const CandidateTable& table,
                                                  const std::vector<const Candidate*>& settled) {
  std::vector<std::pair<std::size_t, std::vector<const Candidate*>>> all;
  std::vector<const Candidate*> current;
  std::vector<char> used(table.empty() ? 0 : table.front().size(), 0);
  const std::function<void(std::size_t, std::size_t)> descend = [&](std::size_t row,
                                                                    std::size_t identical) {
    if (row == table.size()) {
      all.emplace_back(identical, current);
      return;
    }
    for (std::size_t j = 0; j < used.size(); ++j) {
      if (used[j] != 0 || !table[row][j]) continue;
      used[j] = 1;
      current.push_back(&*table[row][j]);
      descend(row + 1, identical + table[row][j]->summary.identical);
      current.pop_back();
      used[j] = 0;
    }
    descend(row + 1, identical);  // a chain that the reference lacks
  };
  descend(0, 0);

  std::size_t most = 0;
  for (const auto& option : all) most = std::max(most, option.first);
  std::vector<const Candidate*> best;
  double best_rmsd = 0.0;
  for (const auto& [identical, chosen] : all) {
    if (chosen.empty() || static_cast<double>(identical) < 0.95 * static_cast<double>(most))
      continue;
    std::vector<const Candidate*> together = settled;
    together.insert(together.end(), chosen.begin(), chosen.end());
    const double left = superposed_rmsd(together);
    if (best.empty() || left < best_rmsd) {
      best = chosen;
      best_rmsd = left;
    }
  }
  return best;
}

std::string describe(const Molecule& molecule, const std::vector<Chain>& chains) {
  std::string out = molecule.path.empty() ? "(unnamed)" : molecule.path;
  out += " [";
  for (const Chain& c : chains)
    out += (out.back() == '[' ? "" : ", ") + ("chain '" + c.name + "' ") +
           std::to_string(c.residues.size());
  return out + " residues]";
}

}  // namespace

ResidueMatch match_residues(const Molecule& model, const Molecule& reference,
                            const MatchResiduesOptions& options) {
  if (!(options.min_fraction >= 0.0 && options.min_fraction <= 1.0))
    throw InputError("match_residues: min_fraction must be in [0, 1], got " +
                     std::to_string(options.min_fraction));
  const std::vector<PolymerResidue> model_residues = detail::polymer_residues(model);
  const std::vector<PolymerResidue> reference_residues = detail::polymer_residues(reference);
  for (const auto& [residues, molecule] :
       {std::pair(&model_residues, &model), std::pair(&reference_residues, &reference)})
    if (residues->empty())
      throw InputError("match_residues: expected amino acids or nucleotides in " +
                       (molecule->path.empty() ? std::string("(unnamed)") : molecule->path) +
                       ", found none among " + std::to_string(molecule->atoms.size()) + " atoms");
  const std::vector<Chain> model_chains = split_chains(model_residues);
  const std::vector<Chain> reference_chains = split_chains(reference_residues);

  // Chains whose names and numbers agree.
  std::vector<Candidate> by_name;
  std::vector<const Chain*> model_left;
  std::vector<const Chain*> reference_left;
  reference_left.reserve(reference_chains.size());
  for (const Chain& c : reference_chains) reference_left.push_back(&c);
  for (const Chain& m : model_chains) {
    const auto same = std::find_if(reference_left.begin(), reference_left.end(),
                                   [&](const Chain* c) { return c->name == m.name; });
    std::optional<Candidate> found;
    if (same != reference_left.end()) found = match_by_number(m, **same);
    if (found) {
      by_name.push_back(std::move(*found));
      reference_left.erase(same);
    } else {
      model_left.push_back(&m);
    }
  }

  // The others, whatever their names.
  CandidateTable table(model_left.size());
  for (std::size_t i = 0; i < model_left.size(); ++i)
    for (const Chain* r : reference_left) {
      std::optional<Candidate> found = match_by_number(*model_left[i], *r);
      if (!found) found = match_by_alignment(*model_left[i], *r);
      table[i].push_back(std::move(found));
    }
  std::vector<const Candidate*> chosen;
  chosen.reserve(by_name.size());
  for (const Candidate& c : by_name) chosen.push_back(&c);
  const bool few = std::max(model_left.size(), reference_left.size()) <= kChainsToPermute;
  const std::vector<const Candidate*> others =
      few ? assign_exhaustively(table, chosen) : assign_greedily(table);
  chosen.insert(chosen.end(), others.begin(), others.end());

  ResidueMatch out;
  out.model_residues = model_residues.size();
  out.reference_residues = reference_residues.size();
  for (const Candidate* c : chosen) {
    out.chains.push_back(c->summary);
    for (const auto& [a, b] : c->pairs) out.pairs.emplace_back(a->index, b->index);
  }
  std::sort(out.pairs.begin(), out.pairs.end());

  const std::size_t smaller = std::min(out.model_residues, out.reference_residues);
  const double wanted = std::max(options.min_fraction * static_cast<double>(smaller),
                                 static_cast<double>(std::min(options.min_residues, smaller)));
  if (out.pairs.empty() || static_cast<double>(out.pairs.size()) < wanted)
    throw InputError("match_residues: expected " +
                     std::to_string(static_cast<std::size_t>(std::max(1.0, wanted))) +
                     " or more residues in common, found " + std::to_string(out.pairs.size()) +
                     " between " + describe(model, model_chains) + " and " +
                     describe(reference, reference_chains));
  return out;
}

}  // namespace mortise
