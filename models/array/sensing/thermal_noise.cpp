#include "models/array/sensing/thermal_noise.h"

#include "models/maths/require.h"

#include <cmath>
#include <numbers>

namespace viscard {
namespace {

constexpr double kBoltzmann_J_K = 1.380649e-23;  // exact: SI, 9th edition

// Root mean square over the band of a current whose power density grows as f^0 or f^1, on a resistance
// beside a capacitance. A white current gives 4 k T G int df/(G^2 + (w C)^2), Nyquist, Phys. Rev. 32
// (1928) 110; that of a loss tangent d has 4 k T w C_f d on the capacitance alone.
double white_V(double kT_J, double conductance_S, double capacitance_F, const NoiseBand& band) {
  if (!(conductance_S > 0.0)) return 0.0;
  const double T_s = capacitance_F / conductance_S;
  const double high = 2.0 * std::numbers::pi * band.to_Hz * T_s;
  const double low = 2.0 * std::numbers::pi * band.from_Hz * T_s;
  // atan(high) - atan(low) without cancellation.
  const double angle = std::atan2(high - low, 1.0 + high * low);
  return std::sqrt(2.0 * kT_J / (std::numbers::pi * capacitance_F) * angle);
}

}  // namespace

double ThermalNoise::total_V() const {
  return std::sqrt(bias_V * bias_V + loss_V * loss_V + amplifier_V * amplifier_V);
}

ThermalNoise thermal_noise(const NoiseBand& band, const Readout& readout, double capacitance_F) {
  const double kT_J = kBoltzmann_J_K * band.temperature_K;
  const bool is_voltage = readout.kind == ReadoutKind::kVoltage;
  // Capacitance that the currents charge: film and input together, or the feedback.
  const double charged_F =
      is_voltage ? capacitance_F + readout.capacitance_F : readout.capacitance_F;
  // The film's leakage lies beside the input; a charge amplifier keeps the film at 0 V, and its current
  // goes into the feedback.
  const double of_film_S = capacitance_F / readout.film_leakage_s;
  const double of_amplifier_S = 1.0 / readout.resistance_Ohm;
  ThermalNoise noise;
  if (is_voltage) {
    noise.bias_V = white_V(kT_J, of_amplifier_S + of_film_S, charged_F, band);
  } else {
    // A current of the film's leakage meets the feedback's impedance, not its own.
    const double own_V = white_V(kT_J, of_amplifier_S, charged_F, band);
    const double share = of_amplifier_S > 0.0 ? of_film_S / of_amplifier_S : 0.0;
    noise.bias_V = own_V * std::sqrt(1.0 + share);
  }
  noise.loss_V = std::sqrt(4.0 * kT_J * capacitance_F * band.loss_tangent /
                           (2.0 * std::numbers::pi * charged_F * charged_F) *
                           std::log(band.to_Hz / band.from_Hz));
  const double of_input = is_voltage ? 1.0 : 1.0 + capacitance_F / readout.capacitance_F;
  noise.amplifier_V = of_input * band.amplifier_V_rtHz * std::sqrt(band.to_Hz - band.from_Hz);
  noise.gain = capacitance_F / charged_F;
  noise.reset_V = std::sqrt(kT_J / capacitance_F);
  return noise;
}

void validate(const NoiseBand& band) {
  require(band.temperature_K > 0.0, "the temperature of noise must be positive");
  require(band.from_Hz > 0.0 && band.to_Hz > band.from_Hz,
          "noise is that of a band: 'from' must be positive and 'to' above it");
  require(band.loss_tangent >= 0.0 && band.amplifier_V_rtHz >= 0.0,
          "a loss tangent and the noise of an amplifier are not negative");
}

}  // namespace viscard
