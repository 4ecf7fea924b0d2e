#pragma once

#include "models/experiment/captured_run.h"

#include <string>

namespace viscard {

// Throws std::runtime_error naming file, kind and number of a record with a value that no instrument
// gives: a number that is not finite, more counts than a converter of 32 bits has, a force, a voltage,
// a position or a temperature outside models/quantities, or a move that never ends.
void refuse_impossible_values(const CapturedRun& run, const std::string& file);

}  // namespace viscard
