#pragma once

#include "models/experiment/rig_config.h"
#include "rig/lines/line_splitter.h"
#include "rig/protocols/hx711_protocol.h"

#include <optional>
#include <vector>

namespace viscard {

// The line_format of a rig file. Throws RigError on an unknown word.
Hx711Format declared_hx711_format(const LoadCellConfig& config);

// The format that all of these lines have, or nothing if they have none in common. rate_Hz:
// expected rate of the readings, which shows the unit of a clock at the beginning of the line.
std::optional<Hx711Format> learnt_hx711_format(const std::vector<ReceivedLine>& lines,
                                               double rate_Hz);

}  // namespace viscard
