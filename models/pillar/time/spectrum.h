#pragma once

#include <vector>

namespace viscard {

// Amplitude spectrum of equally spaced samples at the frequencies k/(n dt). The mean is removed and
// a Hann window applied, scaled so that a steady sine of amplitude A gives a peak of about A.
// Source: Harris, Proc. IEEE 66 (1978) 51.
struct Spectrum {
  std::vector<double> frequency_Hz;
  std::vector<double> amplitude;
};
Spectrum amplitude_spectrum(const std::vector<double>& samples, double dt_s);

}  // namespace viscard
