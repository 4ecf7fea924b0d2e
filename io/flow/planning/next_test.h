#pragma once

#include "fit/planning/next_measurement.h"

#include <string>
#include <vector>

namespace viscard {

// What to measure after the fit of this capture for what is wanted ("g_2=5%"). specimen: that of the
// fit. Throws std::invalid_argument for a wish that cannot be read, and std::runtime_error for a file
// that is no capture.
std::vector<NextMeasurement> next_after_capture(const std::string& path, const FitResult& fit,
                                                const Specimen& specimen,
                                                const std::vector<std::string>& want);

}  // namespace viscard
