#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace viscard {

// One answer of an instrument that is polled.
struct GaugeAnswer {
  std::optional<double> volts;    // reading of a multimeter ...
  std::optional<double> force_N;  // ... or of a force gauge, positive in compression
  bool is_overload = false;       // the instrument reports that its range is exceeded
  std::string unit;               // as sent; empty if none was sent
  std::string error;              // the text of a refusal; empty otherwise
};

// How to poll one kind of instrument; knows no port. There is one such row per instrument.
struct GaugeProtocol {
  std::string name;
  std::vector<std::string> opening;  // sent one by one when connecting; none is answered
  std::string identity_query;        // empty: the instrument has no identity
  std::string query;                 // asks for one reading
  std::string error_query;           // sent once after the opening; empty: none
  std::string closing;               // sent at the end
  // Length of answers without a terminator, bytes; 0: answers are lines.
  std::size_t fixed_length = 0;
  // Returns nothing for text that is no answer.
  std::function<std::optional<GaugeAnswer>(std::string_view)> parse;
};

}  // namespace viscard
