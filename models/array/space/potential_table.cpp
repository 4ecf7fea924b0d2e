#include "models/array/space/potential_table.h"

#include "models/maths/gauss_legendre.h"
#include "models/maths/require.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace viscard {
namespace {

constexpr int kTablePoints = 12;      // per panel
constexpr double kTablePhase = 4.0;   // largest k times half a panel: J_12(4) = 6e-6
constexpr int kWavePoints = 8;        // Gauss points per panel of k
constexpr double kWavePhase = 5.0;    // largest radius times a panel of k
constexpr double kShortWaves = 16.0;  // times the thickness: faces apart by exp(-16)
constexpr double kCutFrom = 0.5;      // of the largest k, where cut() begins
constexpr double kOwnPhase = 4.0;     // radius of the foot times a panel of k, on its own axis
constexpr double kWaveStep = 0.7;     // panel of k times the thickness of the film

double thickness_m(const LayeredFilm& film) {
  double sum = 0.0;
  for (const FilmLayer& layer : film.layers) sum += layer.thickness_m;
  return sum;
}

// Point i of a panel over (-1, 1), both ends included.
double table_point(int i) {
  return -std::cos(std::numbers::pi * i / (kTablePoints - 1));
}

// Weights of the values at the points of a panel for the polynomial through them at x in (-1, 1), in
// barycentric form. Berrut & Trefethen, SIAM Review 46 (2004) 501.
Eigen::Matrix<double, kTablePoints, 1> table_weights(double x) {
  Eigen::Matrix<double, kTablePoints, 1> weights = Eigen::Matrix<double, kTablePoints, 1>::Zero();
  double sum = 0.0;
  for (int i = 0; i < kTablePoints; ++i) {
    const double distance = x - table_point(i);
    if (distance == 0.0) return Eigen::Matrix<double, kTablePoints, 1>::Unit(i);
    const bool is_end = i == 0 || i == kTablePoints - 1;
    weights[i] = (i % 2 == 0 ? 1.0 : -1.0) * (is_end ? 0.5 : 1.0) / distance;
    sum += weights[i];
  }
  return weights / sum;
}

// J_0 to J_(values.size() - 1) at x >= 0. Upward recursion is stable for orders below x: Abramowitz &
// Stegun (1964), 9.12.
void bessel(double x, Eigen::VectorXd& values) {
  const Eigen::Index count = values.size();
  values[0] = ::j0(x);
  values[1] = ::j1(x);
  for (Eigen::Index m = 2; m < count; ++m) {
    const double order = static_cast<double>(m);
    values[m] = x > order ? 2.0 * (order - 1.0) / x * values[m - 1] - values[m - 2]
                          : ::jn(static_cast<int>(m), x);
  }
}

// Share of waves, by their k over the largest, that is left to add_own(): rises smoothly from 0 to 1, so
// that what neighbours miss of the short waves falls off with the distance faster than any power.
double cut(double of_largest) {
  const double s = std::clamp((of_largest - kCutFrom) / (1.0 - kCutFrom), 0.0, 1.0);
  return s * s * s * s * (35.0 - s * (84.0 - s * (70.0 - 20.0 * s)));
}

// The film's reading per traction over the angle: sums over l of (x, z) cos(2 l theta) and
// y sin(2 l theta), l = 0 to L.
struct AngularReading {
  Eigen::VectorXd x, y, z;
};

// Trigonometric interpolation through theta = j pi/(2 L), j = 0 to L.
AngularReading angular(const std::vector<Eigen::Vector4d>& at_angles) {
  const auto L = static_cast<Eigen::Index>(at_angles.size()) - 1;
  AngularReading sum{Eigen::VectorXd::Zero(L + 2), Eigen::VectorXd::Zero(L + 2),
                     Eigen::VectorXd::Zero(L + 2)};  // one more, for the products below
  for (Eigen::Index l = 0; l <= L; ++l) {
    for (Eigen::Index j = 0; j <= L; ++j) {
      const double angle = std::numbers::pi * static_cast<double>(l * j) / static_cast<double>(L);
      const double half_ends = (j == 0 || j == L ? 0.5 : 1.0) * (l == 0 || l == L ? 0.5 : 1.0);
      const double weight = 2.0 / static_cast<double>(L) * half_ends;
      const Eigen::Vector4d& value = at_angles[static_cast<std::size_t>(j)];
      sum.x[l] += weight * std::cos(angle) * value[0];
      sum.z[l] += weight * std::cos(angle) * value[2];
      if (l < L) sum.y[l] += 2.0 / static_cast<double>(L) * std::sin(angle) * value[1];
    }
  }
  return sum;
}

// Factors of cos((2 j + 1) theta) in g cos(theta) (sign = 1), or of the sine in g sin(theta)
// (sign = -1), for g = sum of even cosines.
double odd_part(const Eigen::VectorXd& even, Eigen::Index j, double sign) {
  return (j == 0 ? even[0] : 0.5 * even[j]) + 0.5 * sign * even[j + 1];
}

// Amplitude of each harmonic of the potential of one wave number, for every load: eq. S4.
Eigen::MatrixXd harmonics_of(const AngularReading& g, const FootForces& foot, double k_1_m) {
  const AxialTransform pressure = transform(foot.pressure, foot.radius_m, k_1_m);
  const SidewaysTransform shear = transform(foot.shear, foot.radius_m, k_1_m);
  const SidewaysTransform tilt = transform(foot.tilt, foot.radius_m, k_1_m);
  const Eigen::Index count = g.x.size() - 1;
  Eigen::MatrixXd amplitude(count, kTopLoads);
  for (Eigen::Index j = 0; j < count; ++j) {
    const double sign = j % 2 == 0 ? 1.0 : -1.0;  // i^(2 j)
    // Potential of a sideways load along x (direction = 1) or y (-1); -2 i times i^(2 j + 1).
    const auto sideways = [&](const SidewaysTransform& t, double direction) {
      return 2.0 * sign *
             (odd_part(g.x, j, direction) * t.along + odd_part(g.z, j, direction) * t.normal +
              0.5 * (g.y[j] - direction * g.y[j + 1]) * t.across);
    };
    amplitude.row(j) << sign * (g.x[j] * pressure.tau_x + g.z[j] * pressure.t_z),
        sideways(shear, 1.0), sideways(shear, -1.0), sideways(tilt, 1.0), sideways(tilt, -1.0);
  }
  return amplitude;
}

// Solves the film under waves of one length in L + 1 directions.
class Directions {
 public:
  Directions(const LayeredFilm& film, const PotentialAccuracy& accuracy, double largest_k_1_m) {
    for (int j = 0; j <= accuracy.harmonics; ++j) {
      waves_.emplace_back(film, 0.5 * std::numbers::pi * j / accuracy.harmonics, largest_k_1_m,
                          accuracy.film_degree);
    }
  }
  AngularReading at(double k_1_m) const {
    std::vector<Eigen::Vector4d> values;
    for (const FilmWaves& direction : waves_) values.push_back(direction.reading(k_1_m));
    return angular(values);
  }

 private:
  std::vector<FilmWaves> waves_;
};

}  // namespace

AxialReading point_reading() {
  return [](double) { return 1.0; };
}

AxialReading disc_mean(double radius_m) {
  return [radius_m](double k_1_m) {
    const double x = k_1_m * radius_m;
    return x < 1e-8 ? 1.0 : 2.0 * ::j1(x) / x;
  };
}

PotentialTable::PotentialTable(const LayeredFilm& film, const FootForces& foot,
                               const PotentialAccuracy& accuracy,
                               const std::vector<AxialReading>& readings)
    : reach_m_(accuracy.reach_m), harmonics_(accuracy.harmonics + 1) {
  require_positive("reach of the potential", reach_m_, "m");
  const double largest_k_1_m = accuracy.largest_kt / thickness_m(film);
  const int panels =
      std::max(1, static_cast<int>(std::ceil(0.5 * largest_k_1_m * reach_m_ / kTablePhase)));
  panel_m_ = reach_m_ / panels;
  values_.assign(readings.size(),
                 Eigen::MatrixXd::Zero(panels * kTablePoints, kTopLoads * harmonics_));
  const Directions directions(film, accuracy, largest_k_1_m);
  const double longest_1_m =
      std::min(kWavePhase / reach_m_, kWaveStep / film.layers.front().thickness_m);
  const int wave_panels = static_cast<int>(std::ceil(largest_k_1_m / longest_1_m));
  const double step_1_m = largest_k_1_m / wave_panels;
  const QuadratureRule rule = gauss_legendre(kWavePoints);
  for (int panel = 0; panel < wave_panels; ++panel) {
    for (std::size_t q = 0; q < rule.points.size(); ++q, ++waves_) {
      const double k_1_m = step_1_m * (panel + rule.points[q]);
      const double weight = rule.weights[q] * step_1_m * k_1_m / (2.0 * std::numbers::pi);
      const double share = accuracy.own_kt > 0.0 ? 1.0 - cut(k_1_m / largest_k_1_m) : 1.0;
      add_wave(share * weight * harmonics_of(directions.at(k_1_m), foot, k_1_m), k_1_m, readings);
    }
  }
  add_own(film, foot, accuracy, readings);
}

// Beyond kShortWaves the faces no longer feel each other and the reading goes as 1/k (eq. S6).
void PotentialTable::add_own(const LayeredFilm& film, const FootForces& foot,
                             const PotentialAccuracy& accuracy,
                             const std::vector<AxialReading>& readings) {
  own_V_.assign(readings.size(), 0.0);
  const double t_m = thickness_m(film);
  const double from_1_m = kCutFrom * accuracy.largest_kt / t_m;
  const double to_1_m = accuracy.own_kt / t_m;
  if (!(to_1_m > from_1_m)) return;
  const double short_1_m = std::max(from_1_m, kShortWaves / t_m);
  const Directions directions(film, accuracy, short_1_m);
  const AngularReading limit = directions.at(short_1_m);
  const double widest_m = *std::max_element(foot.radius_m.begin(), foot.radius_m.end());
  const int panels =
      static_cast<int>(std::ceil((to_1_m - from_1_m) * std::max(t_m, widest_m) / kOwnPhase));
  const double step_1_m = (to_1_m - from_1_m) / panels;
  const QuadratureRule rule = gauss_legendre(kWavePoints);
  for (int panel = 0; panel < panels; ++panel) {
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const double k_1_m = from_1_m + step_1_m * (panel + rule.points[q]);
      const AngularReading g = k_1_m < short_1_m ? directions.at(k_1_m) : limit;
      const double share =
          std::min(1.0, short_1_m / k_1_m) * cut(k_1_m * t_m / accuracy.largest_kt);
      const double weight = rule.weights[q] * step_1_m * k_1_m / (2.0 * std::numbers::pi) * share;
      const AxialTransform pressure = transform(foot.pressure, foot.radius_m, k_1_m);
      const double amplitude = weight * (g.x[0] * pressure.tau_x + g.z[0] * pressure.t_z);
      for (std::size_t r = 0; r < readings.size(); ++r) own_V_[r] += amplitude * readings[r](k_1_m);
    }
  }
}

void PotentialTable::add_wave(const Eigen::MatrixXd& amplitude, double k_1_m,
                              const std::vector<AxialReading>& readings) {
  std::vector<double> factor;
  for (const AxialReading& reading : readings) factor.push_back(reading(k_1_m));
  Eigen::VectorXd J(2 * harmonics_);
  Eigen::RowVectorXd row(kTopLoads * harmonics_);
  for (Eigen::Index at = 0; at < values_.front().rows(); ++at) {
    const auto panel = static_cast<double>(at / kTablePoints);
    const double within = 0.5 * (1.0 + table_point(static_cast<int>(at % kTablePoints)));
    bessel(k_1_m * panel_m_ * (panel + within), J);
    for (Eigen::Index load = 0; load < kTopLoads; ++load) {
      for (Eigen::Index j = 0; j < harmonics_; ++j) {
        row[load * harmonics_ + j] = amplitude(j, load) * J[2 * j + (load == 0 ? 0 : 1)];
      }
    }
    for (std::size_t r = 0; r < values_.size(); ++r) values_[r].row(at) += factor[r] * row;
  }
}

PotentialByLoad PotentialTable::at(double x_m, double y_m, std::size_t reading) const {
  const double radius_m = std::hypot(x_m, y_m);
  if (radius_m > reach_m_) return PotentialByLoad::Zero();
  const Eigen::MatrixXd& values = values_.at(reading);
  const Eigen::Index panels = values.rows() / kTablePoints;
  const auto panel =
      std::min(panels - 1, static_cast<Eigen::Index>(std::floor(radius_m / panel_m_)));
  const double within = 2.0 * (radius_m / panel_m_ - static_cast<double>(panel)) - 1.0;
  const Eigen::RowVectorXd radial =
      table_weights(within).transpose() * values.middleRows(panel * kTablePoints, kTablePoints);
  const double angle = std::atan2(y_m, x_m);
  PotentialByLoad potential = PotentialByLoad::Zero();
  for (Eigen::Index j = 0; j < harmonics_; ++j) {
    const double even = std::cos(2.0 * static_cast<double>(j) * angle);
    const double cosine = std::cos(static_cast<double>(2 * j + 1) * angle);
    const double sine = std::sin(static_cast<double>(2 * j + 1) * angle);
    const std::array<double, kTopLoads> factors = {even, cosine, sine, cosine, sine};
    for (Eigen::Index load = 0; load < kTopLoads; ++load) {
      potential[load] += factors[static_cast<std::size_t>(load)] * radial[load * harmonics_ + j];
    }
  }
  if (radius_m == 0.0) potential[0] += own_V_.at(reading);
  return potential;
}

}  // namespace viscard
