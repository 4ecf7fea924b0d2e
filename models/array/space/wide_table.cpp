#include "models/array/space/wide_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

constexpr double kFarWaves =
    120.0;  // largest k of a table beyond the near one times its least distance

}  // namespace

DirectionReading potential_reading(const FilmTable& film) {
  return [&film](double k_1_m) {
    std::vector<Eigen::Vector4d> rows;
    for (const Eigen::Matrix4d& response : film.at(k_1_m)) rows.push_back(response.row(3));
    return rows;
  };
}

PotentialSpectrum graded_spectrum(const FilmTable& film, const DirectionReading& reading,
                                  const FootForces& foot, double largest_1_m, double longest_1_m,
                                  bool fades) {
  PotentialSpectrum spectrum;
  each_graded_wave(
      film.smallest_k_1_m(), largest_1_m, longest_1_m, [&](double k_1_m, double weight_1_m2) {
        const double share = fades ? 1.0 - cut(k_1_m / largest_1_m) : 1.0;
        spectrum.waves.push_back({k_1_m, share * weight_1_m2,
                                  share * weight_1_m2 * harmonics_of(reading(k_1_m), foot, k_1_m)});
      });
  return spectrum;
}

WideTable::WideTable(PotentialTable near, const FilmTable& film, const DirectionReading& reading,
                     const FootForces& foot, const std::vector<AxialReading>& readings)
    : near_(std::move(near)) {
  for (double from_m = near_.reach_m(); from_m < film.far_m(); from_m *= 2.0) {
    const double largest_1_m = std::min(film.largest_k_1_m(), kFarWaves / from_m);
    const bool fades = largest_1_m < film.largest_k_1_m();
    const PotentialSpectrum spectrum =
        graded_spectrum(film, reading, foot, largest_1_m, kWavePhase / (2.0 * from_m), fades);
    far_.emplace_back(spectrum, std::vector<Eigen::MatrixXd>{}, 2.0 * from_m, readings, from_m);
  }
}

PotentialByLoad WideTable::at(double x_m, double y_m, std::size_t reading) const {
  const double radius_m = std::hypot(x_m, y_m);
  if (radius_m <= near_.reach_m()) return near_.at(x_m, y_m, reading);
  for (const PotentialTable& table : far_) {
    if (radius_m <= table.reach_m()) return table.at(x_m, y_m, reading);
  }
  return PotentialByLoad::Zero();
}

}  // namespace viscard
