#include "io/capture/possible_values.h"

#include "io/basics/number_text.h"
#include "models/experiment/motion_profile.h"
#include "models/quantities/quantities.h"

#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>

namespace viscard {
namespace {

constexpr double kMostCounts = 4294967296.0;  // of a converter of 32 bits
constexpr double kLongestRun_s =
    1e10;  // 300 years; an emulated clock may run a thousand times faster

// The record that is looked at, for the message.
struct RecordPlace {
  std::string file;
  const char* kind;
  std::size_t number;
};

[[noreturn]] void refuse_value(const RecordPlace& at, const std::string& what) {
  throw std::runtime_error(at.file + ": " + at.kind + " " + std::to_string(at.number) + " " + what +
                           ", which no instrument gives: the file is damaged or was altered. Use "
                           "another copy of it");
}

void check_value(const RecordPlace& at, const char* name, double value, double lowest,
                 double highest) {
  if (value >= lowest && value <= highest) return;  // false for NaN
  refuse_value(at, "has a " + std::string(name) + " of " + text_from_number(value));
}

void check_value(const RecordPlace& at, const char* name, const std::optional<double>& value,
                 double most) {
  if (value) check_value(at, name, *value, -most, most);
}

void check_time_of(const RecordPlace& at, double time_s) {
  check_value(at, "time in s", time_s, -kLongestRun_s, kLongestRun_s);
}

}  // namespace

void refuse_impossible_values(const CapturedRun& run, const std::string& file) {
  using namespace quantities;
  RecordPlace at{file, "reading", 0};
  for (const LoadSample& sample : run.load_samples) {
    ++at.number;
    check_time_of(at, sample.host_time_s);
    check_value(at, "device time in s", sample.device_time_s, kLongestRun_s);
    check_value(at, "number of counts", sample.counts, kMostCounts);
    check_value(at, "voltage in V", sample.volts, kVoltage.scene.highest);
    check_value(at, "force in N", sample.force_N, kForce.scene.highest);
  }
  at = {file, "report of the stage", 0};
  for (const StageReport& report : run.stage_reports) {
    ++at.number;
    check_time_of(at, report.host_time_s);
    check_value(at, "position in m", report.position_m, kLength.scene.highest);
  }
  at = {file, "move", 0};
  for (const CommandedMove& commanded : run.moves) {
    ++at.number;
    const StageMove& move = commanded.move;
    check_time_of(at, move.start_time_s);
    check_value(at, "start in m", move.from_m, kLength.scene.highest);
    check_value(at, "end in m", move.to_m, kLength.scene.highest);
    check_value(at, "speed in m/s", move.speed_m_s, kSpeed.scene.lowest, kSpeed.scene.highest);
    check_value(at, "acceleration in m/s2", move.acceleration_m_s2, 1e-12,
                kAcceleration.scene.highest);
    check_value(at, "uncertainty of its start in s", commanded.start_uncertainty_s, 0.0,
                kLongestRun_s);
  }
  at = {file, "temperature", 0};
  for (const TemperatureSample& sample : run.temperatures) {
    ++at.number;
    check_time_of(at, sample.host_time_s);
    check_value(at, "value in degC", sample.temperature_C, kTemperature.scene.lowest,
                kTemperature.scene.highest);
  }
  at = {file, "event", 0};
  for (const RunEvent& event : run.events) {
    ++at.number;
    check_time_of(at, event.host_time_s);
  }
}

}  // namespace viscard
