#include "rig/emulator/emulated_thermometer.h"

#include "models/maths/leading_number.h"
#include "models/maths/text_of_number.h"

#include <utility>

namespace viscard {

std::string EmulatedThermometer::serve(std::string_view received, double now_s) {
  std::string out;
  if (config_.driver == "scpi") {
    for (const char c : received) {
      if (c != '\n' && c != '\r') {
        begun_ += c;
        continue;
      }
      const std::string command = std::exchange(begun_, "");
      if (command == "MEAS:TEMP?" || command == "READ?") out += line(now_s);
    }
    return out;
  }
  while (next_s_ <= now_s) {
    out += line(next_s_);
    next_s_ += habits_.period_s;
  }
  return out;
}

std::string EmulatedThermometer::line(double time_s) {
  if (time_s >= habits_.silent_from_s && time_s < habits_.silent_until_s &&
      habits_.silent_from_s >= 0.0) {
    return "";
  }
  ++n_lines_;
  const auto is_nth = [&](int every) { return every > 0 && n_lines_ % every == 0; };
  double temperature_C = habits_.temperature_C + habits_.drift_K_s * time_s;
  if (is_nth(habits_.garble_every)) temperature_C += 40.0;
  if (is_nth(habits_.fail_every)) temperature_C = -127.0;
  if (config_.driver == "scpi") return scpi_text(temperature_C, 8) + "\r\n";
  return habits_.before + text_from_number(temperature_C, 2) + habits_.behind + "\r\n";
}

}  // namespace viscard
