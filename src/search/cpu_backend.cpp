// SPDX-License-Identifier: GPL-3.0-or-later
// Rotations searched on the processor's cores.
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "mortise/core/threads.hpp"
#include "search/backend.hpp"
#include "search/correlator.hpp"
#include "search/lifted_correlator.hpp"

namespace mortise {
namespace {

// One thread's part of either form: all offsets at a rotation, then the scores of one after the
// other.
class Worker {
 public:
  virtual ~Worker() = default;
  virtual void correlate(const Eigen::Matrix3d& rotation) = 0;
  virtual ScoreBox& scores(int offset) = 0;
};

class CompressedWorker : public Worker {
 public:
  CompressedWorker(const Correlator& correlator, const Eigen::Matrix3Xd& points,
                   const std::vector<Eigen::VectorXf>& weights)
      : correlator_(correlator), points_(points), weights_(weights), workspace_(correlator) {}
  void correlate(const Eigen::Matrix3d& rotation) override {
    correlator_.correlate(points_, weights_, rotation, workspace_);
  }
  ScoreBox& scores(int offset) override {
    correlator_.backward_yz(offset, workspace_);
    return workspace_.box;
  }

 private:
  const Correlator& correlator_;
  const Eigen::Matrix3Xd& points_;
  const std::vector<Eigen::VectorXf>& weights_;
  Correlator::Workspace workspace_;
};

class LiftedWorker : public Worker {
 public:
  explicit LiftedWorker(const LiftedCorrelator& correlator)
      : correlator_(correlator), workspace_(correlator) {}
  void correlate(const Eigen::Matrix3d& rotation) override {
    correlator_.correlate(rotation, workspace_);
  }
  ScoreBox& scores(int offset) override {
    correlator_.finish(offset, workspace_);
    return workspace_.box;
  }

 private:
  const LiftedCorrelator& correlator_;
  LiftedCorrelator::Workspace workspace_;
};

class CpuBackend : public SearchBackend {
 public:
  explicit CpuBackend(SearchSetup setup)
      : options_(setup.options),
        size_(setup.size),
        origin_(corner_middle(setup.size, setup.options.spacing, setup.reach,
                              setup.options.spread_width)) {
    workers_.resize(resolve_threads(options_.threads));
    if (options_.lift == SearchLift::k4d) {
      lifted_ = std::make_unique<LiftedCorrelator>(size_, options_.spacing, origin_,
                                                   std::move(setup.lifted), options_.offsets);
      make_worker_ = [this] { return std::make_unique<LiftedWorker>(*lifted_); };
      return;
    }
    const auto parts = static_cast<int>(setup.components.parts.size());
    const auto offsets = static_cast<int>(options_.offsets.size());
    correlator_ = std::make_unique<Correlator>(size_, options_.spacing, setup.reach, parts,
                                               options_.spread_width, offsets);
    points_ = std::move(setup.components.points);
    for (int p = 0; p < parts; ++p) {
      Component& part = setup.components.parts[p];
      weights_.push_back(std::move(part.weights));
      for (int o = 0; o < offsets; ++o) {
        const HalfSpectrum& spectrum = part.spectra[o];
        correlator_->set_fixed(p, o, [&](int kx, int ky, int kz) {
          return spectrum[(static_cast<std::size_t>(kx + size_[0] / 2) * size_[1] +
                           (ky + size_[1] / 2)) *
                              (size_[2] / 2 + 1) +
                          kz];
        });
      }
      part.spectra.clear();
    }
    make_worker_ = [this] {
      return std::make_unique<CompressedWorker>(*correlator_, points_, weights_);
    };
  }

  std::vector<Candidate> search(const std::vector<Eigen::Matrix3d>& rotations) override {
    const std::size_t per_offset = options_.per_rotation,
                      per_rotation = per_offset * options_.offsets.size();
    std::vector<Candidate> found(rotations.size() * per_rotation);
    parallel_for(rotations.size(), options_.threads, [&](std::size_t r, int thread) {
      Worker& w = worker(thread);
      w.correlate(rotations[r]);
      for (std::size_t o = 0; o < options_.offsets.size(); ++o) {
        const std::vector<GridPeak> peaks =
            w.scores(static_cast<int>(o))
                .take_peaks(options_.per_rotation, options_.separation / options_.spacing,
                            options_.summits);
        Candidate* out = found.data() + r * per_rotation + o * per_offset;
        for (const GridPeak& peak : peaks) {
          std::array<double, 3> cell;
          for (int d = 0; d < 3; ++d) cell[d] = peak.cell[d] + static_cast<double>(peak.offset[d]);
          const Eigen::Vector3f t = translation(cell).cast<float>();
          *out++ = {static_cast<std::int32_t>(r),
                    peak.score,
                    {t[0], t[1], t[2]},
                    static_cast<std::int32_t>(o)};
        }
      }
    });
    return found;
  }

  std::size_t least_batch() const override { return workers_.size(); }

  std::vector<float> score_grid(const Eigen::Matrix3d& rotation, int offset) override {
    Worker& w = worker(0);
    w.correlate(rotation);
    return w.scores(offset).grid();
  }

  // The copy nearest to the fixed body.
  Eigen::Vector3d translation(const std::array<double, 3>& cell) const override {
    Eigen::Vector3d t;
    for (int d = 0; d < 3; ++d) {
      const double n = size_[d];
      // The fixed body is centred on the origin of the search frame, which is grid point 0.
      const double at = cell[d] + origin_[d];
      t[d] = (at - n * std::round(at / n)) * options_.spacing;
    }
    return t;
  }

 private:
  Worker& worker(int thread) {
    if (!workers_[thread]) workers_[thread] = make_worker_();
    return *workers_[thread];
  }

  SearchOptions options_;
  std::array<int, 3> size_;
  std::array<double, 3> origin_;
  std::unique_ptr<Correlator> correlator_;
  Eigen::Matrix3Xd points_;
  std::vector<Eigen::VectorXf> weights_;
  std::unique_ptr<LiftedCorrelator> lifted_;
  std::function<std::unique_ptr<Worker>()> make_worker_;
  std::vector<std::unique_ptr<Worker>> workers_;
};

}  // namespace

std::unique_ptr<SearchBackend> make_cpu_backend(SearchSetup setup) {
  return std::make_unique<CpuBackend>(std::move(setup));
}

}  // namespace mortise
