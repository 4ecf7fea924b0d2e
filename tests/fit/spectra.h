#pragma once

#include "fit/samples/fit_data.h"
#include "models/material/prony_series.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace viscard::test {

// S2: E_inf 1.6, E (0.12, 0.08), tau (0.8, 40) s. S6: E_inf 1, E (0.30 0.25 0.20 0.15 0.12 0.10),
// tau (0.03 0.3 3 30 300 3000) s.
PronySeries s2();
PronySeries s6();

// Relaxation modulus at n times from 0 to window_s. The noise is relative to E0 and has a
// correlation of rho between neighbours (0: white).
RelaxationData relaxation_of(const PronySeries& series, std::size_t n, double window_s,
                             double relative_noise, std::uint64_t seed, double rho = 0.0);

// Indentation with that depth history (linear between samples) and force factor 1. The noise is
// relative to the largest force.
IndentationData indentation_of(const PronySeries& series, const std::vector<double>& time_s,
                               const std::function<double(double)>& depth_m, double relative_noise,
                               std::uint64_t seed);

// Linear ramp to 1e-4 m in ramp_s, then hold.
std::function<double(double)> ramp_and_hold(double ramp_s);

std::vector<double> even_times(double to_s, double step_s);

}  // namespace viscard::test
