// SPDX-License-Identifier: GPL-3.0-or-later
// Densities of knots and of samples, and their spectra.
#include "mortise/collision/body_density.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "mortise/core/errors.hpp"
#include "mortise/core/threads.hpp"
#include "mortise/fourier/lifted_spectrum.hpp"
#include "mortise/fourier/nfft.hpp"

namespace mortise {

BodyDensity density_of_knots(const Knots& knots, const RadialKernel& kernel, double offset) {
  check_knots(knots, "density_of_knots");
  if (!std::isfinite(offset)) throw InputError("density_of_knots: offset must be finite");
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < knots.size(); ++i)
    if (knots.points(3, i) + offset > 0.0) kept.push_back(i);
  if (kept.empty())
    throw InputError("density_of_knots: offset " + std::to_string(offset) + " leaves no ball");
  return {knots.points(Eigen::seqN(0, 3), kept), knots.points(3, kept).transpose().array() + offset,
          knots.weights(kept), kernel};
}

BodyDensity density_of_samples(std::span<const std::complex<float>> values,
                               const std::array<int, 3>& size, const Eigen::Vector3d& origin,
                               double spacing) {
  if (!(spacing > 0.0))
    throw InputError("density_of_samples: spacing must be > 0, got " + std::to_string(spacing));
  const std::size_t wanted = static_cast<std::size_t>(size[0]) * size[1] * size[2];
  if (values.size() != wanted)
    throw InputError("density_of_samples: expected " + std::to_string(wanted) + " values, got " +
                     std::to_string(values.size()));
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] != std::complex<float>()) kept.push_back(i);
  if (kept.empty()) throw InputError("density_of_samples: all samples are zero");
  BodyDensity density;
  const Eigen::Index count = static_cast<Eigen::Index>(kept.size());
  density.points.resize(3, count);
  density.weights.resize(count);
  const double volume = spacing * spacing * spacing;
  for (Eigen::Index i = 0; i < count; ++i) {
    const std::size_t at = kept[i], row = at / size[2];
    density.points.col(i) = origin + spacing * Eigen::Vector3d(static_cast<double>(row / size[1]),
                                                               static_cast<double>(row % size[1]),
                                                               static_cast<double>(at % size[2]));
    density.weights[i] = volume * std::complex<double>(values[at]);
  }
  return density;
}

BoundingBall bounding_ball(const BodyDensity& density) {
  const auto reach = [&](const Eigen::Vector3d& centre, Eigen::Index* farthest) {
    double most = -1.0;
    for (Eigen::Index i = 0; i < density.size(); ++i) {
      const double r = (density.points.col(i) - centre).norm() +
                       (density.radii.size() > 0 ? density.radii[i] : 0.0);
      if (r > most) most = r, *farthest = i;
    }
    return most;
  };
  // The box's centre, then steps of decreasing length towards the farthest ball [Badoiu and
  // Clarkson 2003]: within about a percent of the smallest ball.
  BoundingBall best{0.5 *
                    (density.points.rowwise().minCoeff() + density.points.rowwise().maxCoeff())};
  Eigen::Index farthest = 0;
  best.radius = reach(best.centre, &farthest);
  const int steps = density.size() > 100000 ? 30 : 100;
  Eigen::Vector3d centre = best.centre;
  for (int step = 2; step < steps; ++step) {
    centre += (density.points.col(farthest) - centre) / step;
    const double radius = reach(centre, &farthest);
    if (radius < best.radius) best = {centre, radius};
  }
  return best;
}

Eigen::MatrixXcd density_spectrum(const BodyDensity& density, const Eigen::Vector3d& centre,
                                  int modes, double box, double tolerance, int threads) {
  const Eigen::Index columns = density.is_real() ? 1 : 2;
  const std::array<int, 3> shape{modes, modes, modes};
  const std::array<double, 3> sides{box, box, box};
  const Eigen::Matrix3Xd points = density.points.colwise() - centre;
  Eigen::MatrixXcd spectrum(static_cast<Eigen::Index>(modes) * modes * modes, columns);
  for (Eigen::Index c = 0; c < columns; ++c) {
    Eigen::VectorXcd weights = Eigen::VectorXcd::Zero(density.size());
    weights.real() =
        c == 0 ? Eigen::VectorXd(density.weights.real()) : Eigen::VectorXd(density.weights.imag());
    if (density.radii.size() == 0) {
      spectrum.col(c) =
          nfft(points, weights, shape, sides, {.tolerance = tolerance, .threads = threads});
    } else {
      Knots knots{Eigen::Matrix4Xd(4, points.cols()), weights};
      knots.points.topRows<3>() = points;
      knots.points.row(3) = density.radii.transpose();
      spectrum.col(c) = lifted_spectrum(knots, density.kernel, shape, sides,
                                        {.tolerance = tolerance, .threads = threads})
                            .col(0);
    }
  }
  return spectrum;
}

Eigen::MatrixXcd density_spectrum_at(const BodyDensity& density, const Eigen::Vector3d& centre,
                                     const Eigen::Matrix3Xd& frequencies, int threads) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const Eigen::Index parts = density.is_real() ? 1 : 2;
  const bool equal = density.radii.size() > 0 && (density.radii.array() == density.radii[0]).all();
  Eigen::MatrixXcd result = Eigen::MatrixXcd::Zero(frequencies.cols(), 4 * parts);
  parallel_for(static_cast<std::size_t>(frequencies.cols()), threads, [&](std::size_t row, int) {
    const Eigen::Index m = static_cast<Eigen::Index>(row);
    const Eigen::Vector3d w = frequencies.col(m);
    const double k = w.norm();
    const double common = equal ? density.kernel.transform(k, density.radii[0]) : 1.0;
    Eigen::Matrix<std::complex<double>, 4, 2> sum =
        Eigen::Matrix<std::complex<double>, 4, 2>::Zero();
    for (Eigen::Index i = 0; i < density.size(); ++i) {
      const Eigen::Vector3d y = density.points.col(i) - centre;
      const double shape = equal || density.radii.size() == 0
                               ? common
                               : density.kernel.transform(k, density.radii[i]);
      const std::complex<double> e = std::polar(shape, -kTurn * w.dot(y));
      const double part[2] = {density.weights[i].real(), density.weights[i].imag()};
      for (Eigen::Index p = 0; p < parts; ++p) {
        const std::complex<double> c = part[p] * e;
        sum(0, p) += c;
        for (int d = 0; d < 3; ++d) sum(d + 1, p) += std::complex<double>(0.0, -kTurn * y[d]) * c;
      }
    }
    for (Eigen::Index p = 0; p < parts; ++p)
      for (int d = 0; d < 4; ++d) result(m, 4 * p + d) = sum(d, p);
  });
  return result;
}

}  // namespace mortise
