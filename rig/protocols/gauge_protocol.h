#pragma once

#include "models/experiment/rig_config.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace viscard {

// What an instrument that is asked for each reading has answered.
struct GaugeAnswer {
  std::optional<double> volts;    // a multimeter's ...
  std::optional<double> force_N;  // ... or a force gauge's reading, positive in compression
  bool is_overload = false;       // it says itself that its range is exceeded
  std::string unit;               // as written on the wire; empty if none was
  std::string error;              // it refused: what it said
};

// How to talk to one kind of instrument, apart from any port; one row per instrument.
struct GaugeProtocol {
  std::string name;
  std::vector<std::string> opening;  // sent on connecting, one after another, never answered
  std::string identity_query;        // empty: it cannot tell
  std::string query;                 // asks for one reading
  std::string error_query;           // asked once after the opening; empty: none
  std::string closing;               // sent in the end
  // Answers of so many bytes without any terminator; 0: answers are lines.
  std::size_t fixed_length = 0;
  // Nothing for text that is no answer.
  std::function<std::optional<GaugeAnswer>(std::string_view)> parse;
};

// The row for a rig file's driver ("scpi", "mark10", "sauter") with its dialect and unit. Throws
// RigError naming the words there are.
GaugeProtocol gauge_protocol(const LoadCellConfig& config);

}  // namespace viscard
