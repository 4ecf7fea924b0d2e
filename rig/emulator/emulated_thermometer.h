#pragma once

#include "models/experiment/rig_config.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace viscard {

// Behaviour of an emulated thermometer; times on the emulated clock.
struct ThermometerHabits {
  double temperature_C = 23.4;
  double drift_K_s = 0.0;
  double period_s = 1.0;        // between lines of one that sends by itself
  std::string before = "T=";    // of a line, such as "T=", "temp: " or nothing
  std::string behind;           // of a line, such as " C"
  double silent_from_s = -1.0;  // sends nothing from then on, until ...
  double silent_until_s = 1e300;
  int garble_every = 0;  // a digit of every n-th temperature is wrong; 0: none
  int fail_every = 0;    // every n-th temperature is -127, as of a sensor that is not connected
};

// A thermometer that sends lines, or answers MEAS:TEMP? and READ?. With the driver "load-cell" its
// lines go to the port of the load cell.
class EmulatedThermometer {
 public:
  EmulatedThermometer(const ThermometerConfig& config, const ThermometerHabits& habits)
      : config_(config), habits_(habits) {}

  // Takes what the host sent and returns the bytes that are due at now_s.
  std::string serve(std::string_view received, double now_s);

 private:
  std::string line(double time_s);

  ThermometerConfig config_;
  ThermometerHabits habits_;
  std::string begun_;
  double next_s_ = 0.1;
  std::int64_t n_lines_ = 0;
};

}  // namespace viscard
