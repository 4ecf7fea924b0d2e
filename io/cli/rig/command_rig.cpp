#include "io/cli/rig/overshoot_study.h"
#include "io/cli/rig/rig_commands.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/progress.h"
#include "io/config/config_file.h"
#include "io/flow/check_rig_config.h"
#include "io/flow/json/flow_json.h"
#include "models/maths/text_of_number.h"
#include "rig/emulator/demo_rig.h"
#include "rig/lines/port_probe.h"
#include "rig/lines/transport.h"
#include "rig/open_devices.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <optional>
#include <ostream>
#include <utility>

namespace viscard {
namespace {

using nlohmann::ordered_json;

constexpr int kOneLine = -1;

ordered_json number_or_null(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

// The thermometer of a rig file is the one device that can be read without disturbing anything.
void list_thermometer(const RigConfig& rig, bool as_json, ordered_json& json, Streams& streams) {
  if (!has_own_port(rig.thermometer)) return;
  const RigClock clock;
  const auto thermometer = make_thermometer(rig, clock, [](const RunRecord&) {});
  while (thermometer->readings_C().empty() && thermometer->trouble().empty()) {
    if (thermometer->transport() != nullptr) {
      wait_readable({thermometer->transport()}, clock, 0.02);
    }
    thermometer->service();
  }
  json["thermometer"] = {{"port", rig.thermometer.port},
                         {"temperature_C", number_or_null(thermometer->newest_C())},
                         {"trouble", thermometer->trouble()}};
  if (as_json) return;
  streams.out << "thermometer " << rig.thermometer.port << "  "
              << (thermometer->newest_C() ? fmt::format("{:.2f} C", *thermometer->newest_C())
                                          : thermometer->trouble())
              << "\n";
}

int list_ports(const std::optional<RigConfig>& rig, const Words& inputs, bool as_json,
               Streams& streams) {
  ordered_json rows = ordered_json::array();
  for (const std::string& path : present_ports()) {
    const PortStatus status = port_status(path);
    rows.push_back({{"port", status.path}, {"device", status.device}, {"trouble", status.trouble}});
    if (as_json) continue;
    streams.out << status.path << (status.device == status.path ? "" : " (" + status.device + ")")
                << "  " << (status.trouble.empty() ? "free" : status.trouble) << "\n";
  }
  ordered_json json{{"ports", rows}};
  if (rig) list_thermometer(*rig, as_json, json, streams);
  if (as_json) {
    print_json({"viscard-rig-list/1", inputs}, std::move(json), streams, kOneLine);
  } else if (rows.empty()) {
    streams.out << "No serial port is present. Plug the stage and the load cell in and switch them "
                   "on; 'dmesg | tail' shows whether the system has recognised them.\n";
  }
  return kDone;
}

void print_text(const RigCheck& found, std::ostream& out) {
  out << fmt::format(
             "stage      {}, {:.0f} steps/mm, {:.0f} mm/s2, {:.3f} to {:.1f} mm/s, at {:.3f} mm\n",
             found.stage_identity, found.dynamics.steps_per_m * 1e-3,
             found.dynamics.acceleration_m_s2 * 1e3, found.dynamics.min_speed_m_s * 1e3,
             found.dynamics.max_speed_m_s * 1e3, found.position_m * 1e3)
      << fmt::format("           answers in {:.1f} ms (longest {:.1f}), {} of {} lost\n",
                     found.latency.mean_s * 1e3, found.latency.longest_s * 1e3,
                     found.latency.n_lost, found.latency.n + found.latency.n_lost)
      << fmt::format(
             "load cell  {:.2f} readings/s, up to {:.1f} ms late, {} missing, {} unreadable\n",
             found.rate_Hz, found.jitter_s * 1e3, found.stream.missing, found.stream.unreadable)
      << fmt::format("           reads {} N{}, noise {:.3f} mN per reading\n",
                     text_from_number(found.force_N, 4),
                     found.reads_as.empty() ? std::string() : " from " + found.reads_as,
                     found.noise_N * 1e3);
  if (found.temperature_C) {
    out << fmt::format("thermometer {:.2f} C, {} in this time\n", *found.temperature_C,
                       counted(found.n_temperatures, "reading"));
  } else if (found.has_thermometer) {
    out << "thermometer sends no temperature\n";
  }
  for (const std::string& text : found.advice) out << "advice     " << text << "\n";
  out << (found.is_usable ? "ready\n" : "not fit for a test yet\n");
}

int show_overshoot(bool as_json, Streams& streams) {
  Progress progress(streams, "overshoot");
  const std::vector<OvershootRow> rows =
      study_overshoot({}, [&](double fraction) { progress.show(fraction, ""); });
  progress.clear();
  FittedText fitting(streams);
  std::ostream& table = fitting;
  if (!as_json) {
    table << "force beyond a limit of 1 N (N), emulated GRBL, 8.8 N/mm, 80 readings/s\n"
             "steps/mm  mm/s2  mm/s  jog cancel  expected  ladder   reset\n";
  }
  ordered_json list = ordered_json::array();
  for (const OvershootRow& row : rows) {
    list.push_back({{"steps_per_m", row.steps_per_m},
                    {"acceleration_m_s2", row.acceleration_m_s2},
                    {"speed_m_s", row.speed_m_s},
                    {"jog_cancel_N", row.gentle_N},
                    {"jog_cancel_expected_N", row.expected_N},
                    {"ladder_N", row.ladder_N},
                    {"reset_N", row.reset_N}});
    if (as_json) continue;
    table << fmt::format("{:8.0f} {:6.0f} {:5.1f} {:11.3f} {:9.3f} {:7.3f} {:7.3f}\n",
                         row.steps_per_m * 1e-3, row.acceleration_m_s2 * 1e3, row.speed_m_s * 1e3,
                         row.gentle_N, row.expected_N, row.ladder_N, row.reset_N);
  }
  if (as_json) {
    print_json<ordered_json>({"viscard-rig-overshoot/1", {}}, {{"limit_N", 1.0}, {"rows", list}},
                             streams, kOneLine);
  }
  return kDone;
}

// The options of `viscard rig`.
struct RigWords {
  std::string what;
  std::optional<std::string> rig_file;
  double seconds = 3.0;
  bool is_emulated = false;
  Plausible plausible = Plausible::kMeasured;
};

CommandSyntax rig_syntax(RigWords& words) {
  CommandSyntax syntax;
  syntax.usage = "viscard rig list [--rig FILE] | check --rig FILE | overshoot [OPTIONS]";
  syntax.description =
      "list shows the serial ports and why one cannot be used, without opening any but the "
      "thermometer's of a rig file. check opens all devices of a rig file, identifies and measures "
      "them, and reports what to change; nothing moves. overshoot shows how far the force goes "
      "beyond a limit, on the emulated rig.";
  syntax.example = "viscard rig check --emulate";
  syntax.positional.add("what", &words.what, "what to do").among({"list", "check", "overshoot"});
  syntax.options.add("rig", &words.rig_file, "rig.toml: ports, calibration");
  syntax.options.add("seconds", &words.seconds, "how long to listen");
  syntax.options.add("emulate", &words.is_emulated, "check an emulated rig");
  return syntax;
}

int check_and_print(const RigWords& words, bool as_json, Streams& streams) {
  if (!words.is_emulated && !words.rig_file) {
    throw UsageError("rig check needs --rig FILE (or --emulate to see what it prints)");
  }
  if (!(words.seconds >= 1.0) || words.seconds > 3600.0) {
    throw UsageError(fmt::format("--seconds {} is outside 1 to 3600", words.seconds));
  }
  const RigConfig rig = words.rig_file ? read_rig(*words.rig_file, words.plausible) : demo_rig();
  RigCheck found = check_rig_config(rig, words.is_emulated, words.seconds);
  if (words.rig_file) add_calibration(rig, found);
  if (as_json) {
    const Words inputs = words.rig_file ? Words{*words.rig_file} : Words{};
    print_json({"viscard-rig-check/1", inputs}, json_from_rig_check(found), streams, kOneLine);
  } else {
    print_text(found, FittedText(streams));
  }
  return found.is_usable ? kDone : kFailed;
}

}  // namespace

int run_rig(const Words& words, Streams& streams) {
  RigWords asked;
  CommandSyntax syntax = rig_syntax(asked);
  if (!parse_words(syntax, words, streams)) return kDone;
  asked.plausible = given_plausible(syntax);
  for (const char* option : {"rig", "seconds", "emulate"}) {
    const bool belongs =
        asked.what == "check" || (asked.what == "list" && option == std::string("rig"));
    if (belongs || !is_given(syntax, option)) continue;
    throw UsageError(std::string("--") + option + " belongs to 'viscard rig check'");
  }
  if (asked.what == "list") {
    std::optional<RigConfig> rig;
    if (asked.rig_file) rig = read_rig(*asked.rig_file, asked.plausible);
    return list_ports(rig, given_words(syntax, {"rig"}), syntax.as_json, streams);
  }
  if (asked.what == "overshoot") return show_overshoot(syntax.as_json, streams);
  return check_and_print(asked, syntax.as_json, streams);
}

}  // namespace viscard
