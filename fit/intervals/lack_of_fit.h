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
// Rows of an oscillation are relative to their value, and so is the curve; row_time_s is then the
// frequency of each row, of all storage moduli and again of all loss moduli.
// Nothing for fewer than 12 rows.
std::optional<LackOfFit> lack_of_fit(const SpectralModel& model, const SpectralState& state,
                                     const std::vector<double>& row_time_s, double rss);

// How the text of a lack of fit shows the curve and the place where it is largest.
struct LackOfFitWords {
  std::string unit;  // of the data
  double scale = 1.0;
  std::string at = "t", at_unit = "s";
  std::string advice =
      "a drift (--drift), a liquid (--liquid), a wrong time zero (--time-zero), or too few terms";
};

// Adds the flag lack-of-fit if the structure is significant, and the defect misfit instead if it is
// far above the noise between neighbours and above 0.5 % of the data.
void flag_lack_of_fit(const LackOfFitWords& words, FitResult& result);

// Adds the defect modulus-rises if the smooth curve through a relaxation, without its drift, rises
// by more than a tenth of its largest value. largest: of the data.
void flag_rise(double largest, FitResult& result);

}  // namespace viscard
