#include "models/pillar/time/readout.h"

#include "models/material/hereditary.h"
#include "models/material/retardation_spectrum.h"
#include "models/maths/require.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace viscard {
namespace {

// Infinite values stand for an open circuit.
void require_in_circuit(bool holds, const std::string& what, double value) {
  require(holds, "the readout's " + what + " is " + text_of(value) + "; it must be positive");
}

}  // namespace

FilmPort bonded_port(const Medium& film, const FilmLoss& loss) {
  const Eigen::RowVectorXd e = film.piezo_C_m2.row(2);
  const double held_F_m = film.permittivity_F_m(2, 2);
  const double free_F_m =
      held_F_m + e.dot(Eigen::VectorXd(viscard::inverse(film.stiffness_Pa) * e.transpose()));
  const double bonded_F_m = held_F_m + e[2] * e[2] / film.stiffness_Pa(2, 2);
  // Held and free are the ends; a voltage that has fallen is the smaller, the freer the film is.
  const double error = std::max(1.0 - held_F_m / free_F_m, free_F_m / bonded_F_m - 1.0);
  return {1.0, held_F_m / bonded_F_m, loss, error, error};
}

double bonded_error(const Medium& film, const FilmLoss& loss, double slowest_rad_s) {
  return loss.is_lossless() ? 0.0 : bonded_port(film, loss).error * lost_share(loss, slowest_rad_s);
}

ReadoutFilter decaying(double gain, double time_constant_s) {
  if (std::isinf(time_constant_s)) return {.gain = gain};
  return {gain, {0.0, {{1.0, time_constant_s}}}, time_constant_s};
}

void validate(const Readout& r) {
  const bool is_charge = r.kind == ReadoutKind::kCharge;
  require_in_circuit(r.resistance_Ohm > 0.0, "resistance", r.resistance_Ohm);
  require_in_circuit(r.capacitance_F > 0.0 || (r.capacitance_F == 0.0 && !is_charge),
                     is_charge ? "feedback capacitance" : "capacitance", r.capacitance_F);
  require_in_circuit(r.film_leakage_s > 0.0,
                     "leakage time of the film (resistivity times permittivity)", r.film_leakage_s);
}

double ReadoutFilter::fastest_s() const {
  double fastest_s = std::numeric_limits<double>::infinity();
  for (const MaxwellTerm& term : step.terms) {
    fastest_s = std::min(fastest_s, term.relaxation_time_s);
  }
  return fastest_s;
}

ReadoutFilter readout_filter(const Readout& r, const FilmPort& film) {
  validate(r);
  validate(film.loss);
  if (r.kind == ReadoutKind::kCharge) {
    return decaying(film.capacitance_F / r.capacitance_F, r.resistance_Ohm * r.capacitance_F);
  }
  const double whole_F = film.capacitance_F + r.capacitance_F;
  const double gain = film.capacitance_F / whole_F;
  const double conductance_S = 1.0 / r.resistance_Ohm + film.capacitance_F / r.film_leakage_s +
                               film.dielectric_F / film.loss.leakage_s;
  if (film.loss.terms.empty()) return decaying(gain, whole_F / conductance_S);
  RetardationSpectrum charge{1.0, {}, conductance_S / whole_F};  // over that at once
  for (const FilmTerm& term : film.loss.terms) {
    charge.terms.push_back({film.dielectric_F / whole_F * term.share, term.tau_s});
  }
  ReadoutFilter filter{gain, relaxation_from_retardation(charge)};
  if (conductance_S == 0.0) return filter;
  filter.time_constant_s = whole_F / conductance_S;
  return filter;
}

ReadoutFilter readout_filter(const Readout& readout, double film_capacitance_F) {
  return readout_filter(readout, {film_capacitance_F, film_capacitance_F});
}

ReadoutFilter open_filter(const FilmPort& film) {
  return readout_filter({}, film);
}

std::complex<double> response(const ReadoutFilter& filter, double omega_rad_s) {
  const ComplexModulus modulus = complex_modulus_Pa(filter.step, omega_rad_s);
  return filter.gain * std::complex<double>(modulus.storage_Pa, modulus.loss_Pa);
}

std::vector<double> reading_of(const ReadoutFilter& filter, const std::vector<double>& time_s,
                               const std::vector<double>& open_voltage_V,
                               std::vector<double>* falling_V_s) {
  std::vector<double> reading;
  HereditaryStress following(filter.step);
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    const double dt_s = i == 0 ? 0.0 : time_s[i] - time_s[i - 1];
    reading.push_back(filter.gain * following.advance(dt_s, open_voltage_V[i]));
    if (falling_V_s != nullptr) falling_V_s->push_back(filter.gain * following.falling_Pa_s());
  }
  return reading;
}

std::vector<double> film_charge_of(const Readout& readout, const FilmPort& film,
                                   const std::vector<double>& time_s,
                                   const std::vector<double>& voltage_V) {
  const double share = film.dielectric_F / film.capacitance_F;
  PronySeries not_yet{1.0, {}};  // the voltage, and polarisation that is still to come
  double at_last = 2.0;
  for (const FilmTerm& term : film.loss.terms) {
    not_yet.terms.push_back({share * term.share, term.tau_s});
    at_last += share * term.share;
  }
  HereditaryStress lacking(std::move(not_yet));
  std::vector<double> charge;
  const double leaks_1_s = share / film.loss.leakage_s + 1.0 / readout.film_leakage_s;
  double leaked_Vs = 0.0;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    const double dt_s = i == 0 ? 0.0 : time_s[i] - time_s[i - 1];
    if (i > 0) leaked_Vs += 0.5 * (voltage_V[i] + voltage_V[i - 1]) * dt_s;
    charge.push_back(at_last * voltage_V[i] + leaks_1_s * leaked_Vs -
                     lacking.advance(dt_s, voltage_V[i]));
  }
  return charge;
}

}  // namespace viscard
