#pragma once

#include "fit/intervals/fit_result.h"
#include "fit/intervals/uncertainty.h"
#include "fit/search/separable.h"

#include <cstdint>

namespace viscard {

// Replaces the 95 % intervals of a result by percentiles of refits to the fitted curve plus
// randomly drawn blocks of its own residuals: the circular moving-block bootstrap (Kuensch, Ann.
// Statist. 17 (1989) 1217), whose blocks preserve the autocorrelation of the noise. The block
// length is that of Politis & White, Econometric Rev. 23 (2004) 53, for an autoregression of first
// order with the given inflation. The seed is fixed: the same data give the same intervals.
struct BootstrapOptions {
  int n_resamples = 200;
  double inflation = 1.0;
  std::uint64_t seed = 1;
};
void bootstrap_intervals(const SpectralModel& model, const SpectralState& state,
                         const SeriesFromState& series_from_state, const BootstrapOptions& options,
                         FitResult& result);

}  // namespace viscard
