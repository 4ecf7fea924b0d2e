#pragma once

#include "io/flow/predict_file.h"
#include "io/plots/plot.h"

#include <iosfwd>

namespace viscard {

// Prints the prediction as text: a few rows of the curve, what lies outside the window of the fit,
// and how far measured values are from it.
void print_prediction(const PredictedFile& predicted, std::ostream& out);

// The curve with its band and the measured values; the part outside the window of the fit is grey.
// Below it the input of the test, if there is one.
Plot plot_of_prediction(const PredictedFile& predicted);

}  // namespace viscard
