// SPDX-License-Identifier: GPL-3.0-or-later
// A score of one's own in a docking run: poses whose receptor chain end is buried gain a bonus.
// Usage: own_scorer RECEPTOR LIGAND; prints the ten best poses with the columns of their scores.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>

#include "mortise/runs/dock.hpp"
#include "mortise/store/body.hpp"

namespace {

/// Column "tail": `bonus` where a ligand atom comes within `reach` angstrom of a receptor atom.
class NearAtom : public mortise::PoseScorer {
 public:
  NearAtom(Eigen::Vector3d atom, const mortise::Molecule& ligand) : atom_(std::move(atom)) {
    ligand_.resize(3, static_cast<Eigen::Index>(ligand.atoms.size()));
    for (std::size_t i = 0; i < ligand.atoms.size(); ++i)
      ligand_.col(static_cast<Eigen::Index>(i)) = ligand.atoms[i].position;
  }
  [[nodiscard]] std::vector<std::string> columns() const override { return {"tail"}; }
  [[nodiscard]] Eigen::MatrixXd score(const std::vector<mortise::RigidMotion>& poses,
                                      int) const override {
    constexpr double reach = 6.0, bonus = 5.0;
    Eigen::MatrixXd result(1, static_cast<Eigen::Index>(poses.size()));
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const Eigen::Vector3d there = mortise::inverse(poses[i]) * atom_;  // in the ligand's frame
      const double nearest = (ligand_.colwise() - there).colwise().norm().minCoeff();
      result(0, static_cast<Eigen::Index>(i)) = nearest < reach ? bonus : 0.0;
    }
    return result;
  }

 private:
  Eigen::Vector3d atom_;
  Eigen::Matrix3Xd ligand_;
};

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) return std::fprintf(stderr, "usage: own_scorer RECEPTOR LIGAND\n"), 1;
  const mortise::Body receptor = mortise::read_body(argv[1]), ligand = mortise::read_body(argv[2]);
  mortise::SearchPlan plan = mortise::plan_dock(receptor, ligand, {.rotations = 60, .poses = 10});
  // Before polish, while there are many poses: its column joins those of shape and contact.
  plan.stages.front().keep = 100;
  plan.stages.insert(plan.stages.begin() + 1,
                     {.name = "tail",
                      .scorer = std::make_shared<NearAtom>(
                          receptor.molecule()->atoms.back().position, *ligand.molecule())});
  const mortise::Run run = mortise::run_plan(plan, mortise::make_provenance("own_scorer"));
  for (const std::string& name : run.poses.channel_names) std::printf("%10s", name.c_str());
  for (const mortise::Pose& pose : run.poses.poses) {
    std::printf("\n");
    for (const double value : pose.channels) std::printf("%10.3f", value);
  }
  std::printf("\n");
} catch (const std::exception& e) {
  std::fprintf(stderr, "own_scorer: %s\n", e.what());
  return 1;
}
