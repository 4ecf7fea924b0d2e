#include "models/material/frequency_band.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

constexpr double kRadiansPerTurn = 2.0 * std::numbers::pi;
constexpr int kSamples = 401;  // of a band, for integrals and largest deviations; odd

LossDeviation largest_deviation(const std::vector<double>& band_Hz,
                                const std::vector<double>& loss_factors,
                                const std::function<double(double omega)>& reduced) {
  LossDeviation largest;
  for (std::size_t i = 0; i < band_Hz.size(); ++i) {
    const double off = std::abs(reduced(kRadiansPerTurn * band_Hz[i]) - loss_factors[i]);
    if (i == 0 || off > largest.value) largest = {off, band_Hz[i], loss_factors[i]};
  }
  return largest;
}

// Weights of Simpson's rule over an odd number of equidistant samples, their mean being one.
double simpson_weight(std::size_t sample, std::size_t count) {
  const double part = sample == 0 || sample + 1 == count ? 1.0 : sample % 2 == 1 ? 4.0 : 2.0;
  return part / 3.0 * static_cast<double>(count) / static_cast<double>(count - 1);
}

// Integrals of the normal equations of eta = a/x + b x over log f, x being omega over its value in
// mid-band.
struct RayleighSums {
  double inverse = 0.0, cross = 0.0, square = 0.0;  // of 1/x^2, of 1, of x^2
  double eta_over_x = 0.0, eta_x = 0.0, eta = 0.0;
};

RayleighSums rayleigh_sums(const std::vector<double>& band_Hz,
                           const std::vector<double>& loss_factors, double middle_Hz) {
  RayleighSums sums;
  for (std::size_t i = 0; i < band_Hz.size(); ++i) {
    const double x = band_Hz[i] / middle_Hz, eta = loss_factors[i];
    const double weight = simpson_weight(i, band_Hz.size());
    sums.inverse += weight / (x * x);
    sums.cross += weight;
    sums.square += weight * x * x;
    sums.eta_over_x += weight * eta / x;
    sums.eta_x += weight * eta * x;
    sums.eta += weight * eta;
  }
  return sums;
}

void fit_rayleigh(const RayleighSums& sums, double middle_rad_s, BandReduction& out) {
  const double determinant = sums.inverse * sums.square - sums.cross * sums.cross;
  double a = (sums.eta_over_x * sums.square - sums.eta_x * sums.cross) / determinant;
  double b = (sums.eta_x * sums.inverse - sums.eta_over_x * sums.cross) / determinant;
  // Neither coefficient may feed energy in; the other one alone is then fitted.
  if (a < 0.0) {
    a = 0.0;
    b = sums.eta_x / sums.square;
  } else if (b < 0.0) {
    b = 0.0;
    a = sums.eta_over_x / sums.inverse;
  }
  out.alpha_1_s = a * middle_rad_s;
  out.beta_s = b / middle_rad_s;
  out.beta_alone_s = sums.eta_x / sums.square / middle_rad_s;
  out.loss_factor = sums.eta / sums.cross;
}

// Of the storage moduli.
double poisson_ratio(const Material& material, const DynamicModuli& moduli) {
  if (material.nu == 0.5 || has_constant_poisson_ratio(material)) return material.nu;
  const double ratio = moduli.shear_Pa.real() / moduli.bulk_Pa.real();
  return (3.0 - 2.0 * ratio) / (2.0 * (3.0 + ratio));
}

std::complex<double> mixed(std::complex<double> one, std::complex<double> other, double weight) {
  return (1.0 - weight) * one + weight * other;
}

}  // namespace

void validate(const FrequencyBand& band) {
  if (band.from_Hz > 0.0 && band.to_Hz > band.from_Hz && std::isfinite(band.to_Hz)) return;
  throw std::invalid_argument(
      "a band needs two frequencies in Hz, the lower one first and above 0");
}

FrequencyBand supported_band(const Material& material) {
  const ValidityWindow& valid = material.valid;
  if (valid.t_min_s > 0.0 && valid.t_max_s > valid.t_min_s) {
    return {1.0 / (kRadiansPerTurn * valid.t_max_s), 1.0 / (kRadiansPerTurn * valid.t_min_s)};
  }
  const RelaxationTimes times = relaxation_times(material.terms);
  if (!(times.slowest_s > 0.0)) return {1.0, 1000.0};
  return {0.1 / (kRadiansPerTurn * times.slowest_s), 10.0 / (kRadiansPerTurn * times.fastest_s)};
}

std::vector<double> frequencies_Hz(const FrequencyBand& band, int count) {
  std::vector<double> out;
  for (int i = 0; i < count; ++i) {
    const double part = static_cast<double>(i) / (count - 1);
    out.push_back(band.from_Hz * std::pow(band.to_Hz / band.from_Hz, part));
  }
  out.back() = band.to_Hz;
  return out;
}

DynamicModuli dynamic_moduli(const Material& material, double frequency_Hz) {
  const RelativeModuli relative =
      relative_moduli(material.terms, std::complex<double>(0.0, kRadiansPerTurn * frequency_Hz));
  const DerivedModuli moduli = derived_moduli(material);
  DynamicModuli out;
  out.shear_Pa = moduli.G0_Pa * relative.shear;
  if (material.nu == 0.5) {
    out.bulk_Pa = moduli.K0_Pa;
    out.young_Pa = 3.0 * out.shear_Pa;
    return out;
  }
  out.bulk_Pa = moduli.K0_Pa * relative.bulk;
  out.young_Pa = 9.0 * out.bulk_Pa * out.shear_Pa / (3.0 * out.bulk_Pa + out.shear_Pa);
  return out;
}

BandReduction reduce_to_band(const Material& material, const FrequencyBand& band) {
  validate(band);
  const std::vector<double> band_Hz = frequencies_Hz(band, kSamples);
  std::vector<double> storage_Pa, loss_factors;
  for (const double frequency_Hz : band_Hz) {
    const DynamicModuli moduli = dynamic_moduli(material, frequency_Hz);
    storage_Pa.push_back(moduli.young_Pa.real());
    loss_factors.push_back(moduli.loss_factor());
  }
  BandReduction out;
  const auto [low, high] = std::minmax_element(storage_Pa.begin(), storage_Pa.end());
  out.young_Pa = 2.0 * *low * *high / (*low + *high);
  out.storage_change = (*high - *low) / (*high + *low);
  out.storage_ratio = *high / *low;
  const double middle_Hz = std::sqrt(band.from_Hz * band.to_Hz);
  out.poisson = poisson_ratio(material, dynamic_moduli(material, middle_Hz));
  fit_rayleigh(rayleigh_sums(band_Hz, loss_factors, middle_Hz), kRadiansPerTurn * middle_Hz, out);
  out.of_loss_factor =
      largest_deviation(band_Hz, loss_factors, [&](double) { return out.loss_factor; });
  out.of_rayleigh = largest_deviation(band_Hz, loss_factors, [&](double omega) {
    return out.alpha_1_s / omega + out.beta_s * omega;
  });
  out.of_beta_alone = largest_deviation(band_Hz, loss_factors,
                                        [&](double omega) { return out.beta_alone_s * omega; });
  return out;
}

double interpolation_error(const Material& material, const std::vector<double>& table_Hz) {
  double largest = 0.0;
  for (std::size_t i = 1; i < table_Hz.size(); ++i) {
    const double from_Hz = table_Hz[i - 1], to_Hz = table_Hz[i];
    const auto from = dynamic_moduli(material, from_Hz).shear_Pa;
    const auto to = dynamic_moduli(material, to_Hz).shear_Pa;
    constexpr int kPlaces = 8;
    for (int place = 1; place < kPlaces; ++place) {
      const double part = static_cast<double>(place) / kPlaces;
      const double frequency_Hz = from_Hz * std::pow(to_Hz / from_Hz, part);
      const auto exact = dynamic_moduli(material, frequency_Hz).shear_Pa;
      const double linear = (frequency_Hz - from_Hz) / (to_Hz - from_Hz);
      for (const double weight : {part, linear}) {
        largest = std::max(largest, std::abs(mixed(from, to, weight) - exact) / std::abs(exact));
      }
    }
  }
  return largest;
}

}  // namespace viscard
