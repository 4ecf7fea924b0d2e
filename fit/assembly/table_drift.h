#pragma once

#include "fit/assembly/spectral_fit.h"
#include "fit/intervals/fit_result.h"

#include <functional>
#include <string>
#include <vector>

namespace viscard {

// Fills lack_of_fit and drift of a result. row_time_s: of each row of the model; zero_s: when the
// load began.
void examine_rows(const SpectralModel& model, const SpectralFit& fit,
                  std::vector<double> row_time_s, double zero_s, FitResult& result);
template <typename Model>  // with row_time_s()
void examine_table(const Model& model, const SpectralFit& fit, double zero_s, FitResult& result) {
  examine_rows(model, fit, model.row_time_s(), zero_s, result);
}

// Data that the choice for or against a drift needs.
struct TableExtent {
  double duration_s = 0.0;
  double largest = 0.0;  // of the fitted column
  std::string unit;      // of the fitted column
};

// Fits a table with or without a drift of the instrument. If the options do not decide, the drift is
// tried where the residual of the fit without it has structure. It is taken if it raises the BIC by
// ten, halves that structure and moves the record by no more than a tenth of its largest value; a
// larger change is not that of an instrument. Then adds the flags drift-fitted, lack-of-fit or
// misfit. A drift downwards looks like a relaxation slower than the record, so E_inf is then bounded
// from above only: its interval reaches down to the value for a relaxation time of three records.
//   fit: makes the result for one choice, with examine_table() applied.
FitResult fit_with_or_without_drift(const FitOptions& options, const TableExtent& table,
                                    const std::function<FitResult(TableDrift)>& fit);

}  // namespace viscard
