#include "rig/protocols/hx711_protocol.h"

#include <catch2/catch.hpp>

#include <string>

namespace viscard {

TEST_CASE("every known format of a reading is read", "[rig]") {
  struct Row {
    const char* line;
    bool has_clock;
    double value;
    const char* unit;
  };
  const Row row =
      GENERATE(Row{"8388", false, 8388, ""}, Row{"HX711 reading: 12345", false, 12345, ""},
               Row{"one reading:\t12.3\t| average:\t12.4", false, 12.3, ""},
               Row{"Load_cell output val: 12.34", false, 12.34, ""}, Row{"12,34", false, 12.34, ""},
               Row{"-0.00", false, 0.0, ""}, Row{"12.5 g", false, 12.5, "g"},
               Row{"0.125kg", false, 0.125, "kg"}, Row{"123456,-8388", true, -8388, ""},
               Row{"1000,12.5,g,23.1,", true, 12.5, "g"});
  INFO(row.line);
  const auto line = parse_hx711_line(row.line, row.has_clock);
  REQUIRE(line);
  REQUIRE(line->value);
  CHECK(*line->value == row.value);
  CHECK(line->unit == row.unit);
  CHECK(line->ticks.has_value() == row.has_clock);
}

TEST_CASE("lines without a reading are refused", "[rig]") {
  const std::string line = GENERATE("", "HX711 Demo", "Initializing the scale", "x", "12 parrots",
                                    "1.2.3", "8388\x01", "Before setting up the scale:");
  INFO(line);
  CHECK_FALSE(parse_hx711_line(line, false));
}

TEST_CASE("with a clock a line needs both numbers", "[rig]") {
  for (const char* bad : {"8388", "-1,5", "1.5,5", "99999999999,5", "12,x", "12,", ",5"}) {
    INFO(bad);
    CHECK_FALSE(parse_hx711_line(bad, true));
  }
}

TEST_CASE("a reading such as nan or ovf has no value", "[rig]") {
  const std::string word = GENERATE("nan", "inf", "-inf", "ovf", "OVF");
  const auto line = parse_hx711_line(word, false);
  REQUIRE(line);
  CHECK_FALSE(line->value);
}

TEST_CASE("codes of an interrupted conversion count only if the reading jumps", "[rig]") {
  CHECK(is_hx711_glitch(-1.0, 50000.0));
  CHECK(is_hx711_glitch(1048575.0, 50000.0));
  CHECK_FALSE(is_hx711_glitch(1048575.0, 1048570.0));  // no jump from the previous reading
  CHECK_FALSE(is_hx711_glitch(1048574.0, 50000.0));
  CHECK_FALSE(is_hx711_glitch(8388607.0, 50000.0));  // saturated, not glitched
  CHECK_FALSE(is_hx711_glitch(-1.0, std::nullopt));
  CHECK(is_hx711_saturated(8388607.0));
  CHECK(is_hx711_saturated(-8388608.0));
  CHECK_FALSE(is_hx711_saturated(8388606.0));
}

TEST_CASE("a missing converter is a fault, but a banner is not", "[rig]") {
  CHECK(is_hx711_fault("HX711 not found."));
  CHECK_FALSE(is_hx711_fault("HX711 ready"));
}

}  // namespace viscard
