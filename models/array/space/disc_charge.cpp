#include "models/array/space/disc_charge.h"

#include "models/maths/dense.h"
#include "models/maths/gauss_legendre.h"
#include "models/maths/require.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viscard {
namespace {

constexpr double kShortWaves_kt = 16.0;  // from here on p k is constant to exp(-2 k t) = 1e-14
constexpr int kChargePoints = 8;         // Gauss points per panel of k

}  // namespace

std::vector<double> even_spherical_bessel(int count, double x) {
  std::vector<double> values(static_cast<std::size_t>(count));
  for (int l = 0; l < count; ++l) {
    values[static_cast<std::size_t>(l)] = std::sph_bessel(static_cast<unsigned>(2 * l), x);
  }
  return values;
}

DiscCharge::DiscCharge(const LayeredFilm& film, double radius_m, int modes, int film_degree)
    : radius_m_(radius_m) {
  require_positive("radius of an electrode", radius_m, "m");
  const double t_m = film.layers.front().thickness_m;
  const double largest_k_1_m = kShortWaves_kt / t_m;
  // The mean over the angle of a function with harmonics 0, 2 and 4.
  std::vector<FilmWaves> directions;
  for (int j = 0; j <= 2; ++j) {
    directions.emplace_back(film, 0.25 * std::numbers::pi * j, largest_k_1_m, film_degree);
  }
  const auto potential = [&](double k_1_m) {
    return 0.25 * directions[0].reading(k_1_m)[3] + 0.5 * directions[1].reading(k_1_m)[3] +
           0.25 * directions[2].reading(k_1_m)[3];
  };
  const double limit = largest_k_1_m * potential(largest_k_1_m);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(modes, modes);
  for (int l = 0; l < modes; ++l) A(l, l) = limit / (4.0 * radius_m * (4 * l + 1));
  const double longest_1_m = std::min(2.0 / radius_m, 1.5 / t_m);
  const int panels = static_cast<int>(std::ceil(largest_k_1_m / longest_1_m));
  const QuadratureRule rule = gauss_legendre(kChargePoints);
  for (int panel = 0; panel < panels; ++panel) {
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const double k_1_m = largest_k_1_m * (panel + rule.points[q]) / panels;
      const double weight = rule.weights[q] * largest_k_1_m / panels / (2.0 * std::numbers::pi) *
                            (k_1_m * potential(k_1_m) - limit);
      const std::vector<double> j = even_spherical_bessel(modes, k_1_m * radius_m);
      const Eigen::Map<const Eigen::VectorXd> values(j.data(), modes);
      A += weight * values * values.transpose();
    }
  }
  // Equal potential at unit charge: the other amplitudes make the energy least.
  Eigen::VectorXd amplitude = Eigen::VectorXd::Ones(modes);
  const int others = modes - 1;
  if (others > 0) {
    amplitude.tail(others) = -Cholesky(A.bottomRightCorner(others, others))
                                  .solve(Eigen::VectorXd(A.col(0).tail(others)));
  }
  amplitude_.assign(amplitude.begin(), amplitude.end());
  capacitance_F_ = 1.0 / A.row(0).dot(amplitude);
}

AxialReading DiscCharge::reading() const {
  return [amplitude = amplitude_, radius_m = radius_m_](double k_1_m) {
    const std::vector<double> j =
        even_spherical_bessel(static_cast<int>(amplitude.size()), k_1_m * radius_m);
    double sum = 0.0;
    for (std::size_t l = 0; l < j.size(); ++l) sum += amplitude[l] * j[l];
    return sum;
  };
}

}  // namespace viscard
