#include "rig/emulator/emulated_gauge.h"

#include "models/maths/text_of_number.h"
#include "rig/protocols/gauge_protocols.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>
#include <vector>

namespace viscard {

struct EmulatedGauge::Instrument {
  const char* driver;
  std::vector<std::string_view> queries;  // each asks for one reading
  bool has_line_ends;                     // false: every byte is a command
  const char* refusal;                    // answer to an unknown command; empty: none
  std::string (*reading)(const Shown& shown);
};

namespace {

std::string formatted(const char* format, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

}  // namespace

// One row per polled instrument (rig/cells/gauge_load_cell.cpp).
const EmulatedGauge::Instrument& EmulatedGauge::instrument_of(const std::string& driver) {
  static const std::vector<Instrument> kInstruments{
      {"scpi",
       {"READ?", "VAL1?", "MEAS1?"},
       true,
       "",
       [](const Shown& shown) {
         return formatted("%+.8E\r\n", shown.is_overload ? 9.9e37 : shown.volts);
       }},
      {"mark10",
       {"?"},
       true,
       "*10\r\n",
       [](const Shown& shown) {
         return text_from_number(shown.force, 4) + (shown.unit.empty() ? "" : " " + shown.unit) +
                "\r\n";
       }},
      {"sauter", {"9"}, false, "", [](const Shown& shown) {
         return (shown.force >= 0.0 ? "0" : "1") +
                formatted("%06.3f", std::min(std::abs(shown.force), 99.999));
       }}};
  for (const Instrument& row : kInstruments) {
    if (driver == row.driver) return row;
  }
  return kInstruments[0];  // an HX711: nothing is polled
}

EmulatedGauge::EmulatedGauge(const EmulatedTruth& truth, const LoadCellCalibration& calibration,
                             const std::string& driver, const GaugeHabits& habits)
    : rate_Hz_(truth.sample_rate_Hz),
      cell_(truth, calibration),
      instrument_(instrument_of(driver)),
      habits_(habits) {}

void EmulatedGauge::receive(std::string_view bytes, double time_s) {
  if (habits_.echoes) answers_.add(time_s, std::string(bytes));
  for (const char c : bytes) {
    if (!instrument_.has_line_ends) {
      take_command(std::string(1, c), time_s);
    } else if (c == '\r' || c == '\n') {
      take_command(std::exchange(begun_, ""), time_s);
    } else if (c != '\x03') {
      begun_ += c;
    }
  }
}

void EmulatedGauge::take_command(const std::string& command, double time_s) {
  const auto& queries = instrument_.queries;
  if (std::find(queries.begin(), queries.end(), command) != queries.end()) {
    due_s_.push_back(time_s + 1.0 / rate_Hz_);
  } else if (command == "*IDN?") {
    answers_.add(time_s, "HEWLETT-PACKARD,34401A,0,10-5-2\r\n");
  } else if (command == "SYST:ERR?") {
    answers_.add(time_s,
                 habits_.refuses_setup ? "-113,\"Undefined header\"\r\n" : "+0,\"No error\"\r\n");
  } else if (!command.empty() && *instrument_.refusal != '\0') {
    answers_.add(time_s, instrument_.refusal);
  }
}

double EmulatedGauge::next_sample_s() const {
  return due_s_.empty() ? std::numeric_limits<double>::infinity() : due_s_.front();
}

void EmulatedGauge::convert(double force_N, bool is_cell_broken) {
  const double time_s = due_s_.front();
  due_s_.pop_front();
  const std::int64_t index = n_readings_++;
  const auto is_nth = [&](int every) { return every > 0 && n_readings_ % every == 0; };
  if (is_nth(habits_.lose_answer_every)) return;
  const double late_s = is_nth(habits_.late_answer_every) ? habits_.late_s : 0.0;
  answers_.add(time_s + late_s, text_of(cell_.signal(force_N, time_s, index), is_cell_broken));
}

// The gain of a multimeter's rig is V/N, that of a force gauge newtons shown per newton.
std::string EmulatedGauge::text_of(double shown, bool is_overload) const {
  const bool is_changed =
      habits_.changes_unit_after > 0 && n_readings_ > habits_.changes_unit_after;
  const std::string unit = is_changed ? "lbF" : habits_.unit;
  return instrument_.reading({.volts = shown,
                              .force = shown / newtons_per_unit(unit).value_or(1.0),
                              .unit = habits_.hides_unit ? "" : unit,
                              .is_overload = is_overload});
}

}  // namespace viscard
