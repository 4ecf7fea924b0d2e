#include "models/array/film/disc_charge.h"

#include "models/maths/dense.h"
#include "models/maths/gauss_legendre.h"
#include "models/maths/require.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viscard {
namespace {

constexpr double kFacesApart_kt = 16.0;  // from here on p k is constant to exp(-2 k t) = 1e-14
constexpr int kChargePoints = 8;         // Gauss points per panel of k

}  // namespace

// Four directions average the harmonics 0, 2 and 4 exactly; two of them are equal by symmetry.
ChargePotential::ChargePotential(const LayeredFilm& film, double largest_k_1_m, int film_degree) {
  for (int j = 0; j <= 2; ++j) {
    directions_.emplace_back(film, 0.25 * std::numbers::pi * j, largest_k_1_m, film_degree);
  }
}

double ChargePotential::at(double k_1_m) const {
  return 0.25 * directions_[0].reading(k_1_m)[3] + 0.5 * directions_[1].reading(k_1_m)[3] +
         0.25 * directions_[2].reading(k_1_m)[3];
}

ScreenedWaves screened_waves(const LayeredFilm& film, double longest_1_m, int film_degree) {
  const double largest_k_1_m = kFacesApart_kt / film.layers.front().thickness_m;
  const ChargePotential potential(film, largest_k_1_m, film_degree);
  ScreenedWaves waves;
  waves.limit_Vm_C = largest_k_1_m * potential.at(largest_k_1_m);
  const int panels = static_cast<int>(std::ceil(largest_k_1_m / longest_1_m));
  const QuadratureRule rule = gauss_legendre(kChargePoints);
  for (int panel = 0; panel < panels; ++panel) {
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const double k_1_m = largest_k_1_m * (panel + rule.points[q]) / panels;
      waves.k_1_m.push_back(k_1_m);
      waves.weight.push_back(rule.weights[q] * largest_k_1_m / panels / (2.0 * std::numbers::pi) *
                             (k_1_m * potential.at(k_1_m) - waves.limit_Vm_C));
    }
  }
  return waves;
}

DiscCharge::DiscCharge(const LayeredFilm& film, double radius_m, int harmonics, int modes,
                       int film_degree)
    : radius_m_(radius_m) {
  require_positive("radius of an electrode", radius_m, "m");
  influence_.assign(static_cast<std::size_t>(harmonics), Eigen::MatrixXd::Zero(modes, modes));
  integrate(film, film_degree);
  // Equal potential at unit charge: the other amplitudes make the energy least.
  const Eigen::MatrixXd& A = influence_.front();
  at_equal_potential_ = Eigen::VectorXd::Ones(modes);
  const int others = modes - 1;
  if (others > 0) {
    const Eigen::VectorXd coupling = A.col(0).tail(others);
    at_equal_potential_.tail(others) =
        -Cholesky(A.bottomRightCorner(others, others)).solve(coupling);
  }
  capacitance_F_ = 1.0 / A.row(0).dot(at_equal_potential_);
}

void DiscCharge::integrate(const LayeredFilm& film, int film_degree) {
  const double longest_1_m = std::min(2.0 / radius_m_, 1.5 / film.layers.front().thickness_m);
  const ScreenedWaves waves = screened_waves(film, longest_1_m, film_degree);
  // int j_n^2 dx = pi/(2 (2 n + 1)), other pairs of one parity give zero: Abramowitz & Stegun, 11.4.6.
  for (std::size_t m = 0; m < influence_.size(); ++m) {
    for (Eigen::Index l = 0; l < influence_[m].rows(); ++l) {
      const double n = static_cast<double>(m) + 2.0 * static_cast<double>(l);
      influence_[m](l, l) = waves.limit_Vm_C / (4.0 * radius_m_ * (2.0 * n + 1.0));
    }
  }
  for (std::size_t i = 0; i < waves.k_1_m.size(); ++i) {
    for (std::size_t m = 0; m < influence_.size(); ++m) {
      const Eigen::VectorXd j = transforms(static_cast<int>(m), waves.k_1_m[i]);
      influence_[m] += waves.weight[i] * j * j.transpose();
    }
  }
}

Eigen::VectorXd DiscCharge::transforms(int harmonic, double k_1_m) const {
  Eigen::VectorXd values(influence_.front().rows());
  for (Eigen::Index l = 0; l < values.size(); ++l) {
    values[l] = std::sph_bessel(static_cast<unsigned>(harmonic + 2 * l), k_1_m * radius_m_);
  }
  return values;
}

double DiscCharge::weight(double k_1_m) const {
  return at_equal_potential_.dot(transforms(0, k_1_m));
}

Eigen::MatrixXd DiscCharge::induced(int harmonic, const Eigen::MatrixXd& moments) const {
  const Eigen::MatrixXd& A = influence_.at(static_cast<std::size_t>(harmonic));
  const Eigen::Index held = harmonic == 0 ? 1 : 0;  // the mode with a net charge
  const Eigen::Index open = std::min(A.rows(), moments.rows()) - held;
  Eigen::MatrixXd amplitudes = Eigen::MatrixXd::Zero(open + held, moments.cols());
  if (open == 0) return amplitudes;
  const Eigen::MatrixXd right = moments.bottomRows(open);
  amplitudes.bottomRows(open) = -Cholesky(A.block(held, held, open, open)).solve(right);
  return amplitudes;
}

}  // namespace viscard
