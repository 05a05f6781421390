// SPDX-License-Identifier: GPL-3.0-or-later
// The rotation loop.
#include "mortise/search/rotation_search.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>

#include "mortise/core/errors.hpp"
#include "mortise/core/principal_frame.hpp"
#include "mortise/fourier/aligned.hpp"
#include "mortise/fourier/fft_plan.hpp"
#include "search/backend.hpp"

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
  if (o.offsets.empty()) refuse("expected at least one offset, got none");
  for (const double offset : o.offsets)
    if (!std::isfinite(offset)) refuse("offsets must be finite, got " + std::to_string(offset));
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

}  // namespace

struct RotationSearch::Impl {
  SearchOptions options;
  Eigen::Matrix4Xd rotations;
  RigidMotion search_from_fixed, search_from_moving;
  std::array<int, 3> size;
  std::unique_ptr<SearchBackend> backend;
  std::vector<std::uint8_t> done;
  std::vector<Candidate> found;  // per_rotation entries for each offset of each rotation;
                                 // rotation_index -1 = none

  [[nodiscard]] std::size_t per_rotation() const {
    return options.offsets.size() * static_cast<std::size_t>(options.per_rotation);
  }

  [[nodiscard]] Eigen::Matrix3d rotation(Eigen::Index i) const {
    return Eigen::Quaterniond(rotations(0, i), rotations(1, i), rotations(2, i), rotations(3, i))
        .toRotationMatrix();
  }
};

RigidMotion search_frame(const std::vector<Channel>& channels) {
  if (channels.empty()) throw InputError("search: expected at least one channel, got none");
  return principal_frame(all_centres(channels, &Channel::fixed));
}

RotationSearch::RotationSearch(const std::vector<Channel>& channels,
                               const Eigen::Matrix4Xd& rotations, const SearchOptions& options)
    : impl_(std::make_unique<Impl>()) {
  check_options(options);
  if (channels.empty()) throw InputError("search: expected at least one channel, got none");
  double range = 0.0, least_radius = std::numeric_limits<double>::infinity();
  for (const Channel& channel : channels) {
    check_channel(channel, "search");
    range = std::max(range, channel.range);
    least_radius = std::min(least_radius, channel.moving.points.row(3).minCoeff());
  }
  const auto [least_offset, most_offset] =
      std::minmax_element(options.offsets.begin(), options.offsets.end());
  if (!(least_radius + *least_offset > 0.0))
    throw InputError("search: offset " + std::to_string(*least_offset) +
                     " leaves nothing of the smallest moving radius, " +
                     std::to_string(least_radius));
  range += std::max(0.0, *most_offset);
  if (rotations.cols() == 0) throw InputError("search: expected at least one rotation, got none");
  if (!rotations.allFinite() || (rotations.colwise().norm().array() - 1.0).abs().maxCoeff() > 1e-6)
    throw InputError("search: every rotation must be a unit quaternion");
  impl_->options = options;
  impl_->rotations = rotations.colwise().normalized();  // the corner has no room for 1e-6 more

  const Eigen::Matrix3Xd fixed = all_centres(channels, &Channel::fixed);
  impl_->search_from_fixed = search_frame(channels);
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
  impl_->size = size;
  SearchSetup setup{size, reach, {}, {}, options};
  const ComponentOptions component_options{.radius_tolerance = options.radius_tolerance,
                                           .low_pass = {.cutoff = options.cutoff},
                                           .offsets = options.offsets,
                                           .threads = options.threads};
  bool any = false;
  if (options.lift == SearchLift::k4d) {
    setup.lifted = make_lifted_parts(channels, impl_->search_from_fixed, size, options.spacing,
                                     component_options);
    for (LiftedPart& part : setup.lifted.parts)
      part.points.bottomRows<3>() =
          impl_->search_from_moving * Eigen::Matrix3Xd(part.points.bottomRows<3>());
    any = !setup.lifted.parts.empty();
  } else {
    setup.components = make_components(channels, impl_->search_from_fixed, size, options.spacing,
                                       component_options);
    setup.components.points = impl_->search_from_moving * setup.components.points;
    any = !setup.components.parts.empty();
  }
  if (!any) throw InputError("search: all weights of every channel are zero");
  impl_->backend = make_cpu_backend(std::move(setup));
  impl_->done.assign(rotations.cols(), 0);
  impl_->found.resize(static_cast<std::size_t>(rotations.cols()) * impl_->per_rotation());
}

RotationSearch::~RotationSearch() = default;
RotationSearch::RotationSearch(RotationSearch&&) noexcept = default;
RotationSearch& RotationSearch::operator=(RotationSearch&&) noexcept = default;

bool RotationSearch::run(const ProgressCallback& progress) {
  std::vector<Eigen::Index> todo;
  for (Eigen::Index i = 0; i < impl_->rotations.cols(); ++i)
    if (impl_->done[i] == 0) todo.push_back(i);
  const std::size_t before = impl_->done.size() - todo.size();
  std::size_t next = 0, block = 16 * impl_->backend->least_batch();
  while (next < todo.size()) {
    const auto start = Clock::now();
    const std::size_t count = std::min(block, todo.size() - next);
    std::vector<Eigen::Matrix3d> batch;
    for (std::size_t i = 0; i < count; ++i) batch.push_back(impl_->rotation(todo[next + i]));
    const std::vector<Candidate> found = impl_->backend->search(batch);
    const std::size_t per = impl_->per_rotation();
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Index r = todo[next + i];
      for (std::size_t n = 0; n < per; ++n) {
        Candidate& c = impl_->found[static_cast<std::size_t>(r) * per + n] = found[i * per + n];
        if (c.rotation_index >= 0) c.rotation_index = static_cast<std::int32_t>(r);
      }
      impl_->done[r] = 1;
    }
    next += count;
    if (progress && !progress(before + next, impl_->done.size()) && next < todo.size())
      return false;
    // Blocks of about a tenth of a second: rare enough to cost nothing, often enough to stop soon.
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (seconds < 0.07) block *= 2;
    if (seconds > 0.2) block = std::max(impl_->backend->least_batch(), block / 2);
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
  const std::size_t offsets = impl_->options.offsets.size();
  std::vector<int> filled(done.size() * offsets, 0);
  for (const Candidate& c : candidates) {
    if (c.rotation_index < 0 || static_cast<std::size_t>(c.rotation_index) >= done.size() ||
        now[c.rotation_index] == 0)
      refuse("candidates are of rotations that it has not searched");
    if (c.offset_index < 0 || static_cast<std::size_t>(c.offset_index) >= offsets)
      refuse("candidates are of offsets that this one has not");
    const std::size_t at = static_cast<std::size_t>(c.rotation_index) * offsets + c.offset_index;
    if (filled[at] >= impl_->options.per_rotation)
      refuse("candidates are more than " + std::to_string(impl_->options.per_rotation) +
             " at a rotation");
    found[at * impl_->options.per_rotation + filled[at]++] = c;
  }
  for (std::size_t at = 0; at < filled.size(); ++at)
    if (now[at / offsets] != 0 && filled[at] == 0)
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

const std::array<int, 3>& RotationSearch::grid_size() const { return impl_->size; }
double RotationSearch::spacing() const { return impl_->options.spacing; }

std::vector<float> RotationSearch::score_grid(Eigen::Index rotation, int offset_index) {
  if (rotation < 0 || rotation >= impl_->rotations.cols() || offset_index < 0 ||
      static_cast<std::size_t>(offset_index) >= impl_->options.offsets.size())
    throw InputError("search: no rotation " + std::to_string(rotation) + " or no offset " +
                     std::to_string(offset_index));
  return impl_->backend->score_grid(impl_->rotation(rotation), offset_index);
}

Eigen::Vector3d RotationSearch::translation_of(int i, int j, int k) const {
  return impl_->backend->translation(
      {static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
}

}  // namespace mortise
