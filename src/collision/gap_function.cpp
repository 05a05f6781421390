// SPDX-License-Identifier: GPL-3.0-or-later
// The gap function: its modes, its spectra, its sum; derivation in docs/math.md.
#include "mortise/collision/gap_function.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "collision/gap_state.hpp"
#include "core/isa.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"

namespace mortise {

namespace isa_baseline {
extern const GapTable kGapTable;
}
namespace isa_avx2 {
extern const GapTable kGapTable;
}
namespace isa_avx512 {
extern const GapTable kGapTable;
}

namespace {

constexpr double kTolerance = 1e-7;  // of the spectra: single precision's own

}  // namespace

// Gradients about the ball's centre to gradients about the moving body's origin.
GapValue GapFunction::State::finish(const RigidMotion& pose, double value,
                                    const Eigen::Vector3d& slope,
                                    const Eigen::Vector3d& spin) const {
  const Eigen::Vector3d arm = pose.rotation * moving_ball.centre;
  return {value, slope, spin + arm.cross(slope)};
}

GapJob GapFunction::State::job(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& t,
                               std::size_t part) const {
  const SpectrumTable& samples = tables[part];
  GapJob result = {};
  result.kx = frequency[0].data(), result.ky = frequency[1].data(), result.kz = frequency[2].data();
  result.real = real[part].data(), result.imag = imag[part].data();
  result.table = samples.samples.data();
  result.stride_y = 4 * static_cast<std::ptrdiff_t>(samples.size);
  result.stride_x = result.stride_y * samples.size;
  result.pieces = kernel.pieces.data();
  result.centre = static_cast<float>(samples.size / 2);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      result.turn[3 * row + column] = static_cast<float>(rotation(column, row) * samples.box / box);
    result.translation[row] = static_cast<float>(t[row] / box);
  }
  return result;
}

GapFunction::GapFunction(const BodyDensity& fixed, const BodyDensity& moving,
                         const GapOptions& options) {
  for (const BodyDensity* density : {&fixed, &moving}) {
    if (density->size() < 1 || density->weights.size() != density->size() ||
        (density->radii.size() != 0 && density->radii.size() != density->size()))
      throw InputError(
          "GapFunction: a density needs one weight, and one radius or none, per point");
    if (!density->points.allFinite() || !density->weights.allFinite() ||
        !(density->radii.array() > 0.0).all())
      throw InputError("GapFunction: points and weights must be finite, radii > 0");
  }
  if (fixed.is_real() != moving.is_real())
    throw InputError("GapFunction: one density is real and the other complex");
  if (options.max_modes < 1)
    throw InputError("GapFunction: max_modes must be >= 1, got " +
                     std::to_string(options.max_modes));
  if (!(options.oversampling >= 1.5 && options.oversampling <= 4.0))
    throw InputError("GapFunction: oversampling must be in [1.5, 4], got " +
                     std::to_string(options.oversampling));
  state_ = std::make_unique<State>(options.oversampling);
  State& s = *state_;
  s.moving = moving;
  s.fixed_ball = bounding_ball(fixed);
  s.moving_ball = bounding_ball(moving);
  const double reach = s.fixed_ball.radius + s.moving_ball.radius;
  if (!(options.box == 0.0 || options.box >= 2.0 * reach))
    throw InputError("GapFunction: box must be at least twice the sum of the bodies' radii, " +
                     std::to_string(2.0 * reach) + ", got " + std::to_string(options.box));
  s.box = options.box > 0.0 ? options.box : std::max(2.0 * reach, 1e-300);

  const int half = (options.max_modes + 1) / 2;
  const int modes_reach = State::reach_of(half);
  const int side = 2 * (modes_reach + 1);
  const Eigen::MatrixXcd spectrum =
      density_spectrum(fixed, s.fixed_ball.centre, side, s.box, kTolerance, options.threads);

  const double samples_box =
      2.0 * options.oversampling * std::max(s.moving_ball.radius, 1e-6 * s.box);
  const int samples = 2 * (static_cast<int>(std::ceil(modes_reach / s.box * samples_box)) + 3 +
                           SpectrumTable::kMargin);
  const Eigen::MatrixXcd samples_spectrum = density_spectrum(
      moving, s.moving_ball.centre, samples, samples_box, kTolerance, options.threads);
  for (Eigen::Index p = 0; p < samples_spectrum.cols(); ++p)
    s.tables.push_back(make_table(samples_spectrum.col(p), samples, samples_box, s.kernel));

  s.order_modes(half, spectrum, side, options);
  s.pack();
  s.measure_error(options.threads);
  s.measure_tails();
  s.table =
      &pick_isa(best_isa(), isa_baseline::kGapTable, isa_avx2::kGapTable, isa_avx512::kGapTable);
}

GapFunction::~GapFunction() = default;
GapFunction::GapFunction(GapFunction&&) noexcept = default;
GapFunction& GapFunction::operator=(GapFunction&&) noexcept = default;

GapValue GapFunction::operator()(const RigidMotion& pose, int modes) const {
  check_motion(pose, "GapFunction");  // other quaternions would lead out of the samples
  const State& s = *state_;
  const Eigen::Vector3d t = s.shift(pose);
  if (!(t.norm() < s.fixed_ball.radius + s.moving_ball.radius)) return {};
  const Eigen::Matrix3d rotation = pose.rotation.toRotationMatrix();
  const int half = s.half_count(modes);
  const int whole = half / kModeBlock * kModeBlock;
  GapSums total = {};
  for (std::size_t p = 0; p < s.tables.size(); ++p) {
    GapJob job = s.job(rotation, t, p);
    job.count = whole;
    const auto add = [&](const GapJob& part) {
      GapSums sums;
      s.table->sum(part, &sums);
      total.value += sums.value;
      for (int d = 0; d < 3; ++d) {
        total.translation[d] += sums.translation[d];
        total.rotation[d] += sums.rotation[d];
      }
    };
    if (whole > 0) add(job);
    if (whole < half) {  // the begun block, with the coefficients behind the last mode set to zero
      alignas(64) float k[3][kModeBlock], real[kModeBlock] = {}, imag[kModeBlock] = {};
      for (int d = 0; d < 3; ++d) std::memcpy(k[d], s.frequency[d].data() + whole, sizeof k[d]);
      std::memcpy(real, job.real + whole, sizeof(float) * (half - whole));
      std::memcpy(imag, job.imag + whole, sizeof(float) * (half - whole));
      job.kx = k[0], job.ky = k[1], job.kz = k[2], job.real = real, job.imag = imag;
      job.count = kModeBlock;
      add(job);
    }
  }
  const Eigen::Vector3d slope = Eigen::Map<const Eigen::Vector3d>(total.translation);
  const Eigen::Vector3d spin = Eigen::Map<const Eigen::Vector3d>(total.rotation);
  return s.finish(pose, total.value, -kWholeTurn / s.box * slope, -(rotation * spin));
}

void GapFunction::evaluate(std::span<const RigidMotion> poses, std::span<GapValue> values,
                           int modes, int threads) const {
  if (poses.size() != values.size())
    throw InputError("GapFunction::evaluate: " + std::to_string(poses.size()) +
                     " poses, room for " + std::to_string(values.size()) + " values");
  constexpr std::size_t kBatch = 64;
  parallel_for((poses.size() + kBatch - 1) / kBatch, threads, [&](std::size_t batch, int) {
    for (std::size_t i = batch * kBatch; i < std::min(poses.size(), (batch + 1) * kBatch); ++i)
      values[i] = (*this)(poses[i], modes);
  });
}

GapValue GapFunction::exact(const RigidMotion& pose, int modes) const {
  check_motion(pose, "GapFunction::exact");
  const State& s = *state_;
  const Eigen::Vector3d t = s.shift(pose);
  if (!(t.norm() < s.fixed_ball.radius + s.moving_ball.radius)) return {};
  const Eigen::Matrix3d rotation = pose.rotation.toRotationMatrix();
  const int half = s.half_count(modes);
  Eigen::Matrix3Xd frequencies(3, half);
  for (int i = 0; i < half; ++i)
    frequencies.col(i) = rotation.transpose() * s.modes[i].cast<double>() / s.box;
  const Eigen::MatrixXcd g = density_spectrum_at(s.moving, s.moving_ball.centre, frequencies, 1);
  double value = 0.0;
  Eigen::Vector3d slope = Eigen::Vector3d::Zero(), spin = Eigen::Vector3d::Zero();
  for (int i = 0; i < half; ++i) {
    const Eigen::Vector3d k = s.modes[i].cast<double>();
    const std::complex<double> phase = std::polar(1.0, kWholeTurn * k.dot(t) / s.box);
    for (Eigen::Index p = 0; p < s.coefficients.cols(); ++p) {
      const std::complex<double> product = s.coefficients(i, p) * phase, own = g(i, 4 * p);
      value += (product * std::conj(own)).real();
      slope += k * (product * std::conj(own)).imag();
      Eigen::Vector3d gradient;
      for (int d = 0; d < 3; ++d) gradient[d] = (product * std::conj(g(i, 4 * p + 1 + d))).real();
      spin += frequencies.col(i).cross(gradient);
    }
  }
  return s.finish(pose, value, -kWholeTurn / s.box * slope, -(rotation * spin));
}

int GapFunction::modes() const noexcept { return 2 * static_cast<int>(state_->modes.size()) - 1; }
double GapFunction::box() const noexcept { return state_->box; }
double GapFunction::bandwidth() const noexcept { return state_->bandwidth; }
const BoundingBall& GapFunction::fixed_ball() const noexcept { return state_->fixed_ball; }
const BoundingBall& GapFunction::moving_ball() const noexcept { return state_->moving_ball; }
double GapFunction::interpolation_error() const noexcept { return state_->interpolation_error; }

double GapFunction::sum_error_bound() const noexcept {
  return state_->kernel.error_bound * state_->moving_mass * state_->head.back();
}

}  // namespace mortise
