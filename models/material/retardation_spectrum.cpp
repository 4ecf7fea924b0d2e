#include "models/material/retardation_spectrum.h"

#include "models/maths/require.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace viscard {
namespace {

// A pole of s E(s) or s J(s) on the negative real axis, s = -rate, and the branch that makes it.
struct Pole {
  double rate_1_s = 0.0;
  double weight = 0.0;  // E_i or J_j
};

// A rate between two poles, stored as one of them (or 0) and the signed distance from it: the zero
// of a weak branch lies within rounding of its pole.
struct Rate {
  double base_1_s = 0.0;
  double offset_1_s = 0.0;
  double value_1_s() const { return base_1_s + offset_1_s; }
  double gap_to(const Pole& pole) const { return (pole.rate_1_s - base_1_s) - offset_1_s; }
};

// Poles by ascending rate, without zero weights, equal rates merged.
std::vector<Pole> distinct_poles(std::vector<Pole> poles) {
  std::erase_if(poles, [](const Pole& pole) { return !(pole.weight > 0.0); });
  std::sort(poles.begin(), poles.end(),
            [](const Pole& a, const Pole& b) { return a.rate_1_s < b.rate_1_s; });
  std::vector<Pole> merged;
  for (const Pole& pole : poles) {
    if (!merged.empty() && merged.back().rate_1_s == pole.rate_1_s) {
      merged.back().weight += pole.weight;
    } else {
      merged.push_back(pole);
    }
  }
  return merged;
}

// The zero of a function that is monotonic between two rates, by bisection in the logarithm of the
// distance from the nearer end. rising: the function increases with the rate.
template <typename Function>
Rate zero_between(double slow_1_s, double fast_1_s, bool rising, const Function& function) {
  constexpr double kEfolds = 700.0;  // down to the smallest distance a double can hold
  const bool open_ended = !std::isfinite(fast_1_s);
  const double half_gap_1_s = open_ended ? slow_1_s : 0.5 * (fast_1_s - slow_1_s);
  const bool beyond_middle = (function(Rate{slow_1_s, half_gap_1_s}) > 0.0) != rising;
  const bool from_fast = beyond_middle && !open_ended;
  const double base_1_s = from_fast ? fast_1_s : slow_1_s;
  const double direction = from_fast ? -1.0 : 1.0;
  double near = std::log(half_gap_1_s) - kEfolds;
  double far = std::log(half_gap_1_s);
  if (open_ended && beyond_middle) {
    near = far;
    far += kEfolds;
  }
  for (int step = 0; step < 200; ++step) {
    const double middle = 0.5 * (near + far);
    if (middle == near || middle == far) break;
    const bool positive = function(Rate{base_1_s, direction * std::exp(middle)}) > 0.0;
    const bool zero_at_faster_rate = positive != rising;
    (zero_at_faster_rate != from_fast ? near : far) = middle;
  }
  return {base_1_s, direction * std::exp(0.5 * (near + far))};
}

// Adds the slopes of all poles at a rate to `slope`.
double slope_at(const Rate& rate, const std::vector<Pole>& poles, double slope) {
  for (const Pole& pole : poles) {
    const double gap_1_s = rate.gap_to(pole);
    slope += pole.weight * (pole.rate_1_s / gap_1_s) / gap_1_s;
  }
  return slope;
}

}  // namespace

RetardationSpectrum retardation_from_relaxation(const PronySeries& series) {
  validate(series);
  std::vector<Pole> poles;
  for (const MaxwellTerm& term : series.terms) {
    poles.push_back({1.0 / term.relaxation_time_s, term.modulus_Pa});
  }
  poles = distinct_poles(std::move(poles));
  const double equilibrium_Pa = series.equilibrium_modulus_Pa;

  // s E(s) at s = -r: E_inf - sum E_i r/(r_i - r), falling between poles.
  const auto transform_Pa = [&](const Rate& rate) {
    double sum_Pa = equilibrium_Pa;
    for (const Pole& pole : poles) sum_Pa -= pole.weight * rate.value_1_s() / rate.gap_to(pole);
    return sum_Pa;
  };
  RetardationSpectrum spectrum;
  spectrum.instantaneous_compliance_1_Pa = 1.0 / instantaneous_modulus_Pa(series);
  for (std::size_t i = poles.size(); i-- > 0;) {  // fastest first: ascending retardation times
    if (i == 0 && equilibrium_Pa == 0.0) break;   // a liquid flows; it has one term less
    const double slow_1_s = i == 0 ? 0.0 : poles[i - 1].rate_1_s;
    const Rate zero = zero_between(slow_1_s, poles[i].rate_1_s, /*rising=*/false, transform_Pa);
    // J_j = lambda_j/sum E_i tau_i/(1 - tau_i/lambda_j)^2, with 1 - tau_i r = (r_i - r)/r_i.
    const double sum = slope_at(zero, poles, 0.0);
    spectrum.terms.push_back({1.0 / (zero.value_1_s() * sum), 1.0 / zero.value_1_s()});
  }
  if (equilibrium_Pa == 0.0) {
    double viscosity_Pa_s = 0.0;
    for (const Pole& pole : poles) viscosity_Pa_s += pole.weight / pole.rate_1_s;
    spectrum.fluidity_1_Pa_s = 1.0 / viscosity_Pa_s;
  }
  return spectrum;
}

PronySeries relaxation_from_retardation(const RetardationSpectrum& spectrum) {
  const double instantaneous_1_Pa = spectrum.instantaneous_compliance_1_Pa;
  require(instantaneous_1_Pa > 0.0 && spectrum.fluidity_1_Pa_s >= 0.0,
          "the instantaneous compliance must be positive and the fluidity not negative");
  std::vector<Pole> poles;
  double equilibrium_1_Pa = instantaneous_1_Pa;
  for (const RetardationTerm& term : spectrum.terms) {
    require(term.retardation_time_s > 0.0 && term.compliance_1_Pa >= 0.0,
            "retardation times must be positive and compliances not negative");
    poles.push_back({1.0 / term.retardation_time_s, term.compliance_1_Pa});
    equilibrium_1_Pa += term.compliance_1_Pa;
  }
  poles = distinct_poles(std::move(poles));
  const double fluidity_1_Pa_s = spectrum.fluidity_1_Pa_s;

  // s J(s) at s = -r: J_g + sum J_j r_j/(r_j - r) - fluidity/r, rising between poles.
  const auto transform_1_Pa = [&](const Rate& rate) {
    double sum_1_Pa = instantaneous_1_Pa - fluidity_1_Pa_s / rate.value_1_s();
    for (const Pole& pole : poles) sum_1_Pa += pole.weight * pole.rate_1_s / rate.gap_to(pole);
    return sum_1_Pa;
  };
  const auto add_term = [&](PronySeries& series, double slow_1_s, double fast_1_s) {
    const Rate zero = zero_between(slow_1_s, fast_1_s, /*rising=*/true, transform_1_Pa);
    const double rate_1_s = zero.value_1_s();
    const double slope = slope_at(zero, poles, fluidity_1_Pa_s / (rate_1_s * rate_1_s));
    series.terms.push_back({1.0 / (rate_1_s * slope), 1.0 / rate_1_s});
  };
  constexpr double kOpen = std::numeric_limits<double>::infinity();
  PronySeries series{fluidity_1_Pa_s > 0.0 ? 0.0 : 1.0 / equilibrium_1_Pa, {}};
  for (std::size_t i = poles.size(); i-- > 0;) {
    add_term(series, poles[i].rate_1_s, i + 1 < poles.size() ? poles[i + 1].rate_1_s : kOpen);
  }
  if (fluidity_1_Pa_s > 0.0) {
    if (poles.empty()) {  // Maxwell: one term, tau = J_g/fluidity
      series.terms.push_back({1.0 / instantaneous_1_Pa, instantaneous_1_Pa / fluidity_1_Pa_s});
    } else {
      add_term(series, 0.0, poles.front().rate_1_s);
    }
  }
  return series;
}

double creep_compliance_1_Pa(const RetardationSpectrum& spectrum, double time_s) {
  double compliance_1_Pa =
      spectrum.instantaneous_compliance_1_Pa + spectrum.fluidity_1_Pa_s * time_s;
  for (const RetardationTerm& term : spectrum.terms) {
    compliance_1_Pa += term.compliance_1_Pa * -std::expm1(-time_s / term.retardation_time_s);
  }
  return compliance_1_Pa;
}

}  // namespace viscard
