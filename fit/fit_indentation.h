#pragma once

#include "fit/intervals/fit_result.h"
#include "fit/samples/fit_data.h"

namespace viscard {

// Young's relaxation modulus from an indentation: hereditary integral of the measured depth, or of
// the stage moves of a capture with the frame in series (fit/README.md, eq. 2 and 4). Without a
// contact the moduli are stiffnesses in N/m. Throws std::invalid_argument if the columns differ in
// length, and std::runtime_error if the data cannot be fitted.
FitResult fit_indentation(const IndentationData& data, const FitOptions& options = {});

// fit_indentation() for data whose depth follows from stage moves.
FitResult fit_stage_indentation(const IndentationData& data, const FitOptions& options);

// Adds the flags of what is doubtful about the readings of a capture: saturated, beyond-calibration,
// touch-unknown. fit_indentation() does so itself; a fit of the table of a capture does not know them.
void flag_readings(const IndentationData& data, FitResult& result);

}  // namespace viscard
