#pragma once

#include <complex>
#include <limits>
#include <vector>

namespace viscard {

// What a dielectric film adds, in time, to its permittivity at once (eq. 37):
//   eps(t) = eps [1 + sum_i share_i (1 - exp(-t/tau_i)) + t/T],  T = resistivity times eps,
//   eps(s) = eps (1 + x(s)),  x = sum_i share_i/(1 + s tau_i) + 1/(s T),  s = i w
// Any such sum is causal and passive (Kramers and Kronig hold). Sources: Debye, Polar Molecules (1929), ch. 5;
// Boettcher & Bordewijk, Theory of Electric Polarization II (1978), ch. 8.
struct FilmTerm {
  double share = 0.0;  // permittivity that it adds at last, over the permittivity at once
  double tau_s = 0.0;
};

// All that a film loses; without terms and leakage nothing.
struct FilmLoss {
  double leakage_s = std::numeric_limits<double>::infinity();  // T
  std::vector<FilmTerm> terms;

  bool is_lossless() const { return terms.empty() && leakage_s == kNever; }
  // In s, of a film without leakage.
  static constexpr double kNever = std::numeric_limits<double>::infinity();
};

// Throws std::invalid_argument unless all shares are finite and not negative and all times positive.
void validate(const FilmLoss& loss);

// x at s = i w, or anywhere else in the Laplace plane but for its poles.
std::complex<double> added_permittivity(const FilmLoss& loss, std::complex<double> s_1_s);
// |x/(1 + x)|: by how much the voltage of a charge that stays falls below that at once. At w = 1/t it is also, to a few
// per cent, the share that a step has lost at the time t.
double lost_share(const FilmLoss& loss, double omega_rad_s);

// Terms, two for each decade, whose loss tangent at the given frequencies, and between them on straight lines over
// ln(frequency), is the given one. Beyond the ends there is no loss but what these terms have there. Throws
// std::invalid_argument unless frequencies ascend, tangents are not negative, and terms exist that meet every tangent
// to a tenth of the largest (tan_delta are pure numbers): a peak can not be narrower than that of one relaxation time.
std::vector<FilmTerm> terms_from_tan_delta(const std::vector<double>& frequency_Hz,
                                           const std::vector<double>& tan_delta);

}  // namespace viscard
