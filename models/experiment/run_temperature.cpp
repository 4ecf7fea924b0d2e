#include "models/experiment/run_temperature.h"

#include "models/maths/result_visitor.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>

namespace viscard {

void show_keys(ResultVisitor& v, const RunTemperature& measured) {
  v("mean_C", measured.mean_C, "mean");
  v("min_C", measured.min_C, "lowest");
  v("max_C", measured.max_C, "highest");
  v("n_readings", measured.n_readings, "number of readings");
}

std::optional<RunTemperature> run_temperature(const std::vector<double>& readings_C) {
  RunTemperature found{.min_C = 1e300, .max_C = -1e300};
  for (const double reading_C : readings_C) {
    if (!std::isfinite(reading_C)) continue;
    ++found.n_readings;
    found.mean_C += (reading_C - found.mean_C) / static_cast<double>(found.n_readings);
    found.min_C = std::min(found.min_C, reading_C);
    found.max_C = std::max(found.max_C, reading_C);
  }
  if (found.n_readings == 0) return std::nullopt;
  return found;
}

std::optional<RunTemperature> run_temperature(const std::vector<TemperatureSample>& samples) {
  std::vector<double> readings_C;
  readings_C.reserve(samples.size());
  for (const TemperatureSample& sample : samples) readings_C.push_back(sample.temperature_C);
  return run_temperature(readings_C);
}

std::string temperature_drift_text(const RunTemperature& temperature, double limit_K) {
  const double span_K = temperature.max_C - temperature.min_C;
  if (span_K <= limit_K) return "";
  return "the temperature went from " + text_from_number(temperature.min_C, 2) + " to " +
         text_from_number(temperature.max_C, 2) + " C during the run, by " +
         text_from_number(span_K, 2) + " K where drift_limit allows " +
         text_from_number(limit_K, 2) +
         " K: relaxation times depend on it. Wait until the room is steady, then repeat the run";
}

}  // namespace viscard
