#pragma once

#include "fit/intervals/fit_result.h"

#include <optional>

namespace viscard {

// True for a fit with E_inf held at 0, as chosen from the data or by --liquid.
bool is_liquid(const FitResult& fit);

// The viscosity of slow flow, sum E_i tau_i and the dashpot beside the terms. The interval is that of
// its logarithm, so that its lower end stays positive.
struct Viscosity {
  double value_Pa_s = 0.0;
  Interval interval_95;
};

// Viscosity of a liquid; nothing for a solid, or if the fit gives stiffnesses instead of moduli.
std::optional<Viscosity> viscosity_of(const FitResult& fit);

}  // namespace viscard
