#include "rig/emulator/emulated_gauge.h"

#include "models/maths/leading_number.h"
#include "models/maths/text_of_number.h"
#include "rig/protocols/gauge_protocols.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace viscard {

struct EmulatedGauge::Instrument {
  const char* driver;
  std::vector<std::string_view> queries;  // each asks for one reading
  bool has_line_ends;                     // false: every byte is a command
  bool streams;                           // it can send readings by itself
  const char* refusal;                    // answer to an unknown command; empty: none
  std::string (*reading)(const Shown& shown);
  const char* unit = "";      // of its readings; empty: that of the habits
  const char* identity = "";  // answer to a question for it
  const char* zero = "";      // the command for it; empty: none
  const char* zeroed = "";    // answer to it
};

namespace {

// "1.500" becomes "01.500": six characters, as these instruments send them.
std::string with_leading_zeros(const std::string& number) {
  return std::string(6 - std::min<std::size_t>(6, number.size()), '0') + number;
}

// Right-aligned, as balances send values.
std::string in_columns(const std::string& number, std::size_t width) {
  return std::string(width - std::min(width, number.size()), ' ') + number;
}

}  // namespace

// One row per instrument that takes commands (rig/cells/gauge_load_cell.cpp, mark10_stream.cpp).
const EmulatedGauge::Instrument& EmulatedGauge::instrument_of(const std::string& driver) {
  static const std::vector<Instrument> kInstruments{
      {"scpi",
       {"READ?", "VAL1?", "MEAS1?"},
       true,
       false,
       "",
       [](const Shown& shown) {
         return scpi_text(shown.is_overload ? 9.9e37 : shown.volts, 8) + "\r\n";
       }},
      {"mark10", {"?"}, true, false, "*10\r\n", mark10_text, "", "", "Z"},
      {"mark10-continuous", {"?"}, true, true, "*10\r\n", mark10_text},
      {"sauter",
       {"9"},
       false,
       false,
       "",
       [](const Shown& shown) {
         return (shown.force >= 0.0 ? "0" : "1") +
                with_leading_zeros(text_from_number(std::min(std::abs(shown.force), 99.999), 3));
       }},
      // Under a punch it is never at rest.
      {"mt-sics",
       {"SI"},
       true,
       false,
       "ES\r\n",
       [](const Shown& shown) {
         if (shown.is_overload) return std::string("S +\r\n");
         return "S D " + in_columns(text_from_number(shown.force, 3), 10) + " g\r\n";
       },
       "g",
       "I4 A \"1114350697\"\r\n",
       "ZI",
       "ZI D\r\n"},
      {"sartorius",
       {"\x1bP"},
       true,
       false,
       "",
       [](const Shown& shown) {
         if (shown.is_overload) return std::string("       H        \r\n");
         return (shown.force < 0.0 ? "-" : "+") +
                in_columns(text_from_number(std::abs(shown.force), 3), 9) + "    \r\n";
       },
       "g",
       "BCE623-1S\r\n",
       "\x1bV"}};
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
      habits_(habits) {
  if (habits.is_left_streaming) begin_stream(10.0, 0.0);
}

std::string EmulatedGauge::mark10_text(const Shown& shown) {
  return text_from_number(shown.force, 4) + (shown.unit.empty() ? "" : " " + shown.unit) + "\r\n";
}

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
  } else if (command == "I4" || command == "@" || command == "\x1bx1_") {
    answers_.add(time_s, instrument_.identity);
  } else if (!command.empty() && command == instrument_.zero && !habits_.has_no_zero) {
    is_zeroing_ = true;
    answers_.add(time_s, instrument_.zeroed);
  } else if (command == "SYST:ERR?") {
    answers_.add(time_s,
                 habits_.refuses_setup ? "-113,\"Undefined header\"\r\n" : "+0,\"No error\"\r\n");
  } else if (instrument_.streams && take_stream_command(command, time_s)) {
    return;
  } else if (!command.empty() && *instrument_.refusal != '\0') {
    answers_.add(time_s, instrument_.refusal);
  }
}

// False for a command that it does not know. A command that it accepts is not answered.
bool EmulatedGauge::take_stream_command(const std::string& command, double time_s) {
  if (command.rfind("AOUT", 0) == 0 && !habits_.has_no_stream) {
    const auto n = integer_from_text(command.substr(4));
    constexpr std::array<long long, 9> kKnown{0, 1, 2, 5, 10, 25, 50, 125, 250};
    if (!n || std::find(kKnown.begin(), kKnown.end(), *n) == kKnown.end()) {
      answers_.add(time_s, "*12\r\n");
    } else {
      begin_stream(*n == 1 ? 50.0 : static_cast<double>(*n), time_s);
    }
    return true;
  }
  if (command == "CUR") habits_.shows_peak = false;
  if (command == "FULL" || command == "NUM") habits_.hides_unit = command == "NUM";
  return command == "CUR" || command == "FULL" || command == "NUM" || command == "OPOL0";
}

void EmulatedGauge::begin_stream(double rate_Hz, double time_s) {
  stream_Hz_ = rate_Hz;
  stream_begun_s_ = time_s;
  n_streamed_ = 0;
}

double EmulatedGauge::next_of_stream_s() const {
  const double since_s = static_cast<double>(n_streamed_ + 1) / stream_Hz_;
  const bool is_over = habits_.stops_after_s > 0.0 && since_s > habits_.stops_after_s;
  if (stream_Hz_ == 0.0 || is_over) return std::numeric_limits<double>::infinity();
  return stream_begun_s_ + since_s;
}

double EmulatedGauge::next_sample_s() const {
  return std::min(next_of_stream_s(),
                  due_s_.empty() ? std::numeric_limits<double>::infinity() : due_s_.front());
}

void EmulatedGauge::set_fault(RigFaultKind kind) {
  cell_.set_fault(kind);
  double factor = 1.0;
  if (kind == RigFaultKind::kFastReadings) factor = 3.0;
  if (kind == RigFaultKind::kSlowReadings) factor = 10.0 / rate_Hz_;
  rate_Hz_ *= factor;
  if (stream_Hz_ > 0.0 && factor != 1.0) begin_stream(factor * stream_Hz_, next_of_stream_s());
}

void EmulatedGauge::convert(double force_N, bool is_cell_broken) {
  const double time_s = next_sample_s();
  if (time_s == next_of_stream_s()) {
    ++n_streamed_;
  } else {
    due_s_.pop_front();
  }
  const std::int64_t index = n_readings_++;
  const auto is_nth = [&](int every) { return every > 0 && n_readings_ % every == 0; };
  if (is_nth(habits_.lose_answer_every)) return;
  const double late_s = is_nth(habits_.late_answer_every) ? habits_.late_s : 0.0;
  const double signal = cell_.signal(force_N, time_s, index);
  if (std::exchange(is_zeroing_, false)) zero_ = signal;  // nothing has changed since the command
  const double shown = signal - zero_;
  peak_ = std::max(peak_, shown);
  answers_.add(time_s + late_s,
               text_of(habits_.shows_peak ? peak_ : shown, is_cell_broken || cell_.is_off_scale()));
}

// The gain of a multimeter's rig is V/N, that of a force gauge newtons shown per newton.
std::string EmulatedGauge::text_of(double shown, bool is_overload) const {
  const bool is_changed =
      habits_.changes_unit_after > 0 && n_readings_ > habits_.changes_unit_after;
  const std::string unit = is_changed               ? "lbF"
                           : *instrument_.unit != 0 ? instrument_.unit
                                                    : habits_.unit;
  return instrument_.reading({.volts = shown,
                              .force = shown / newtons_per_unit(unit).value_or(1.0),
                              .unit = habits_.hides_unit ? "" : unit,
                              .is_overload = is_overload});
}

}  // namespace viscard
