#include "models/array/space/potential_table.h"

#include "models/maths/bessel_orders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace viscard {
namespace {

constexpr int kTablePoints = 12;     // per panel
constexpr double kTablePhase = 4.0;  // largest k times half a panel: J_12(4) = 6e-6

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

// What waves beyond the last one add to the reading: if the sums over the last three octaves fall evenly, they go on as
// a geometric series (eq. S6). Zero if not, as under an electrode whose rim does not lie on that of the foot.
double shorter_waves_V(const std::vector<PotentialSpectrum::OwnWave>& own,
                       const AxialReading& reading) {
  constexpr double kLeastRatio = 0.2, kMostRatio = 0.6;
  std::array<double, 3> octave_V{};  // the last one first
  for (const PotentialSpectrum::OwnWave& wave : own) {
    const auto i = static_cast<std::size_t>(std::log2(own.back().k_1_m / wave.k_1_m));
    if (i < octave_V.size()) octave_V[i] += wave.amplitude * reading(wave.k_1_m);
  }
  const double ratio = octave_V[0] / octave_V[1], before = octave_V[1] / octave_V[2];
  const auto is_even = [](double of) { return of > kLeastRatio && of < kMostRatio; };
  return is_even(ratio) && is_even(before) ? octave_V[0] * ratio / (1.0 - ratio) : 0.0;
}

}  // namespace

AxialReading point_reading() {
  return [](double) { return 1.0; };
}

AxialReading disc_mean(double radius_m) {
  return [radius_m](double k_1_m) { return disc_mean_of_wave(k_1_m * radius_m); };
}

PotentialTable::PotentialTable(const PotentialSpectrum& spectrum,
                               const std::vector<Eigen::MatrixXd>& induced, double reach_m,
                               const std::vector<AxialReading>& readings, double from_m)
    : from_m_(from_m),
      reach_m_(reach_m),
      harmonics_(spectrum.waves.front().amplitude.rows()),
      own_V_(readings.size(), 0.0) {
  const double largest_k_1_m = spectrum.waves.back().k_1_m;
  const int panels = std::max(
      1, static_cast<int>(std::ceil(0.5 * largest_k_1_m * (reach_m_ - from_m_) / kTablePhase)));
  panel_m_ = (reach_m_ - from_m_) / panels;
  values_.assign(readings.size(),
                 Eigen::MatrixXd::Zero(panels * kTablePoints, kTopLoads * harmonics_));
  for (std::size_t i = 0; i < spectrum.waves.size(); ++i) {
    const PotentialSpectrum::Wave& wave = spectrum.waves[i];
    std::vector<double> factors;
    for (const AxialReading& reading : readings) factors.push_back(reading(wave.k_1_m));
    if (induced.empty()) {
      add_wave(wave.amplitude, wave.k_1_m, factors);
      continue;
    }
    add_wave(wave.amplitude + induced[i], wave.k_1_m, factors);
    // An electrode without net charge does not change the voltage that it reads.
    for (std::size_t r = 0; r < factors.size(); ++r) own_V_[r] -= factors[r] * induced[i](0, 0);
  }
  for (std::size_t r = 0; r < readings.size(); ++r) {
    for (const PotentialSpectrum::OwnWave& wave : spectrum.own) {
      own_V_[r] += wave.amplitude * readings[r](wave.k_1_m);
    }
    own_V_[r] += shorter_waves_V(spectrum.own, readings[r]);
  }
}

void PotentialTable::add_wave(const Eigen::MatrixXd& amplitude, double k_1_m,
                              const std::vector<double>& factors) {
  Eigen::VectorXd J(2 * harmonics_);
  Eigen::RowVectorXd row(kTopLoads * harmonics_);
  for (Eigen::Index at = 0; at < values_.front().rows(); ++at) {
    const Eigen::Index panel = at / kTablePoints;
    const double within = 0.5 * (1.0 + table_point(static_cast<int>(at % kTablePoints)));
    bessel_orders(k_1_m * (from_m_ + panel_m_ * (static_cast<double>(panel) + within)), J);
    for (Eigen::Index load = 0; load < kTopLoads; ++load) {
      for (Eigen::Index j = 0; j < harmonics_; ++j) {
        row[load * harmonics_ + j] = amplitude(j, load) * J[2 * j + (load == 0 ? 0 : 1)];
      }
    }
    for (std::size_t r = 0; r < values_.size(); ++r) values_[r].row(at) += factors[r] * row;
  }
}

PotentialByLoad PotentialTable::at(double x_m, double y_m, std::size_t reading) const {
  const double radius_m = std::hypot(x_m, y_m);
  if (radius_m > reach_m_) return PotentialByLoad::Zero();
  const Eigen::MatrixXd& values = values_.at(reading);
  const Eigen::Index panels = values.rows() / kTablePoints;
  const auto panel =
      std::min(panels - 1, static_cast<Eigen::Index>(std::floor((radius_m - from_m_) / panel_m_)));
  const double within = 2.0 * ((radius_m - from_m_) / panel_m_ - static_cast<double>(panel)) - 1.0;
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
