// SPDX-License-Identifier: GPL-3.0-or-later
// Channels taken apart into the real point sets that the search transforms.
#include "search/components.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>

#include "mortise/fourier/nfft.hpp"

namespace mortise {
namespace {

using Spectrum = std::vector<std::complex<double>>;

// Far below what single precision and the coarse grid leave.
constexpr double kFixedTolerance = 1e-5;

// Relative to the largest value of the table; far below what the coarse grid leaves.
constexpr double kRadiusTolerance = 1e-3;

// transform(k, r) ~ sum_q a_q(k) b_q(r) over the radii of some knots, with as few terms as the
// tolerance allows: one for equal radii. The compressed fourth dimension of docs/math.md, for any
// radial transform.
struct RadiusTerms {
  std::vector<double> radii;  // distinct, ascending
  Eigen::MatrixXd factors;  // radii x Q, orthonormal columns: b_q(r), and the weights that make a_q
                            // from transform()

  [[nodiscard]] Eigen::Index row_of(double radius) const {
    return std::lower_bound(radii.begin(), radii.end(), radius) - radii.begin();
  }
  // a_q(k) for all q: exact where transform(k, .) lies in the span of the factors.
  [[nodiscard]] Eigen::VectorXd frequency_factors(const RadialTransform& transform,
                                                  double k) const {
    Eigen::VectorXd values(radii.size());
    for (std::size_t j = 0; j < radii.size(); ++j) values[j] = transform(k, radii[j]);
    return factors.transpose() * values;
  }
};

RadiusTerms radius_terms(const Knots& knots, const RadialTransform& transform, double k_max) {
  RadiusTerms terms;
  terms.radii.assign(knots.points.row(3).begin(), knots.points.row(3).end());
  std::sort(terms.radii.begin(), terms.radii.end());
  terms.radii.erase(std::unique(terms.radii.begin(), terms.radii.end()), terms.radii.end());
  const auto count = static_cast<Eigen::Index>(terms.radii.size());
  if (count == 1) {
    terms.factors = Eigen::MatrixXd::Ones(1, 1);
    return terms;
  }
  // Fine enough for any transform that the box can resolve: bodies are at most some hundred radii
  // wide.
  constexpr int kSamples = 256;
  Eigen::MatrixXd table(kSamples, count);
  for (int i = 0; i < kSamples; ++i)
    for (Eigen::Index j = 0; j < count; ++j)
      table(i, j) = transform(k_max * i / (kSamples - 1), terms.radii[j]);
  // Right singular vectors, largest singular value first, from the smaller Gram matrix: half of
  // double's digits are lost, and the tolerance needs three.
  const bool wide = count > kSamples;
  const Eigen::MatrixXd gram = wide ? Eigen::MatrixXd(table * table.transpose())
                                    : Eigen::MatrixXd(table.transpose() * table);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);
  Eigen::MatrixXd vectors = solver.eigenvectors().rowwise().reverse();
  if (wide) vectors = (table.transpose() * vectors).eval();
  const double limit = kRadiusTolerance * table.cwiseAbs().maxCoeff();
  for (Eigen::Index q = 1; q <= vectors.cols(); ++q) {
    terms.factors = vectors.leftCols(q);
    terms.factors.colwise().normalize();
    const Eigen::MatrixXd rest = table - (table * terms.factors) * terms.factors.transpose();
    if (rest.cwiseAbs().maxCoeff() <= limit) break;
  }
  return terms;
}

class FixedField {
 public:
  FixedField(const std::array<int, 3>& size, double spacing, int threads)
      : nfft_(size, {size[0] * spacing, size[1] * spacing, size[2] * spacing},
              {.tolerance = kFixedTolerance, .weights = WeightKind::kReal, .threads = threads}),
        frequency_(static_cast<std::size_t>(size[0]) * size[1] * (size[2] / 2 + 1)) {
    std::size_t n = 0;
    for (int i = 0; i < size[0]; ++i)
      for (int j = 0; j < size[1]; ++j)
        for (int k = 0; k <= size[2] / 2; ++k, ++n) {
          const double x = (i - size[0] / 2) / (size[0] * spacing);
          const double y = (j - size[1] / 2) / (size[1] * spacing);
          const double z = k / (size[2] * spacing);
          frequency_[n] = std::sqrt(x * x + y * y + z * z);
          frequency_max_ = std::max(frequency_max_, frequency_[n]);
        }
  }

  [[nodiscard]] const std::vector<double>& frequency() const { return frequency_; }

  // sum_i weights_i transform(k, r_i) exp(-2 pi i k.x_i) over all modes.
  [[nodiscard]] Spectrum of(const Knots& knots, const Eigen::VectorXd& weights,
                            const RadialTransform& transform, const RigidMotion& motion) {
    const RadiusTerms terms = radius_terms(knots, transform, frequency_max_);
    const Eigen::Matrix3Xd points = motion * Eigen::Matrix3Xd(knots.points.topRows<3>());
    const Eigen::MatrixXd shares = shares_of(knots, weights, terms);
    Spectrum field(frequency_.size());
    for (Eigen::Index q = 0; q < shares.cols(); ++q) {
      const auto modes = nfft_.transform(points, Eigen::VectorXd(shares.col(q)));
      for (std::size_t n = 0; n < field.size(); ++n)
        field[n] += modes[n] * terms.frequency_factors(transform, frequency_[n])[q];
    }
    return field;
  }

  // weights_i b_q(r_i): one column per term.
  [[nodiscard]] static Eigen::MatrixXd shares_of(const Knots& knots, const Eigen::VectorXd& weights,
                                                 const RadiusTerms& terms) {
    Eigen::MatrixXd shares(knots.size(), terms.factors.cols());
    for (Eigen::Index i = 0; i < knots.size(); ++i)
      shares.row(i) = weights[i] * terms.factors.row(terms.row_of(knots.points(3, i)));
    return shares;
  }

  [[nodiscard]] double frequency_max() const { return frequency_max_; }

 private:
  Nfft3 nfft_;
  std::vector<double> frequency_;
  double frequency_max_ = 0.0;
};

}  // namespace

Components make_components(const std::vector<Channel>& channels,
                           const RigidMotion& search_from_fixed, const std::array<int, 3>& size,
                           double spacing, int threads) {
  FixedField fields(size, spacing, threads);
  const double volume =
      static_cast<double>(size[0]) * size[1] * size[2] * spacing * spacing * spacing;

  // Channels often share their centres (all atoms): equal centres are spread once per component.
  Components result;
  std::map<std::array<double, 3>, Eigen::Index> index;
  for (const Channel& channel : channels)
    for (Eigen::Index j = 0; j < channel.moving.size(); ++j)
      index.emplace(std::array<double, 3>{channel.moving.points(0, j), channel.moving.points(1, j),
                                          channel.moving.points(2, j)},
                    0);
  result.points.resize(3, static_cast<Eigen::Index>(index.size()));
  Eigen::Index next = 0;
  for (auto& [centre, i] : index) {
    result.points.col(next) << centre[0], centre[1], centre[2];
    i = next++;
  }

  for (const Channel& channel : channels)
    for (const bool imaginary : {false, true}) {
      const auto part = [&](const Knots& knots) -> Eigen::VectorXd {
        return imaginary ? knots.weights.imag().eval() : knots.weights.real().eval();
      };
      const Eigen::VectorXd fixed_weights = part(channel.fixed),
                            moving_weights = part(channel.moving);
      if (channel.weight == 0.0 || fixed_weights.isZero(0.0) || moving_weights.isZero(0.0))
        continue;
      // Re(c d) = Re c Re d - Im c Im d; 1 / volume is the inverse transform's.
      const double factor = (imaginary ? -1.0 : 1.0) * channel.weight / volume;
      const Spectrum field =
          fields.of(channel.fixed, fixed_weights, channel.fixed_transform, search_from_fixed);
      const RadiusTerms terms =
          radius_terms(channel.moving, channel.moving_transform, fields.frequency_max());
      const Eigen::MatrixXd shares = FixedField::shares_of(channel.moving, moving_weights, terms);
      for (Eigen::Index q = 0; q < shares.cols(); ++q) {
        Component component{Eigen::VectorXf::Zero(result.points.cols()), field};
        for (Eigen::Index j = 0; j < channel.moving.size(); ++j)
          component.weights[index.at({channel.moving.points(0, j), channel.moving.points(1, j),
                                      channel.moving.points(2, j)})] +=
              static_cast<float>(shares(j, q));
        for (std::size_t n = 0; n < field.size(); ++n)
          component.spectrum[n] *=
              factor * terms.frequency_factors(channel.moving_transform, fields.frequency()[n])[q];
        result.parts.push_back(std::move(component));
      }
    }
  return result;
}

}  // namespace mortise
