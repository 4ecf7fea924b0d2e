#pragma once

#include "fit/assembly/assemble_result.h"
#include "fit/curves/step_model.h"

#include <string>

namespace viscard {

// Fills FitResult::curves with the bin averages of a step fit.
void fill_step_curves(const StepModel& model, const SpectralFit& fit, const std::string& unit,
                      FitResult& result);

}  // namespace viscard
