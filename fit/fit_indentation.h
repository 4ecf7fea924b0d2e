#pragma once

#include "fit/intervals/fit_result.h"
#include "fit/samples/fit_data.h"

namespace viscard {

// Young's relaxation modulus from an indentation: hereditary integral on the measured depth, or on
// the stage moves of a capture with the frame in series   (fit/README.md, eq. 2 and 4). Without a
// contact the moduli are stiffnesses in N/m. Throws std::invalid_argument (columns unequal) or
// std::runtime_error (nothing that can be fitted).
FitResult fit_indentation(const IndentationData& data, const FitOptions& options = {});

}  // namespace viscard
