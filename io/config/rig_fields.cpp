#include "io/config/config_show.h"

#include <cctype>
#include <stdexcept>

namespace viscard {
namespace {

using enum Range;

// The shape of 2026-11-28.
bool is_day(const std::string& text) {
  constexpr std::size_t kLength = 10;
  if (text.size() != kLength) return false;
  for (std::size_t i = 0; i < kLength; ++i) {
    const bool is_dash = i == 4 || i == 7;
    if (is_dash ? text[i] != '-' : std::isdigit(static_cast<unsigned char>(text[i])) == 0) {
      return false;
    }
  }
  return true;
}

void show_stage(FieldVisitor& fields, StageConfig& stage) {
  fields.text({"driver", "grbl"}, stage.driver);
  fields.text({"port", "/dev/serial/by-id/usb-..."}, stage.port);
  fields.integer("baud", 300, 4'000'000, stage.baud);
  std::string axis(1, stage.axis);
  fields.text({"axis", "Z"}, axis);
  if (axis.size() != 1) {
    throw std::runtime_error("stage.axis is '" + axis + "'; expected one letter, such as \"Z\"");
  }
  stage.axis = axis.front();
  fields.integer("toward_specimen", -1, 1, stage.toward_specimen);
  fields.quantity({"travel", quantities::kTravel, kPositive}, stage.travel_m);
  fields.quantity({"backlash", "m", kNotNegative}, stage.backlash_m);
  fields.quantity({"depth_relative_u", "1", kNotNegative}, stage.depth_relative_u);
  fields.quantity({"zero", "m"}, stage.zero_m);
  fields.boolean("home", stage.home);
  fields.quantity({"microstep", "m", kNotNegative}, stage.microstep_m);
  fields.integer("device", 1, 99, stage.device);
  fields.integer("axis_number", 1, 9, stage.axis_number);
}

void show_load_cell(FieldVisitor& fields, LoadCellConfig& cell) {
  fields.text({"driver", "hx711"}, cell.driver);
  fields.text({"port", "/dev/serial/by-id/usb-..."}, cell.port);
  fields.integer("baud", 300, 4'000'000, cell.baud);
  fields.text({"line_format", "auto"}, cell.line_format);
  fields.quantity({"expected_rate", quantities::kRate, kPositive}, cell.expected_rate_Hz);
  fields.quantity({"volts_per_count", "V"}, cell.volts_per_count);
  fields.text({"converter", "ads1232"}, cell.converter);
  fields.quantity({"gain", "1", kNotNegative}, cell.gain);
  fields.quantity({"reference", "V", kNotNegative}, cell.reference_V);
  fields.quantity({"span", "V", kNotNegative}, cell.span_V);
  fields.text({"frame", "a5 5a counts:i24 check:crc16"}, cell.frame);
  fields.boolean("compression_is_positive", cell.compression_is_positive);
  fields.text({"dialect", "34401a"}, cell.dialect);
  fields.text({"unit", "N"}, cell.unit);
  fields.text({"framing", "8N1"}, cell.framing);
  fields.text({"answered_on", "2026-11-28"}, cell.answered_on);
  if (!cell.answered_on.empty() && !is_day(cell.answered_on)) {
    throw std::runtime_error("load_cell.answered_on is '" + cell.answered_on +
                             "'; expected the day on which the cell answered a finger or a weight, "
                             "such as 2026-11-28 (viscard rig touch writes it)");
  }
}

void show_thermometer(FieldVisitor& fields, ThermometerConfig& thermometer) {
  fields.text({"driver", "text"}, thermometer.driver);
  fields.text({"port", "/dev/serial/by-id/usb-..."}, thermometer.port);
  fields.integer("baud", 300, 4'000'000, thermometer.baud);
  fields.text({"framing", "8N1"}, thermometer.framing);
  fields.text({"query", "MEAS:TEMP?"}, thermometer.query);
  fields.quantity({"period", quantities::kPeriod, kPositive}, thermometer.period_s);
  fields.text({"unit", "degC"}, thermometer.unit);
  fields.quantity({"drift_limit", quantities::kDriftOfTemperature, kPositive},
                  thermometer.drift_limit_K);
}

}  // namespace

void show_rig(FieldVisitor& fields, RigConfig& rig) {
  fields.text({"name", "bench 1"}, rig.name);
  fields.quantity({"clock_speed", "1", kPositive}, rig.clock_speed);
  fields.section("stage", [&](FieldVisitor& inner) { show_stage(inner, rig.stage); });
  fields.section("load_cell", [&](FieldVisitor& inner) { show_load_cell(inner, rig.load_cell); });
  fields.section("thermometer",
                 [&](FieldVisitor& inner) { show_thermometer(inner, rig.thermometer); });
  fields.section("calibration", [&](FieldVisitor& inner) {
    show_calibration(inner, rig.calibration, measures_force(rig.load_cell));
  });
  fields.section("frame", [&](FieldVisitor& inner) {
    inner.text({"file", "bench.frame.toml"}, rig.frame.file);
    // Required, because assuming a rigid frame can halve the modulus.
    inner.quantity({.key = "stiffness",
                    .unit = "N/m",
                    .range = kPositive,
                    .is_required = rig.frame.file.empty(),
                    .word = "rigid",
                    .word_value = 0.0},
                   rig.frame.stiffness_N_m);
    inner.quantity({"stiffness_relative_u", "1", kNotNegative}, rig.frame.stiffness_relative_u);
    inner.text({"id", "bench 2026-11"}, rig.frame.id);
    inner.text({"date", "2026-11-21"}, rig.frame.date);
  });
  fields.section("safety", [&](FieldVisitor& inner) {
    inner.quantity({"warn_fraction", "1", kFraction}, rig.safety.warn_fraction);
    inner.quantity({"soft_fraction", "1", kFraction}, rig.safety.soft_fraction);
    inner.quantity({"hard_fraction", "1", kFraction}, rig.safety.hard_fraction);
  });
}

}  // namespace viscard
