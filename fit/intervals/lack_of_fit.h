#pragma once

#include "fit/curves/spectral_model.h"
#include "fit/intervals/fit_result.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// Searches the residual of a fit for a smooth curve that the model leaves over. All columns of the
// model at times of a grid (four a decade, to ten times the longest), with coefficients of either
// sign, are fitted to the residual: they follow any smooth curve in log time, also one that rises.
// What remains is the noise between neighbours. The curve is significant if its sum of squares is
// more than such noise, with its autocorrelation, would give by chance.
//   row_time_s: of each row, since the step.
//   rss: of the fit over all samples.
// Nothing for models whose rows are not in the unit of the data, and for fewer than 12 rows.
std::optional<LackOfFit> lack_of_fit(const SpectralModel& model, const SpectralState& state,
                                     const std::vector<double>& row_time_s, double rss);

// Adds the flag lack-of-fit if the structure is significant, and the defect misfit instead if it is
// far above the noise between neighbours and above 0.5 % of the data. unit: of the data.
void flag_lack_of_fit(const std::string& unit, FitResult& result);

// Adds the defect modulus-rises if the smooth curve through a relaxation, without its drift, rises
// by more than a tenth of its largest value. largest: of the data.
void flag_rise(double largest, FitResult& result);

}  // namespace viscard
