#pragma once

#include "fit/assembly/spectral_fit.h"
#include "fit/intervals/fit_result.h"
#include "fit/laws/law_values.h"

#include <vector>

namespace viscard {

// Fits laws of few parameters to the record of a fitted series, on the same rows and with the same
// loading history, offsets and drift, and fills FitResult::laws. A law is a fixed mixture of
// relaxation times (models/material/law_spectrum.h), so that the model's own columns give its exact
// response to a ramp, a history or an oscillation. BIC is that of the table of orders, with the same
// number of independent values. Nuisances (the contact position) keep the values of the series;
// their errors are in the intervals. The scatter within averages is taken from the series.
// Does nothing unless FitOptions::with_laws is set. Call it after fill_result().
void fit_laws(const SpectralModel& model, const SpectralFit& fit, FitResult& result);

// Makes the named law the result: moduli, terms and covariance are those of its Prony series, with
// the flag law-as-series, and misfit if the series of the fit describes the data much better (BIC by
// 10). What was found out about the terms, the order and the E0 of the series is dropped and judged
// again. The defect law-not-a-series: the series misses the law by more than 5 %. Throws std::invalid_argument if no such law was fitted.
void take_law(const std::string& name, FitResult& result);

}  // namespace viscard
