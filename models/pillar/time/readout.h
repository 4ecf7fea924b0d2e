#pragma once

#include <complex>
#include <limits>
#include <vector>

namespace viscard {

// The circuit connected to the electrode of a film. The film is a voltage source (its open-circuit
// voltage) behind its capacitance (Thevenin). For every circuit here,
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
  double film_leakage_s = std::numeric_limits<double>::infinity();  // rho eps
};

// Throws std::invalid_argument for a value that is not positive or a charge amplifier without C_f.
void validate(const Readout& readout);

// The circuit as the filter of eq. 23.
struct ReadoutFilter {
  double gain = 1.0;  // a
  double time_constant_s = std::numeric_limits<double>::infinity();
};
// The filter of a circuit behind a film of that capacitance.
ReadoutFilter readout_filter(const Readout& readout, double film_capacitance_F);

// Reading over open-circuit voltage at one frequency.
std::complex<double> response(const ReadoutFilter& filter, double omega_rad_s);

// Reading from an open-circuit voltage that is linear between the given times (two equal times are
// a jump), from rest. Exact for such a voltage with any steps.
std::vector<double> reading_of(const ReadoutFilter& filter, const std::vector<double>& time_s,
                               const std::vector<double>& open_voltage_V);

}  // namespace viscard
