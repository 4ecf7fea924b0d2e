#include "models/array/space/potential_spectrum.h"

#include "models/maths/chebyshev_panel.h"
#include "models/maths/gauss_legendre.h"
#include "models/maths/neighbours.h"
#include "models/maths/require.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace viscard {
namespace {

constexpr int kWavePoints = 8;        // Gauss points per panel of k
constexpr double kShortWaves = 16.0;  // times the thickness: the faces are apart by exp(-16)
constexpr int kPanelPoints = 14;      // of a panel of k on which the film is sampled
constexpr double kPanelGrowth = 0.4;  // its length over where it begins
constexpr double kOwnPhase = 4.0;     // radius of the foot times a panel of k, on its own axis

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

// The film's reading of waves up to the largest in L + 1 directions: solved at the points of panels and a polynomial
// between them. As a function of k t it has poles, the first at an imaginary part of 0.92 (eq. A4) and a real part
// below 2; panels of 1, which grow beyond, keep them outside an ellipse of 3.9, and 3.9^-14 is 5e-9.
class Directions {
 public:
  Directions(const LayeredFilm& film, const PotentialAccuracy& accuracy, double largest_k_1_m) {
    std::vector<FilmWaves> waves;
    for (int j = 0; j <= accuracy.harmonics; ++j) {
      waves.emplace_back(film, 0.5 * std::numbers::pi * j / accuracy.harmonics, largest_k_1_m,
                         accuracy.film_degree);
    }
    const double t_m = thickness_m(film);
    std::vector<double> breaks_1_m = {0.0};
    while (breaks_1_m.back() < largest_k_1_m) {
      const double from_1_m = breaks_1_m.back();
      const double next_1_m = from_1_m + std::max(1.0 / t_m, kPanelGrowth * from_1_m);
      // No short panel is left at the end.
      breaks_1_m.push_back(next_1_m > 0.8 * largest_k_1_m && next_1_m < largest_k_1_m
                               ? 0.5 * (from_1_m + largest_k_1_m)
                               : std::min(next_1_m, largest_k_1_m));
    }
    panels_ = ChebyshevPanels(std::move(breaks_1_m), kPanelPoints, [&](double k_1_m) {
      Eigen::RowVectorXd values(4 * static_cast<Eigen::Index>(waves.size()));
      for (std::size_t j = 0; j < waves.size(); ++j) {
        values.segment<4>(4 * static_cast<Eigen::Index>(j)) = waves[j].reading(k_1_m).transpose();
      }
      return values;
    });
  }

  std::vector<Eigen::Vector4d> at(double k_1_m) const {
    const Eigen::RowVectorXd row = panels_.at(k_1_m);
    std::vector<Eigen::Vector4d> values;
    for (Eigen::Index j = 0; j < row.size(); j += 4) values.emplace_back(row.segment<4>(j));
    return values;
  }

 private:
  ChebyshevPanels panels_;  // 4 readings of each direction
};

// Calls with(k, weight) for the points of a quadrature of k dk/(2 pi).
template <typename With>
void each_wave(double from_1_m, double to_1_m, double longest_1_m, const With& with) {
  const int panels = static_cast<int>(std::ceil((to_1_m - from_1_m) / longest_1_m));
  const double step_1_m = (to_1_m - from_1_m) / panels;
  const QuadratureRule rule = gauss_legendre(kWavePoints);
  for (int panel = 0; panel < panels; ++panel) {
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const double k_1_m = from_1_m + step_1_m * (panel + rule.points[q]);
      with(k_1_m, rule.weights[q] * step_1_m * k_1_m / (2.0 * std::numbers::pi));
    }
  }
}

}  // namespace

Eigen::MatrixXd harmonics_of(const std::vector<Eigen::Vector4d>& at_angles, const FootForces& foot,
                             double k_1_m) {
  const AngularReading g = angular(at_angles);
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

// Beyond kShortWaves the faces no longer feel each other and the reading goes as 1/k (eq. S6).
std::vector<PotentialSpectrum::OwnWave> own_waves(const LayeredFilm& film, const FootForces& foot,
                                                  const PotentialAccuracy& accuracy) {
  std::vector<PotentialSpectrum::OwnWave> own;
  const double t_m = thickness_m(film);
  const double from_1_m = kCutFrom * accuracy.largest_kt / t_m;
  const double to_1_m = accuracy.own_kt / t_m;
  if (!(to_1_m > from_1_m)) return own;
  const double short_1_m = std::max(from_1_m, kShortWaves / t_m);
  const Directions directions(film, accuracy, short_1_m);
  const AngularReading limit = angular(directions.at(short_1_m));
  const double widest_m = *std::max_element(foot.radius_m.begin(), foot.radius_m.end());
  each_wave(
      from_1_m, to_1_m, kOwnPhase / std::max(t_m, widest_m), [&](double k_1_m, double weight) {
        const AngularReading g = k_1_m < short_1_m ? angular(directions.at(k_1_m)) : limit;
        const double share =
            std::min(1.0, short_1_m / k_1_m) * cut(k_1_m * t_m / accuracy.largest_kt);
        const AxialTransform pressure = transform(foot.pressure, foot.radius_m, k_1_m);
        own.push_back({k_1_m, share * weight * (g.x[0] * pressure.tau_x + g.z[0] * pressure.t_z)});
      });
  return own;
}

PotentialSpectrum potential_spectrum(const LayeredFilm& film, const FootForces& foot,
                                     const PotentialAccuracy& accuracy) {
  require_positive("reach of the potential", accuracy.reach_m, "m");
  PotentialSpectrum spectrum;
  const double largest_k_1_m = accuracy.largest_kt / thickness_m(film);
  const Directions directions(film, accuracy, largest_k_1_m);
  const double longest_1_m =
      std::min(kWavePhase / accuracy.reach_m, kWaveStep / film.layers.front().thickness_m);
  each_wave(0.0, largest_k_1_m, longest_1_m, [&](double k_1_m, double weight) {
    const double share = accuracy.own_kt > 0.0 ? 1.0 - cut(k_1_m / largest_k_1_m) : 1.0;
    spectrum.waves.push_back(
        {k_1_m, share * weight, share * weight * harmonics_of(directions.at(k_1_m), foot, k_1_m)});
  });
  spectrum.own = own_waves(film, foot, accuracy);
  return spectrum;
}

namespace {

// Potential per charge of each wave, quadrature weight included. The charge lies on the face that is read, so its short
// waves must fade out on either face (eq. S6). If the spectrum has waves of its own, its weights already contain this.
std::vector<double> wave_potentials(const PotentialSpectrum& spectrum, const LayeredFilm& film,
                                    const PotentialAccuracy& accuracy) {
  const double largest_k_1_m = accuracy.largest_kt / thickness_m(film);
  const ChargePotential potential(film, largest_k_1_m, accuracy.film_degree);
  std::vector<double> per_charge;
  for (const PotentialSpectrum::Wave& wave : spectrum.waves) {
    const double share = accuracy.own_kt > 0.0 ? 1.0 : 1.0 - cut(wave.k_1_m / largest_k_1_m);
    per_charge.push_back(share * wave.weight_1_m2 * potential.at(wave.k_1_m));
  }
  return per_charge;
}

// Whether a load leaves a potential of this angle: even cosines under pressure, odd ones along x, odd sines along y.
bool has_angle(int load, const DiscFunction& function) {
  const auto one = static_cast<TopLoad>(load);
  if (one == TopLoad::kPressure) return function.order % 2 == 0 && !function.is_sine;
  const bool is_along_y = one == TopLoad::kShearY || one == TopLoad::kTiltY;
  return function.order % 2 != 0 && function.is_sine == is_along_y;
}

}  // namespace

Eigen::MatrixXd disc_amplitudes(const PotentialSpectrum& spectrum, const MetalQuarters& quarters) {
  const std::vector<DiscFunction>& functions = quarters.functions();
  Eigen::MatrixXd amplitudes =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(functions.size()), kTopLoads);
  for (const PotentialSpectrum::Wave& wave : spectrum.waves) {
    const Eigen::VectorXd of_wave = quarters.transforms(wave.k_1_m);
    for (Eigen::Index f = 0; f < of_wave.size(); ++f) {
      const DiscFunction& one = functions[static_cast<std::size_t>(f)];
      if (one.order / 2 >= wave.amplitude.rows()) continue;
      for (int load = 0; load < kTopLoads; ++load) {
        if (has_angle(load, one))
          amplitudes(f, load) += of_wave[f] * wave.amplitude(one.order / 2, load);
      }
    }
  }
  return amplitudes;
}

std::vector<Eigen::MatrixXd> induced_amplitudes(const PotentialSpectrum& spectrum,
                                                const LayeredFilm& film,
                                                const MetalQuarters& quarters,
                                                const Eigen::MatrixXd& charges,
                                                const PotentialAccuracy& accuracy) {
  const Eigen::Index count = spectrum.waves.front().amplitude.rows();
  const std::vector<double> per_charge = wave_potentials(spectrum, film, accuracy);
  std::vector<Eigen::MatrixXd> induced;
  for (std::size_t i = 0; i < spectrum.waves.size(); ++i) {
    const Eigen::VectorXd of_wave = quarters.transforms(spectrum.waves[i].k_1_m);
    Eigen::MatrixXd& amplitude = induced.emplace_back(Eigen::MatrixXd::Zero(count, kTopLoads));
    for (Eigen::Index f = 0; f < of_wave.size(); ++f) {
      const DiscFunction& one = quarters.functions()[static_cast<std::size_t>(f)];
      if (one.order / 2 >= count) continue;
      const double factor = per_charge[i] * (one.order == 0 ? 1.0 : 2.0) * of_wave[f];
      for (int load = 0; load < kTopLoads; ++load) {
        if (has_angle(load, one)) amplitude(one.order / 2, load) += factor * charges(f, load);
      }
    }
  }
  return induced;
}

std::vector<Eigen::MatrixXd> induced_amplitudes(const PotentialSpectrum& spectrum,
                                                const LayeredFilm& film, const DiscCharge& charge,
                                                const PotentialAccuracy& accuracy) {
  const Eigen::Index count = spectrum.waves.front().amplitude.rows();
  const std::vector<double> per_charge = wave_potentials(spectrum, film, accuracy);
  std::vector<Eigen::MatrixXd> induced(spectrum.waves.size(),
                                       Eigen::MatrixXd::Zero(count, kTopLoads));
  for (int m = 0; m < 2 * count; ++m) {
    // Even harmonics belong to the pressure, odd ones to the other loads.
    const Eigen::Index j = m / 2;
    const Eigen::Index first = m % 2 == 0 ? 0 : 1;
    const Eigen::Index loads = m % 2 == 0 ? 1 : kTopLoads - 1;
    Eigen::MatrixXd moments = Eigen::MatrixXd::Zero(charge.modes(), loads);
    for (const PotentialSpectrum::Wave& wave : spectrum.waves) {
      moments += charge.transforms(m, wave.k_1_m) * wave.amplitude.row(j).segment(first, loads);
    }
    for (const PotentialSpectrum::OwnWave& wave : spectrum.own) {
      if (m == 0) moments.col(0) += wave.amplitude * charge.transforms(0, wave.k_1_m);
    }
    const Eigen::MatrixXd amplitudes = charge.induced(m, moments);
    for (std::size_t i = 0; i < induced.size(); ++i) {
      induced[i].row(j).segment(first, loads) =
          per_charge[i] * charge.transforms(m, spectrum.waves[i].k_1_m).transpose() * amplitudes;
    }
  }
  return induced;
}

AxialField field_around(const PotentialSpectrum& spectrum) {
  AxialField field;
  field.loads = kTopLoads;
  const Eigen::Index count = spectrum.waves.front().amplitude.rows();
  for (int m = 0; m < 2 * count; ++m) {
    // Even harmonics belong to the pressure, odd ones to the other loads.
    const int first = m % 2 == 0 ? 0 : 1, last = m % 2 == 0 ? 0 : kTopLoads - 1;
    for (int load = first; load <= last; ++load) {
      const auto along = static_cast<TopLoad>(load);
      const bool is_sine = along == TopLoad::kShearY || along == TopLoad::kTiltY;
      field.functions.push_back({static_cast<Eigen::Index>(field.load.size()), m, is_sine});
      field.load.push_back(load);
      field.waves.order.push_back(m);
    }
  }
  field.waves.amplitude.resize(static_cast<Eigen::Index>(spectrum.waves.size()),
                               static_cast<Eigen::Index>(field.load.size()));
  for (std::size_t i = 0; i < spectrum.waves.size(); ++i) {
    field.k_1_m.push_back(spectrum.waves[i].k_1_m);
    for (const AngularFunction& one : field.functions) {
      field.waves.amplitude(static_cast<Eigen::Index>(i), one.radial) = spectrum.waves[i].amplitude(
          one.order / 2, field.load[static_cast<std::size_t>(one.radial)]);
    }
  }
  for (const PotentialSpectrum::OwnWave& wave : spectrum.own) {
    field.own_k_1_m.push_back(wave.k_1_m);
    field.own_amplitude.push_back(wave.amplitude);
  }
  return field;
}

double mutual_influence(const LayeredFilm& film, const DiscCharge& charge, double distance_m,
                        const PotentialAccuracy& accuracy) {
  const double t_m = film.layers.front().thickness_m;
  const double largest_k_1_m = std::max(2.0 * accuracy.largest_kt, kShortWaves) / t_m;
  const ChargePotential potential(film, largest_k_1_m, accuracy.film_degree);
  double mutual_V_C = 0.0;
  each_wave(0.0, largest_k_1_m, std::min(kWavePhase / distance_m, kWaveStep / t_m),
            [&](double k_1_m, double weight) {
              const double reading = charge.weight(k_1_m);
              mutual_V_C += weight * (1.0 - cut(k_1_m / largest_k_1_m)) * potential.at(k_1_m) *
                            reading * reading * ::j0(k_1_m * distance_m);
            });
  return mutual_V_C * charge.capacitance_F();
}

double influence_of_all(const LayeredFilm& film, const DiscCharge& charge,
                        const std::vector<SourcePoint>& points, const PotentialAccuracy& accuracy) {
  constexpr double kThicknesses = 16.0;  // farther away the grounded face hides the charge
  constexpr double kNegligible = 1e-3;   // of the nearest pair's
  constexpr double kGrowth = 1.15;       // of the distances of the table
  constexpr double kWider = 12.0;  // found for two pillars with a small gap; below 1.6 for twelve
  constexpr std::size_t kMostTried = 2000;
  const double t_m = film.layers.front().thickness_m;
  const double nearest_m = nearest_distance_m(points, 2.0 * charge.radius_m());
  if (!(nearest_m < kThicknesses * t_m)) return 0.0;
  std::vector<double> influences;  // at nearest_m kGrowth^i
  double reach_m = nearest_m;
  for (double at_m = nearest_m;; at_m *= kGrowth) {
    influences.push_back(std::abs(mutual_influence(film, charge, at_m, accuracy)));
    reach_m = at_m;
    if (at_m > kThicknesses * t_m || influences.back() < kNegligible * influences.front()) break;
  }
  const auto influence_at = [&](double distance_m) {
    const double place = std::max(0.0, std::log(distance_m / nearest_m) / std::log(kGrowth));
    const auto i = std::min(static_cast<std::size_t>(place), influences.size() - 1);
    const auto next = std::min(i + 1, influences.size() - 1);
    const double share = place - static_cast<double>(i);
    return (1.0 - share) * influences[i] + share * influences[next];
  };
  const Neighbours near(points, reach_m);
  const std::size_t step = 1 + points.size() / kMostTried;
  double largest = 0.0;
  for (std::size_t i = 0; i < points.size(); i += step) {
    double sum = 0.0;
    near.visit(points[i].x_m, points[i].y_m, [&](std::size_t j) {
      if (j == i) return;
      sum += influence_at(std::hypot(points[j].x_m - points[i].x_m, points[j].y_m - points[i].y_m));
    });
    largest = std::max(largest, sum);
  }
  return kWider * largest * largest;
}

}  // namespace viscard
