#pragma once

#include <limits>
#include <string>

namespace viscard {

// A requirement that is not given.
inline constexpr double kNotRequired = std::numeric_limits<double>::quiet_NaN();

// What a sensor must do: the table [require] of a file (README.md lists the keys). Numbers that are not
// given are kNotRequired and not judged.
struct Requirements {
  std::string name;  // of the whole list

  // Conditions under which the limits below hold.
  double tactel_area_m2 = kNotRequired;  // face of one tactel
  std::string top = "free";              // of a pressed pillar: "free" or "plate" (kept level)
  double bandwidth_error = 0.05;       // relative rise of the response at the end of the bandwidth
  double linear_to_Pa = kNotRequired;  // mean pressure up to which `nonlinearity` holds
  double texture_wavelength_m = kNotRequired;  // of the texture that slides over the sensor
  double texture_speed_m_s = kNotRequired;

  // Limits on computed quantities, one for each row of requirement_kinds().
  double pillars_per_tactel = kNotRequired;         // at least
  double resolved_wavelength_m = kNotRequired;      // at most
  double largest_pressure_Pa = kNotRequired;        // at least
  double largest_force_N = kNotRequired;            // at least
  double bandwidth_Hz = kNotRequired;               // at least
  double lowest_frequency_Hz = kNotRequired;        // at most
  double hysteresis = kNotRequired;                 // at most, 1
  double nonlinearity = kNotRequired;               // at most, 1
  double pressure_resolution_Pa = kNotRequired;     // at most
  double force_resolution_N = kNotRequired;         // at most
  double crosstalk = kNotRequired;                  // at most, 1
  double crosstalk_all = kNotRequired;              // at most, 1
  double pressure_per_kelvin_Pa_K = kNotRequired;   // at most
  double voltage_per_pressure_V_Pa = kNotRequired;  // at least
  double collapse_margin = kNotRequired;            // at least, 1
  double slip_latency_s = kNotRequired;             // at most
  double texture_amplitude_m = kNotRequired;        // at most
};

// A quantity that a scene was asked for: its value with error, or the reason why there is none.
struct RequiredValue {
  bool is_answered = false;
  double value = 0.0;           // in the unit of the requirement
  double error_estimate = 0.0;  // absolute
  std::string how;              // what was computed; unanswered: why not
};

}  // namespace viscard
