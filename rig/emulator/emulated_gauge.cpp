#include "rig/emulator/emulated_gauge.h"

#include "models/maths/text_of_number.h"
#include "rig/protocols/force_unit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

namespace viscard {

EmulatedGauge::EmulatedGauge(const EmulatedTruth& truth, const LoadCellCalibration& calibration,
                             std::string driver, const GaugeHabits& habits)
    : truth_(truth),
      cell_(truth),
      calibration_(calibration),
      driver_(std::move(driver)),
      habits_(habits) {
  if (truth.cell_gain > 0.0) calibration_.volts_per_newton = truth.cell_gain;
}

void EmulatedGauge::receive(std::string_view bytes, double time_s) {
  if (habits_.echoes) answers_.push_back({time_s, std::string(bytes)});
  for (const char c : bytes) {
    if (driver_ == "sauter") {
      take_command(std::string(1, c), time_s);
    } else if (c == '\r' || c == '\n') {
      take_command(std::exchange(begun_, ""), time_s);
    } else if (c != '\x03') {
      begun_ += c;
    }
  }
}

void EmulatedGauge::take_command(const std::string& command, double time_s) {
  const bool is_question = command == "READ?" || command == "?" || command == "9" ||
                           command == "VAL1?" || command == "MEAS1?";
  if (is_question) {
    due_s_.push_back(time_s + 1.0 / truth_.sample_rate_Hz);
  } else if (command == "*IDN?") {
    answers_.push_back({time_s, "HEWLETT-PACKARD,34401A,0,10-5-2\r\n"});
  } else if (command == "SYST:ERR?") {
    answers_.push_back(
        {time_s, habits_.refuses_setup ? "-113,\"Undefined header\"\r\n" : "+0,\"No error\"\r\n"});
  } else if (driver_ == "mark10" && !command.empty()) {
    answers_.push_back({time_s, "*10\r\n"});
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
  const double reading_N = cell_.signal_N(force_N, time_s, static_cast<std::uint64_t>(index));
  const double late_s = is_nth(habits_.late_answer_every) ? habits_.late_s : 0.0;
  answers_.push_back({time_s + late_s, text_of(reading_N, is_cell_broken)});
}

std::string EmulatedGauge::text_of(double reading_N, bool is_overload) const {
  std::array<char, 64> text{};
  if (driver_ == "scpi") {
    const double volts = is_overload ? 9.9e37 : volts_from_force_N(calibration_, reading_N);
    std::snprintf(text.data(), text.size(), "%+.8E\r\n", volts);
    return text.data();
  }
  const bool is_changed =
      habits_.changes_unit_after > 0 && n_readings_ > habits_.changes_unit_after;
  const std::string unit = is_changed ? "lbF" : habits_.unit;
  // The gain of a force gauge is the newtons shown per newton.
  const double shown_N = volts_from_force_N(calibration_, reading_N);
  const double value = shown_N / newtons_per_unit(unit).value_or(1.0);
  if (driver_ == "sauter") {
    std::snprintf(text.data(), text.size(), "%c%06.3f", value >= 0.0 ? '0' : '1',
                  std::min(std::abs(value), 99.999));
    return text.data();
  }
  return text_from_number(value, 4) + (habits_.hides_unit ? "" : " " + unit) + "\r\n";
}

std::string EmulatedGauge::take_output(double time_s) {
  std::string output;
  while (!answers_.empty() && answers_.front().due_s <= time_s) {
    output += answers_.front().text;
    answers_.pop_front();
  }
  return output;
}

}  // namespace viscard
