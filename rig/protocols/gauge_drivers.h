#pragma once

#include "models/experiment/rig_config.h"
#include "rig/protocols/gauge_protocol.h"

namespace viscard {

// The protocol for a rig file's driver ("scpi", "mark10", "sauter") with its dialect and unit.
// Throws RigError on an unknown word; the message lists the known ones.
GaugeProtocol gauge_protocol(const LoadCellConfig& config);

}  // namespace viscard
