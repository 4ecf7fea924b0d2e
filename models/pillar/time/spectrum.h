#pragma once

#include <vector>

namespace viscard {

// Amplitude spectrum of equally spaced samples, mean removed, Hann window, so that a steady sine of
// amplitude A gives a peak of about A: frequencies k/(n dt). Source: Harris, Proc. IEEE 66
// (1978) 51.
struct Spectrum {
  std::vector<double> frequency_Hz;
  std::vector<double> amplitude;
};
Spectrum amplitude_spectrum(const std::vector<double>& samples, double dt_s);

}  // namespace viscard
