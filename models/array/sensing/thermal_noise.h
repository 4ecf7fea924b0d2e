#pragma once

#include "models/pillar/time/readout.h"

namespace viscard {

// Noise of an electrode and its amplifier between two frequencies (eq. H5), V rms at the output.
struct NoiseBand {
  double temperature_K = 300.0;
  double from_Hz = 1.0, to_Hz = 100.0;
  double loss_tangent = 0.0;      // of the film
  double amplifier_V_rtHz = 0.0;  // at its input, per root of 1 Hz
};

// V rms at the output, by cause.
struct ThermalNoise {
  double bias_V = 0.0;  // of the resistance, input or feedback, and of the film's own leakage
  double loss_V = 0.0;  // of the film's dielectric loss
  double amplifier_V = 0.0;
  double gain = 1.0;     // output over the open voltage of the electrode, within the band
  double reset_V = 0.0;  // of an electrode that was shorted and let go: sqrt(k T/C), open voltage
  double total_V() const;
};

// The noise of one electrode with this capacitance behind this readout.
ThermalNoise thermal_noise(const NoiseBand& band, const Readout& readout, double capacitance_F);

// Throws std::invalid_argument naming the value that is wrong.
void validate(const NoiseBand& band);

}  // namespace viscard
