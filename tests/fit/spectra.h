#pragma once

#include "fit/samples/fit_data.h"
#include "models/material/prony_series.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace viscard::test {

// S2: E_inf 1.6, E (.12, .08), tau (.8, 40) s.  S6: E_inf 1, E (.30 .25 .20 .15 .12 .10),
// tau (.03 .3 3 30 300 3000) s.
PronySeries s2();
PronySeries s6();

// Relaxation modulus at n times from 0 to window_s, with noise of that share of E0 whose neighbours
// correlate by rho (0: white).
RelaxationData relaxation_of(const PronySeries& series, std::size_t n, double window_s,
                             double relative_noise, std::uint64_t seed, double rho = 0.0);

// Indentation of that depth history (linear between samples) with force factor 1, noise relative to
// the largest force.
IndentationData indentation_of(const PronySeries& series, const std::vector<double>& time_s,
                               const std::function<double(double)>& depth_m, double relative_noise,
                               std::uint64_t seed);

// Linear ramp to 1e-4 m in ramp_s, then hold.
std::function<double(double)> ramp_and_hold(double ramp_s);

std::vector<double> even_times(double to_s, double step_s);

}  // namespace viscard::test
