#include "models/material/film_loss.h"

#include "models/maths/require.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace viscard {
namespace {

using Complex = std::complex<double>;

// Linear over ln(frequency), constant beyond the ends.
double between(const std::vector<double>& frequency_Hz, const std::vector<double>& tan_delta,
               double at_Hz) {
  const auto above = std::upper_bound(frequency_Hz.begin(), frequency_Hz.end(), at_Hz);
  if (above == frequency_Hz.begin()) return tan_delta.front();
  if (above == frequency_Hz.end()) return tan_delta.back();
  const auto i = static_cast<std::size_t>(above - frequency_Hz.begin());
  const double part =
      std::log(at_Hz / frequency_Hz[i - 1]) / std::log(frequency_Hz[i] / frequency_Hz[i - 1]);
  return tan_delta[i - 1] + part * (tan_delta[i] - tan_delta[i - 1]);
}

void check_table(const std::vector<double>& frequency_Hz, const std::vector<double>& tan_delta) {
  require(frequency_Hz.size() == tan_delta.size() && !frequency_Hz.empty(),
          "a table of loss tangents needs as many frequencies as tangents, at least one");
  for (std::size_t i = 0; i < frequency_Hz.size(); ++i) {
    require(std::isfinite(frequency_Hz[i]) && frequency_Hz[i] > (i > 0 ? frequency_Hz[i - 1] : 0.0),
            "the frequencies of loss tangents must be positive and ascend");
    require(tan_delta[i] >= 0.0 && tan_delta[i] < 1e3, "loss tangents must not be negative");
  }
}

double tan_delta_of(const FilmLoss& loss, double omega_rad_s) {
  const Complex eps = 1.0 + added_permittivity(loss, Complex(0.0, omega_rad_s));
  return -eps.imag() / eps.real();
}

}  // namespace

void validate(const FilmLoss& loss) {
  require(loss.leakage_s > 0.0,
          "the leakage time of the film (resistivity times permittivity) is " +
              text_of(loss.leakage_s) + "; it must be positive");
  for (const FilmTerm& term : loss.terms) {
    require(term.share >= 0.0 && std::isfinite(term.share) && term.tau_s > 0.0 &&
                std::isfinite(term.tau_s),
            "a dielectric term of the film needs a positive time and a permittivity that is not "
            "negative");
  }
}

Complex added_permittivity(const FilmLoss& loss, Complex s_1_s) {
  Complex x = 1.0 / loss.leakage_s / s_1_s;
  for (const FilmTerm& term : loss.terms) x += term.share / (1.0 + s_1_s * term.tau_s);
  return x;
}

double lost_share(const FilmLoss& loss, double omega_rad_s) {
  return std::abs(1.0 - 1.0 / (1.0 + added_permittivity(loss, Complex(0.0, omega_rad_s))));
}

std::vector<FilmTerm> terms_from_tan_delta(const std::vector<double>& frequency_Hz,
                                           const std::vector<double>& tan_delta) {
  check_table(frequency_Hz, tan_delta);
  constexpr int kRounds = 1000;
  constexpr double kAllowed = 0.1;  // of the largest tangent
  const double largest = *std::max_element(tan_delta.begin(), tan_delta.end());
  if (largest == 0.0) return {};
  const double ratio = std::sqrt(10.0);
  FilmLoss loss;
  std::vector<double> omega, wanted;
  for (double f = frequency_Hz.back() * ratio; f > frequency_Hz.front() / (1.5 * ratio);
       f /= ratio) {
    omega.push_back(2.0 * std::numbers::pi * f);
    wanted.push_back(between(frequency_Hz, tan_delta, f));
    loss.terms.push_back({largest, 1.0 / omega.back()});
  }
  // A term is raised or lowered by the quotient of wanted and present loss at its own frequency, so none becomes
  // negative. Source: Lucy, Astron. J. 79 (1974) 745.
  for (int round = 0; round < kRounds; ++round) {
    double worst = 0.0;
    std::vector<double> factor;
    for (std::size_t i = 0; i < omega.size(); ++i) {
      const double now = tan_delta_of(loss, omega[i]);
      factor.push_back(wanted[i] / std::max(now, 1e-300));
      worst = std::max(worst, std::abs(wanted[i] - now));
    }
    if (worst <= 1e-4 * largest) break;
    for (std::size_t i = 0; i < omega.size(); ++i) loss.terms[i].share *= factor[i];
  }
  for (std::size_t i = 0; i < frequency_Hz.size(); ++i) {
    const double now = tan_delta_of(loss, 2.0 * std::numbers::pi * frequency_Hz[i]);
    require(std::abs(now - tan_delta[i]) <= kAllowed * largest,
            "no sum of relaxations has a loss tangent of " + text_of(tan_delta[i]) + " at " +
                text_of(frequency_Hz[i]) + " Hz beside the others (the nearest is " +
                text_of(now, 3) + "); a peak is at least 1.1 decades wide");
  }
  std::erase_if(loss.terms, [&](const FilmTerm& term) { return term.share < 1e-12 * largest; });
  return loss.terms;
}

}  // namespace viscard
