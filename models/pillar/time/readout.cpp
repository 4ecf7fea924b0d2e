#include "models/pillar/time/readout.h"

#include "models/maths/branch_step.h"
#include "models/maths/require.h"

#include <cmath>
#include <string>

namespace viscard {
namespace {

// Infinite values stand for an open circuit.
void require_in_circuit(bool holds, const std::string& what, double value) {
  require(holds, "the readout's " + what + " is " + text_of(value) + "; it must be positive");
}

}  // namespace

void validate(const Readout& r) {
  const bool is_charge = r.kind == ReadoutKind::kCharge;
  require_in_circuit(r.resistance_Ohm > 0.0, "resistance", r.resistance_Ohm);
  require_in_circuit(r.capacitance_F > 0.0 || (r.capacitance_F == 0.0 && !is_charge),
                     is_charge ? "feedback capacitance" : "capacitance", r.capacitance_F);
  require_in_circuit(r.film_leakage_s > 0.0,
                     "leakage time of the film (resistivity times permittivity)", r.film_leakage_s);
}

ReadoutFilter readout_filter(const Readout& r, double film_capacitance_F) {
  validate(r);
  if (r.kind == ReadoutKind::kCharge) {
    return {film_capacitance_F / r.capacitance_F, r.resistance_Ohm * r.capacitance_F};
  }
  const double whole_F = film_capacitance_F + r.capacitance_F;
  const double conductance_S = 1.0 / r.resistance_Ohm + film_capacitance_F / r.film_leakage_s;
  return {film_capacitance_F / whole_F, whole_F / conductance_S};
}

std::complex<double> response(const ReadoutFilter& filter, double omega_rad_s) {
  if (std::isinf(filter.time_constant_s)) return filter.gain;
  const std::complex<double> x(0.0, omega_rad_s * filter.time_constant_s);
  return filter.gain * (std::abs(x) > 1.0 ? 1.0 / (1.0 + 1.0 / x) : x / (1.0 + x));
}

std::vector<double> reading_of(const ReadoutFilter& filter, const std::vector<double>& time_s,
                               const std::vector<double>& open_voltage_V) {
  std::vector<double> reading;
  double value = 0.0;
  double last_V = 0.0;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    const BranchStep step(i == 0 ? 0.0 : time_s[i] - time_s[i - 1], filter.time_constant_s);
    value = step.decay * value + filter.gain * step.gain * (open_voltage_V[i] - last_V);
    last_V = open_voltage_V[i];
    reading.push_back(value);
  }
  return reading;
}

}  // namespace viscard
