#include "io/basics/timestamp.h"
#include "io/cli/rig/overshoot_study.h"
#include "io/cli/rig/rig_commands.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/progress.h"
#include "io/cli/words/stop_on_signal.h"
#include "io/config/config_file.h"
#include "io/flow/check_rig_config.h"
#include "io/flow/json/flow_json.h"
#include "io/flow/touch_rig.h"
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

namespace po = boost::program_options;

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

CommandSyntax rig_syntax() {
  CommandSyntax syntax;
  syntax.usage =
      "viscard rig list [--rig FILE] | check --rig FILE | touch --rig FILE | overshoot [OPTIONS]";
  syntax.description =
      "list shows the serial ports and why one cannot be used, without opening any but the "
      "thermometer's of\n"
      "a rig file. check opens all devices of a rig file, identifies and measures them, and "
      "reports "
      "what to change;\n"
      "nothing moves. touch waits for a finger or a weight on a load cell whose readings show no "
      "noise, and\nwrites the day into the rig file. overshoot shows how far the force goes beyond "
      "a limit, on the emulated rig.";
  syntax.example = "viscard rig check --emulate";
  syntax.options.add_options()("rig", po::value<std::string>(), "rig.toml: ports, calibration")(
      "seconds", po::value<double>()->default_value(3.0), "how long to listen (touch: 30)")(
      "emulate", "check an emulated rig");
  syntax.positional = {"what"};
  syntax.choices["what"] = {"list", "check", "touch", "overshoot"};
  return syntax;
}

double listening_seconds(const po::variables_map& values) {
  const double seconds = values["seconds"].as<double>();
  if (seconds >= 1.0 && seconds <= 3600.0) return seconds;
  throw UsageError(fmt::format("--seconds {} is outside 1 to 3600", seconds));
}

int check_and_print(const po::variables_map& values, bool as_json, Streams& streams) {
  const bool is_emulated = values.count("emulate") > 0;
  if (!is_emulated && values.count("rig") == 0) {
    throw UsageError("rig check needs --rig FILE (or --emulate to see what it prints)");
  }
  const double seconds = listening_seconds(values);
  const RigConfig rig =
      values.count("rig") > 0 ? read_rig(values["rig"].as<std::string>()) : demo_rig();
  RigCheck found = check_rig_config(rig, is_emulated, seconds);
  if (values.count("rig") > 0) add_calibration(rig, found);
  if (as_json) {
    print_json({"viscard-rig-check/1", given_words(values, {"rig"})}, json_from_rig_check(found),
               streams, kOneLine);
  } else {
    print_text(found, FittedText(streams));
  }
  return found.is_usable ? kDone : kFailed;
}

int touch_and_write(const po::variables_map& values, bool as_json, Streams& streams) {
  const bool is_emulated = values.count("emulate") > 0;
  if (!is_emulated && values.count("rig") == 0) {
    throw UsageError("rig touch needs --rig FILE, whose load cell is touched");
  }
  constexpr double kWait_s = 30.0;
  const double wait_s = values["seconds"].defaulted() ? kWait_s : listening_seconds(values);
  const std::optional<std::string> file = given(values, "rig");
  const StopOnSignal on_signal;
  const double force_N = touch_rig(
      file ? read_rig(*file) : demo_rig(), is_emulated, wait_s,
      [&] {
        streams.err << "Put a finger or a weight on the load cell now, within " << wait_s << " s\n";
      },
      &StopOnSignal::is_asked());
  if (file && !is_emulated) write_answer(*file, today());
  if (as_json) {
    print_json<ordered_json>({"viscard-rig-touch/1", given_words(values, {"rig"})},
                             {{"force_N", force_N}, {"answered_on", today()}}, streams, kOneLine);
  } else {
    streams.out << fmt::format("the load cell answered with {:.4f} N", force_N)
                << (file && !is_emulated ? "; answered_on = " + today() + " is written to " + *file
                                         : "")
                << "\n";
  }
  return kDone;
}

}  // namespace

int run_rig(const Words& words, Streams& streams) {
  CommandSyntax syntax = rig_syntax();
  const auto values = parse_words(syntax, words, streams);
  if (!values) return kDone;
  const std::string what = values->count("what") > 0 ? (*values)["what"].as<std::string>() : "";
  const bool as_json = values->count("json") > 0;
  for (const std::string option : {"rig", "seconds", "emulate"}) {
    if (what == "check" || what == "touch" || (what == "list" && option == "rig") ||
        values->count(option) == 0 || (*values)[option].defaulted())
      continue;
    throw UsageError("--" + option + " belongs to 'viscard rig check'");
  }
  if (what == "list") {
    std::optional<RigConfig> rig;
    if (values->count("rig") > 0) rig = read_rig((*values)["rig"].as<std::string>());
    return list_ports(rig, given_words(*values, {"rig"}), as_json, streams);
  }
  if (what == "overshoot") return show_overshoot(as_json, streams);
  if (what == "touch") return touch_and_write(*values, as_json, streams);
  if (what != "check") {
    throw UsageError("rig needs one of list, check, touch or overshoot. usage: " +
                     std::string(syntax.usage));
  }
  return check_and_print(*values, as_json, streams);
}

}  // namespace viscard
