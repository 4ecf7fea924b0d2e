#pragma once

#include "fit/intervals/fit_result.h"
#include "fit/samples/fit_data.h"

namespace viscard {

// Prony series from storage and loss modulus together, with equal relative errors. rss is the sum
// over both columns in Pa^2; noise.sigma is relative; curves hold E' and E'' over frequency. A dashpot
// beside the terms (dashpot_Pa_s) is tried by itself. The flag storage-loss-contradict says where the
// two moduli do not belong together (fit/assembly/kramers_kronig.h). Throws as fit_relaxation() does, and std::runtime_error for a frequency that is not positive.
FitResult fit_dma(const DmaData& data, const FitOptions& options = {});

}  // namespace viscard
