// SPDX-License-Identifier: GPL-3.0-or-later
// The rotation loop.
#include "mortise/search/rotation_search.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"
#include "mortise/fourier/fft_plan.hpp"
#include "search/components.hpp"
#include "search/correlator.hpp"

namespace mortise {
namespace {

using Clock = std::chrono::steady_clock;

void check_options(const SearchOptions& o) {
  const auto refuse = [](const std::string& what) { throw InputError("search: " + what); };
  if (!(o.spacing > 0.0) || !std::isfinite(o.spacing))
    refuse("spacing must be > 0 and finite, got " + std::to_string(o.spacing));
  if (!(o.cutoff > 0.0)) refuse("cutoff must be > 0, got " + std::to_string(o.cutoff));
  if (o.per_rotation < 1)
    refuse("per_rotation must be >= 1, got " + std::to_string(o.per_rotation));
  if (!(o.separation >= 0.0))
    refuse("separation must be >= 0, got " + std::to_string(o.separation));
  if (!(o.radius_tolerance >= 1e-8 && o.radius_tolerance <= 0.1))
    refuse("radius_tolerance must be in [1e-8, 0.1], got " + std::to_string(o.radius_tolerance));
  if (o.spread_width < 2 || o.spread_width > 8)
    refuse("spread_width must be 2 to 8, got " + std::to_string(o.spread_width));
}

Eigen::Matrix3Xd all_centres(const std::vector<Channel>& channels, Knots Channel::*body) {
  Eigen::Index count = 0;
  for (const Channel& c : channels) count += (c.*body).size();
  Eigen::Matrix3Xd centres(3, count);
  count = 0;
  for (const Channel& c : channels) {
    centres.middleCols(count, (c.*body).size()) = (c.*body).points.topRows<3>();
    count += (c.*body).size();
  }
  return centres;
}

// Principal axes, longest first, right-handed, the first two turned towards the side on which the
// points lie farther out (positive third moment): the frame then depends on the shape alone. Where
// a body is too symmetric to tell, the largest component in the input frame is made positive.
RigidMotion principal_frame(const Eigen::Matrix3Xd& points) {
  const Eigen::Vector3d mean = points.rowwise().mean();
  const Eigen::Matrix3Xd centred = points.colwise() - mean;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(centred * centred.transpose());
  Eigen::Matrix3d axes;
  for (int d = 0; d < 2; ++d) {
    Eigen::Vector3d axis = solver.eigenvectors().col(2 - d);
    const Eigen::ArrayXd along = centred.transpose() * axis;
    const double third = along.cube().sum();
    Eigen::Index largest = 0;
    axis.cwiseAbs().maxCoeff(&largest);
    const double lead = std::abs(third) > 1e-9 * along.abs().cube().sum() ? third : axis[largest];
    axes.row(d) = (lead < 0.0 ? -axis : axis).transpose();
  }
  axes.row(2) = axes.row(0).cross(axes.row(1));
  RigidMotion frame{canonical(Eigen::Quaterniond(axes)), Eigen::Vector3d::Zero()};
  const Eigen::Matrix3Xd turned = frame * points;
  frame.translation = -0.5 * (turned.rowwise().minCoeff() + turned.rowwise().maxCoeff());
  return frame;
}

// Centre of a ball that holds all points, within about 1% of the smallest: Badoiu and Clarkson's
// iteration.
Eigen::Vector3d ball_centre(const Eigen::Matrix3Xd& points) {
  Eigen::Vector3d centre = 0.5 * (points.rowwise().minCoeff() + points.rowwise().maxCoeff());
  for (int i = 1; i <= 100; ++i) {
    Eigen::Index farthest = 0;
    (points.colwise() - centre).colwise().squaredNorm().maxCoeff(&farthest);
    centre += (points.col(farthest) - centre) / (i + 1.0) * 0.5;
  }
  return centre;
}

double hann(double k, double cutoff) {
  return k < cutoff ? 0.5 * (1.0 + std::cos(std::numbers::pi * k / cutoff)) : 0.0;
}

}  // namespace

struct RotationSearch::Impl {
  SearchOptions options;
  Eigen::Matrix4Xd rotations;
  RigidMotion search_from_fixed, search_from_moving;
  Components components;  // spectra are given to the correlator and dropped
  std::vector<Eigen::VectorXf> weights;
  std::unique_ptr<Correlator> correlator;
  std::vector<std::unique_ptr<Correlator::Workspace>> workspaces;
  std::vector<std::uint8_t> done;
  std::vector<Candidate> found;  // per_rotation entries for each rotation; rotation_index -1 = none

  Correlator::Workspace& workspace(int worker) {
    if (!workspaces[worker])
      workspaces[worker] = std::make_unique<Correlator::Workspace>(*correlator);
    return *workspaces[worker];
  }

  Eigen::Matrix3d rotation(Eigen::Index i) const {
    return Eigen::Quaterniond(rotations(0, i), rotations(1, i), rotations(2, i), rotations(3, i))
        .toRotationMatrix();
  }

  // The moving centre's place in the search frame for a score cell, the copy nearest to the fixed
  // body.
  Eigen::Vector3d translation(const std::array<double, 3>& cell) const {
    Eigen::Vector3d t;
    for (int d = 0; d < 3; ++d) {
      const double n = correlator->size()[d];
      // The fixed body is centred on the origin of the search frame, which is grid point 0.
      const double at = cell[d] + correlator->origin_cell()[d];
      t[d] = (at - n * std::round(at / n)) * correlator->spacing();
    }
    return t;
  }

  void search_one(Eigen::Index index, int worker) {
    Correlator::Workspace& w = workspace(worker);
    correlator->correlate(components.points, weights, rotation(index), w);
    const std::vector<GridPeak> peaks = correlator->take_peaks(
        w, options.per_rotation, options.separation / options.spacing, options.summits);
    Candidate* out = found.data() + index * options.per_rotation;
    for (const GridPeak& peak : peaks) {
      std::array<double, 3> cell;
      for (int d = 0; d < 3; ++d) cell[d] = peak.cell[d] + static_cast<double>(peak.offset[d]);
      const Eigen::Vector3f t = translation(cell).cast<float>();
      *out++ = {static_cast<std::int32_t>(index), peak.score, {t[0], t[1], t[2]}};
    }
    done[index] = 1;
  }
};

RotationSearch::RotationSearch(const std::vector<Channel>& channels,
                               const Eigen::Matrix4Xd& rotations, const SearchOptions& options)
    : impl_(std::make_unique<Impl>()) {
  check_options(options);
  if (channels.empty()) throw InputError("search: expected at least one channel, got none");
  double range = 0.0;
  for (const Channel& channel : channels) {
    check_channel(channel, "search");
    range = std::max(range, channel.range);
  }
  if (rotations.cols() == 0) throw InputError("search: expected at least one rotation, got none");
  if (!rotations.allFinite() || (rotations.colwise().norm().array() - 1.0).abs().maxCoeff() > 1e-6)
    throw InputError("search: every rotation must be a unit quaternion");
  impl_->options = options;
  impl_->rotations = rotations.colwise().normalized();  // the corner has no room for 1e-6 more

  const Eigen::Matrix3Xd fixed = all_centres(channels, &Channel::fixed);
  impl_->search_from_fixed = principal_frame(fixed);
  const Eigen::Matrix3Xd moving = all_centres(channels, &Channel::moving);
  impl_->search_from_moving.translation = -ball_centre(moving);
  const double reach =
      (impl_->search_from_moving * moving).colwise().norm().maxCoeff() + 1e-9 * options.spacing;
  const Eigen::Vector3d half = (impl_->search_from_fixed * fixed).cwiseAbs().rowwise().maxCoeff();
  std::array<int, 3> size;
  double cells = 1.0;
  for (int d = 0; d < 3; ++d) {
    // Far enough that the moving body never touches two copies of the fixed one at once (one range
    // on either side of it), and that the copy it touches is the one nearest to its centre.
    const double side = 2.0 * half[d] + 2.0 * reach + 2.0 * range;
    cells *= side / options.spacing;
    if (!(cells < 1e9))
      throw InputError("search: the grid would have more than a billion points; spacing " +
                       std::to_string(options.spacing) + " is too fine for bodies of this size");
    size[d] = good_fft_size(
        std::max(2 * options.spread_width, static_cast<int>(std::ceil(side / options.spacing))));
  }
  impl_->components = make_components(channels, impl_->search_from_fixed, size, options.spacing,
                                      {.radius_tolerance = options.radius_tolerance,
                                       .low_pass = {.cutoff = options.cutoff},
                                       .threads = options.threads});
  if (impl_->components.parts.empty())
    throw InputError("search: all weights of every channel are zero");
  impl_->components.points = impl_->search_from_moving * impl_->components.points;
  impl_->correlator = std::make_unique<Correlator>(size, options.spacing, reach,
                                                   static_cast<int>(impl_->components.parts.size()),
                                                   options.spread_width);
  for (std::size_t p = 0; p < impl_->components.parts.size(); ++p) {
    Component& part = impl_->components.parts[p];
    impl_->weights.push_back(part.weights);
    const auto [nx, ny, nz] = size;
    impl_->correlator->set_fixed(
        static_cast<int>(p), [&, nx = nx, ny = ny, nz = nz](int kx, int ky, int kz) {
          const double k = Eigen::Vector3d(kx / (nx * options.spacing), ky / (ny * options.spacing),
                                           kz / (nz * options.spacing))
                               .norm();
          const std::size_t at =
              (static_cast<std::size_t>(kx + nx / 2) * ny + (ky + ny / 2)) * (nz / 2 + 1) + kz;
          return part.spectra[0][at] * hann(k, options.cutoff);
        });
    part = {};
  }
  impl_->workspaces.resize(resolve_threads(options.threads));
  impl_->done.assign(rotations.cols(), 0);
  impl_->found.resize(static_cast<std::size_t>(rotations.cols()) * options.per_rotation);
}

RotationSearch::~RotationSearch() = default;
RotationSearch::RotationSearch(RotationSearch&&) noexcept = default;
RotationSearch& RotationSearch::operator=(RotationSearch&&) noexcept = default;

bool RotationSearch::run(const ProgressCallback& progress) {
  std::vector<Eigen::Index> todo;
  for (Eigen::Index i = 0; i < impl_->rotations.cols(); ++i)
    if (impl_->done[i] == 0) todo.push_back(i);
  const std::size_t before = impl_->done.size() - todo.size();
  std::size_t next = 0, block = 16 * impl_->workspaces.size();
  while (next < todo.size()) {
    const auto start = Clock::now();
    const std::size_t count = std::min(block, todo.size() - next);
    parallel_for(count, impl_->options.threads,
                 [&](std::size_t i, int worker) { impl_->search_one(todo[next + i], worker); });
    next += count;
    if (progress && !progress(before + next, impl_->done.size()) && next < todo.size())
      return false;
    // Blocks of about a tenth of a second: rare enough to cost nothing, often enough to stop soon.
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (seconds < 0.07) block *= 2;
    if (seconds > 0.2) block = std::max(impl_->workspaces.size(), block / 2);
  }
  return true;
}

const std::vector<std::uint8_t>& RotationSearch::done() const { return impl_->done; }

std::vector<Candidate> RotationSearch::candidates() const {
  std::vector<Candidate> result;
  for (const Candidate& c : impl_->found)
    if (c.rotation_index >= 0) result.push_back(c);
  return result;
}

void RotationSearch::resume(const std::vector<std::uint8_t>& done,
                            const std::vector<Candidate>& candidates) {
  const auto refuse = [](const std::string& what) {
    throw InputError("search: the interrupted search's " + what);
  };
  if (done.size() != impl_->done.size())
    throw InputError("search: the interrupted search had " + std::to_string(done.size()) +
                     " rotations, this one has " + std::to_string(impl_->done.size()));
  std::vector<std::uint8_t> now(done.size());
  std::transform(done.begin(), done.end(), now.begin(),
                 [](std::uint8_t d) { return static_cast<std::uint8_t>(d != 0); });
  std::vector<Candidate> found(impl_->found.size());
  std::vector<int> filled(done.size(), 0);
  for (const Candidate& c : candidates) {
    if (c.rotation_index < 0 || static_cast<std::size_t>(c.rotation_index) >= done.size() ||
        now[c.rotation_index] == 0)
      refuse("candidates are of rotations that it has not searched");
    if (filled[c.rotation_index] >= impl_->options.per_rotation)
      refuse("candidates are more than " + std::to_string(impl_->options.per_rotation) +
             " at a rotation");
    found[static_cast<std::size_t>(c.rotation_index) * impl_->options.per_rotation +
          filled[c.rotation_index]++] = c;
  }
  for (std::size_t r = 0; r < done.size(); ++r)
    if (now[r] != 0 && filled[r] == 0)
      refuse("candidates lack those of a rotation it has searched");
  impl_->done = std::move(now);
  impl_->found = std::move(found);
}

const RigidMotion& RotationSearch::search_from_fixed() const { return impl_->search_from_fixed; }
const RigidMotion& RotationSearch::search_from_moving() const { return impl_->search_from_moving; }

RigidMotion RotationSearch::moving_in_fixed(const Candidate& candidate) const {
  return candidate_motion(candidate,
                          {impl_->rotations, impl_->search_from_fixed, impl_->search_from_moving});
}

const std::array<int, 3>& RotationSearch::grid_size() const { return impl_->correlator->size(); }
double RotationSearch::spacing() const { return impl_->correlator->spacing(); }

std::vector<float> RotationSearch::score_grid(Eigen::Index rotation) {
  Correlator::Workspace& w = impl_->workspace(0);
  impl_->correlator->correlate(impl_->components.points, impl_->weights, impl_->rotation(rotation),
                               w);
  const auto [nx, ny, nz] = impl_->correlator->size();
  std::vector<float> grid;
  grid.reserve(static_cast<std::size_t>(nx) * ny * nz);
  for (int r = 0; r < nx * ny; ++r) {
    const float* row = w.scores.data() + static_cast<std::ptrdiff_t>(r) * impl_->correlator->row();
    grid.insert(grid.end(), row, row + nz);
  }
  return grid;
}

Eigen::Vector3d RotationSearch::translation_of(int i, int j, int k) const {
  return impl_->translation(
      {static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
}

double bare_fft_seconds(const std::array<int, 3>& grid_size) {
  const auto [nx, ny, nz] = grid_size;
  const std::ptrdiff_t nc = nz / 2 + 1;
  // Both arrays contiguous, as FFTW's own simple interface has them.
  const auto forward = FftPlan<float>::real_to_complex(
      {{{nx, std::ptrdiff_t{ny} * nz, ny * nc}, {ny, nz, nc}, {nz, 1, 1}}, {}}, false,
      PlanRigor::kMeasure);
  const auto backward = FftPlan<float>::complex_to_real(
      {{{nx, ny * nc, std::ptrdiff_t{ny} * nz}, {ny, nc, nz}, {nz, 1, 1}}, {}}, false,
      PlanRigor::kMeasure);
  AlignedVector<float> real(static_cast<std::size_t>(nx) * ny * nz, 0.0F);
  AlignedVector<std::complex<float>> half(static_cast<std::size_t>(nx) * ny * nc);
  double best = std::numeric_limits<double>::infinity();
  const auto begin = Clock::now();
  for (int i = 0; i < 200 && (i < 5 || Clock::now() - begin < std::chrono::milliseconds(60)); ++i) {
    const auto start = Clock::now();
    forward.run(real.data(), half.data());
    backward.run(half.data(), real.data());
    best = std::min(best, std::chrono::duration<double>(Clock::now() - start).count());
  }
  return best;
}

}  // namespace mortise
