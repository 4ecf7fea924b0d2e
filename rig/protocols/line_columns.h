#pragma once

#include "rig/protocols/hx711_protocol.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace viscard {

// Lines of several columns, which boards with more than one channel print: "123,456,789" or
// "1234 <tab> 5678". A rig file names the columns in line_format, separated by commas: "counts" or
// "volts" once, "micros" or "millis" at most once, and "-" for what is not read: "-,counts",
// "millis,-,counts". The columns of a line are separated by commas, semicolons, tabs or blanks; a
// name before the first colon is left out.
// Sources of such lines: Adafruit_NAU7802 and its users (two channels, commas); ADS1256 library of
// Yordan, example Test1 (eight channels, blanks).
struct LineColumns {
  std::vector<std::string> words;
  Hx711Format format = Hx711Format::kCounts;  // of a line that is left with its columns of interest
};

// Nothing for a word that is no list of columns.
std::optional<LineColumns> line_columns_from_word(std::string_view word);

// "time,number" or "number"; nothing if the line has too few columns.
std::optional<std::string> picked_columns(std::string_view line, const LineColumns& columns);

}  // namespace viscard
