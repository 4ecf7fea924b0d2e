#pragma once

#include "models/experiment/run_record.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

class ResultVisitor;

// The temperature of a run by its thermometer: arithmetic mean and extremes of all readings.
struct RunTemperature {
  double mean_C = 0.0;
  double min_C = 0.0;
  double max_C = 0.0;
  std::size_t n_readings = 0;
};

// Shows all keys of it to a visitor.
void show_keys(ResultVisitor& v, const RunTemperature& measured);

// Values that are not finite are left out; nothing without a value.
std::optional<RunTemperature> run_temperature(const std::vector<double>& readings_C);
std::optional<RunTemperature> run_temperature(const std::vector<TemperatureSample>& samples);

// What to report if the temperature spans more than the limit, or "".
std::string temperature_drift_text(const RunTemperature& temperature, double limit_K);

// Names of the events "doubt" and of the flags of a fit about a thermometer.
inline constexpr const char* kTemperatureDrift = "temperature_drift";
inline constexpr const char* kThermometerSilent = "thermometer_silent";

}  // namespace viscard
