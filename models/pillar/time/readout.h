#pragma once

#include "models/material/film_loss.h"
#include "models/material/prony_series.h"
#include "models/pillar/system/medium.h"

#include <complex>
#include <limits>
#include <vector>

namespace viscard {

// The circuit connected to the electrode of a film. The film is a voltage source (its open-circuit
// voltage right after a load) behind its capacitance (Thevenin). Without losses of the film,
//   reading' + reading/T = a open_voltage'   (eq. 23)
//   voltage amplifier of input R, C_in:  a = C/(C + C_in), 1/T = (1/R + C/(rho eps))/(C + C_in)
//   charge amplifier of feedback R_f, C_f: a = C/C_f, 1/T = 1/(R_f C_f), the electrode held at 0 V
// where rho eps is the film's own leakage time, independent of its shape. Sources: Measurement
// Specialties, Piezo Film Sensors Technical Manual (1999); Horowitz & Hill, The Art of Electronics.
enum class ReadoutKind { kVoltage, kCharge };

// Kind and components of the circuit.
struct Readout {
  ReadoutKind kind = ReadoutKind::kVoltage;
  double resistance_Ohm = std::numeric_limits<double>::infinity();  // input, or feedback
  double capacitance_F = 0.0;                                       // input, or feedback
  // After which an open electrode has lost its charge through the film, taken as rho eps^S, of which strain
  // makes some per cent more; FilmPort::loss knows it exactly.
  double film_leakage_s = std::numeric_limits<double>::infinity();
};

// Throws std::invalid_argument for a value that is not positive or a charge amplifier without C_f.
void validate(const Readout& readout);

// An electrode and its film.
struct FilmPort {
  double capacitance_F = 0.0;
  // That part of it which is proportional to the permittivity at constant strain, dC/d(ln eps); the
  // rest is the strain that a voltage makes.
  double dielectric_F = 0.0;
  FilmLoss loss = {};
  // Relative errors of the voltage of an open electrode, and of the reading of a circuit, over the share that
  // the film loses (lost_share()).
  double error = 0.0, error_in_circuit = 0.0;
};
// A face of a film that is bonded to a base and wide beside its thickness: its potentials fall as those of
// a condenser of permittivity eps^S + e33^2/c33. By the part of C that strain makes, that of a film
// between held (eps^S) and free (eps^T), it errs by at most the distance to
// either end, 1 - eps^S/eps^T or, of a voltage that has fallen, eps^T/(eps^S + e33^2/c33) - 1.
FilmPort bonded_port(const Medium& film, const FilmLoss& loss);
// The relative error of a voltage or reading that this makes under a load whose slowest change is given.
double bonded_error(const Medium& film, const FilmLoss& loss, double slowest_rad_s);

// What reads the open-circuit voltage. Under a step of 1 V the reading falls as a modulus relaxes,
//   reading(t) = a [s_inf + sum s_i exp(-t/T_i)],  s_inf + sum s_i = 1   (eq. 23b),
// because the charge that a voltage takes up, C + C_in and the terms and conductances of circuit and
// film, has the form of a creep compliance (eq. 3), and the two are each other's inverse (eq. 4).
struct ReadoutFilter {
  double gain = 1.0;          // a, at once
  PronySeries step{1.0, {}};  // s_inf, s_i and T_i
  // The area under the step over its height, sum s_i T_i = (C + C_in)/G; infinite: some of it stays.
  double time_constant_s = std::numeric_limits<double>::infinity();
  double fastest_s() const;  // the shortest T_i; infinite: there is none
};
// One that falls with a single time from `gain`, reading over voltage.
ReadoutFilter decaying(double gain, double time_constant_s);
// The filter of a circuit behind an electrode. A charge amplifier holds it at 0 V, where a film loses nothing.
ReadoutFilter readout_filter(const Readout& readout, const FilmPort& film);
ReadoutFilter readout_filter(const Readout& readout, double film_capacitance_F);
// From the voltage of an open electrode right after a load to that in time.
ReadoutFilter open_filter(const FilmPort& film);

// Reading over open-circuit voltage at one frequency.
std::complex<double> response(const ReadoutFilter& filter, double omega_rad_s);

// Reading from an open-circuit voltage that is linear between the given times (two equal times are
// a jump), from rest. Exact for such a voltage with any steps. `falling_V_s`: if not null, the rate
// at which each reading falls under a voltage that stays.
std::vector<double> reading_of(const ReadoutFilter& filter, const std::vector<double>& time_s,
                               const std::vector<double>& open_voltage_V,
                               std::vector<double>* falling_V_s = nullptr);

// Charge that a film behind a circuit takes up under a voltage, over C, with its leakage and late polarisation.
std::vector<double> film_charge_of(const Readout& readout, const FilmPort& film,
                                   const std::vector<double>& time_s,
                                   const std::vector<double>& voltage_V);

}  // namespace viscard
