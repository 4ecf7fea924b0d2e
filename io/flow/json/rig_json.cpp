#include "io/flow/command_error.h"
#include "io/flow/json/flow_json.h"

#include <nlohmann/json.hpp>

namespace viscard {
namespace {

// The message also contains the final position of the punch, which the reason gives after the
// cause.
CommandError error_of_run(const RunOutcome& outcome) {
  const bool has_cause = !outcome.cause.empty() && outcome.reason.rfind(outcome.cause, 0) == 0;
  CommandError error = command_error(outcome.code.empty() ? "failed" : outcome.code,
                                     has_cause ? outcome.cause : outcome.reason, outcome.phase);
  if (has_cause) error.message += outcome.reason.substr(outcome.cause.size());
  return error;
}

}  // namespace

nlohmann::ordered_json json_from_rig_check(const RigCheck& found) {
  nlohmann::ordered_json json = {{"is_usable", found.is_usable},
                                 {"is_proven", found.is_proven},
                                 {"stage",
                                  {{"identity", found.stage_identity},
                                   {"steps_per_m", found.dynamics.steps_per_m},
                                   {"acceleration_m_s2", found.dynamics.acceleration_m_s2},
                                   {"min_speed_m_s", found.dynamics.min_speed_m_s},
                                   {"max_speed_m_s", found.dynamics.max_speed_m_s},
                                   {"position_m", found.position_m},
                                   {"latency_mean_s", found.latency.mean_s},
                                   {"latency_longest_s", found.latency.longest_s},
                                   {"reports", found.latency.n},
                                   {"reports_lost", found.latency.n_lost}}},
                                 {"load_cell",
                                  {{"rate_Hz", found.rate_Hz},
                                   {"jitter_s", found.jitter_s},
                                   {"falls_behind", found.falls_behind},
                                   {"line_bytes", found.line_bytes},
                                   {"missing", found.stream.missing},
                                   {"unreadable", found.stream.unreadable},
                                   {"reads_as", found.reads_as},
                                   {"force_N", found.force_N},
                                   {"noise_N", found.noise_N}}},
                                 {"advice", found.advice}};
  if (found.has_thermometer) {
    json["thermometer"] = {
        {"temperature_C", found.temperature_C ? nlohmann::ordered_json(*found.temperature_C)
                                              : nlohmann::ordered_json(nullptr)},
        {"readings", found.n_temperatures},
        {"trouble", found.thermometer_trouble}};
  }
  if (!found.is_usable) {
    const std::string why =
        found.advice.empty() ? "the rig is not fit for a test" : found.advice.back();
    json["error"] = json_from_error(command_error("unfit", why));
  }
  return json;
}

nlohmann::ordered_json json_from_outcome(const RunOutcome& outcome, const std::string& file) {
  const StreamCounts& stream = outcome.stream;
  nlohmann::ordered_json json;
  json["file"] = file;
  json["status"] = outcome.status;
  json["reason"] = outcome.reason;
  if (outcome.status != "finished") json["error"] = json_from_error(error_of_run(outcome));
  json["peak_force_N"] = outcome.peak_force_N;
  json["expected_peak_force_N"] = outcome.expected.peak_force_N;
  json["limit_N"] = outcome.expected.limit_N;
  json["depth_m"] = outcome.achieved_depth_m;
  json["contact_position_m"] = outcome.contact_position_m
                                   ? nlohmann::ordered_json(*outcome.contact_position_m)
                                   : nlohmann::ordered_json(nullptr);
  json["noise_N"] = outcome.noise_N;
  json["hidden_error_N"] = outcome.hidden_error_N;
  json["is_doubtful"] = !outcome.doubts.empty();
  json["doubts"] = outcome.doubts;
  json["line_format"] = outcome.line_format;
  if (outcome.temperature) {
    json["temperature"] = {{"mean_C", outcome.temperature->mean_C},
                           {"min_C", outcome.temperature->min_C},
                           {"max_C", outcome.temperature->max_C},
                           {"n_readings", outcome.temperature->n_readings}};
  }
  if (!outcome.thermometer_trouble.empty()) {
    json["thermometer_trouble"] = outcome.thermometer_trouble;
  }
  json["computer_late"] = {{"times", outcome.n_late}, {"longest_s", outcome.longest_late_s}};
  json["readings"] = {{"expected", stream.expected()},
                      {"received", stream.received},
                      {"missing", stream.missing},
                      {"duplicate", stream.duplicate},
                      {"glitch", stream.glitch},
                      {"saturated", stream.saturated},
                      {"unreadable", stream.unreadable},
                      {"implausible", stream.implausible},
                      {"longest_gap_s", stream.longest_gap_s},
                      {"longest_gap_at_s", stream.longest_gap_at_s}};
  return json;
}

}  // namespace viscard
