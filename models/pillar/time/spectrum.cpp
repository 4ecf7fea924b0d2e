#include "models/pillar/time/spectrum.h"

#include <unsupported/Eigen/FFT>

#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

namespace viscard {

Spectrum amplitude_spectrum(const std::vector<double>& samples, double dt_s) {
  const std::size_t n = samples.size();
  if (n < 4 || !(dt_s > 0.0)) throw std::invalid_argument("a spectrum needs at least four samples");
  double mean = 0.0;
  for (const double x : samples) mean += x / static_cast<double>(n);
  std::vector<double> windowed(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double phase = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    windowed[i] = (samples[i] - mean) * (1.0 - std::cos(phase));  // Hann, of mean one
  }
  std::vector<std::complex<double>> transform;
  Eigen::FFT<double> fft;
  fft.fwd(transform, windowed);
  Spectrum spectrum;
  for (std::size_t k = 0; k <= n / 2; ++k) {
    spectrum.frequency_Hz.push_back(static_cast<double>(k) / (static_cast<double>(n) * dt_s));
    spectrum.amplitude.push_back(2.0 * std::abs(transform[k]) / static_cast<double>(n));
  }
  return spectrum;
}

}  // namespace viscard
