#include "io/basics/option_use.h"
#include "io/basics/timestamp.h"
#include "io/cli/rig/overshoot_study.h"
#include "io/cli/rig/rig_commands.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/progress.h"
#include "io/cli/words/stop_on_signal.h"
#include "io/config/config_file.h"
#include "io/flow/rig_actions.h"
#include "io/flow/rig_keys.h"
#include "models/maths/text_of_number.h"
#include "rig/emulator/demo_rig.h"
#include "rig/lines/port_probe.h"
#include "rig/lines/transport.h"
#include "rig/open_devices.h"
#include "rig/run/rest_findings.h"

#include <fmt/format.h>

#include <optional>
#include <ostream>
#include <vector>

namespace viscard {
namespace {

constexpr int kOneLine = -1;

// What `viscard rig list` finds.
struct ThermometerReading {
  std::string port;
  std::optional<double> temperature_C;
  std::string trouble;
};
struct RigList {
  std::vector<PortStatus> ports;
  std::optional<ThermometerReading> thermometer;
};

void show_keys(ResultVisitor& v, const RigList& found) {
  v.list("ports", "serial ports that are present", found.ports, [&](const PortStatus& one) {
    v("port", one.path, "its path");
    v("device", one.device, "what the path points to");
    v("trouble", one.trouble, "why it cannot be used; empty: it is free");
  });
  v.when(found.thermometer.has_value(), [&] {
    const ThermometerReading one = found.thermometer.value_or(ThermometerReading{});
    v.object("thermometer", "the thermometer of the rig file", [&] {
      v("port", one.port, "its path");
      v("temperature_C", number_or_null(one.temperature_C), "newest reading; null: none came");
      v("trouble", one.trouble, "why none came");
    });
  });
}

void show_keys(ResultVisitor& v, const std::vector<OvershootRow>& rows) {
  v("limit_N", 1.0, "the limit of force in the study");
  v.list("rows", "one for each stage and speed", rows, [&](const OvershootRow& row) {
    v("steps_per_m", row.steps_per_m, "of the stage");
    v("acceleration_m_s2", row.acceleration_m_s2, "of the stage");
    v("speed_m_s", row.speed_m_s, "of the approach");
    v("jog_cancel_N", row.gentle_N, "force beyond the limit if the jog is cancelled");
    v("jog_cancel_expected_N", row.expected_N, "the same, computed");
    v("ladder_N", row.ladder_N, "force beyond the limit with the ladder of stops");
    v("reset_N", row.reset_N, "force beyond the limit with a reset");
  });
}

// The thermometer of a rig file is the one device that can be read without disturbing anything.
ThermometerReading read_thermometer(const RigConfig& rig) {
  const RigClock clock;
  const auto thermometer = make_thermometer(rig, clock, [](const RunRecord&) {});
  while (thermometer->readings_C().empty() && thermometer->trouble().empty()) {
    if (thermometer->transport() != nullptr) {
      wait_readable({thermometer->transport()}, clock, 0.02);
    }
    thermometer->service();
  }
  return {rig.thermometer.port, thermometer->newest_C(), thermometer->trouble()};
}

void print_text(const RigList& found, std::ostream& out) {
  for (const PortStatus& status : found.ports) {
    out << status.path << (status.device == status.path ? "" : " (" + status.device + ")") << "  "
        << (status.trouble.empty() ? "free" : status.trouble) << "\n";
  }
  if (const auto& one = found.thermometer) {
    out << "thermometer " << one->port << "  "
        << (one->temperature_C ? fmt::format("{:.2f} C", *one->temperature_C) : one->trouble)
        << "\n";
  }
  if (found.ports.empty()) {
    out << "No serial port is present. Plug the stage and the load cell in and switch them "
           "on; 'dmesg | tail' shows whether the system has recognised them.\n";
  }
}

int list_ports(const std::optional<RigConfig>& rig, const Words& inputs, bool as_json,
               Streams& streams) {
  RigList found;
  for (const std::string& path : present_ports()) found.ports.push_back(port_status(path));
  if (rig && has_own_port(rig->thermometer)) found.thermometer = read_thermometer(*rig);
  if (as_json) {
    print_result(
        {"viscard-rig-list/1", inputs}, [&](ResultVisitor& v) { show_keys(v, found); }, streams,
        kOneLine);
  } else {
    print_text(found, streams.out);
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
  out << (!found.is_usable       ? "not fit for a test yet\n"
          : found.advice.empty() ? "ready\n"
                                 : "ready, with the advice above\n");
}

int show_overshoot(bool as_json, Streams& streams) {
  Progress progress(streams, "overshoot");
  const std::vector<OvershootRow> rows =
      study_overshoot({}, [&](double fraction) { progress.show(fraction, ""); });
  progress.clear();
  if (as_json) {
    print_result(
        {"viscard-rig-overshoot/1", {}}, [&](ResultVisitor& v) { show_keys(v, rows); }, streams,
        kOneLine);
    return kDone;
  }
  FittedText fitting(streams);
  std::ostream& table = fitting;
  table << "force beyond a limit of 1 N (N), emulated GRBL, 8.8 N/mm, 80 readings/s\n"
           "steps/mm  mm/s2  mm/s  jog cancel  expected  ladder   reset\n";
  for (const OvershootRow& row : rows) {
    table << fmt::format("{:8.0f} {:6.0f} {:5.1f} {:11.3f} {:9.3f} {:7.3f} {:7.3f}\n",
                         row.steps_per_m * 1e-3, row.acceleration_m_s2 * 1e3, row.speed_m_s * 1e3,
                         row.gentle_N, row.expected_N, row.ladder_N, row.reset_N);
  }
  return kDone;
}

// The options of `viscard rig`.
struct RigWords {
  std::string what;
  std::optional<std::string> rig_file;
  std::optional<double> seconds;
  bool is_emulated = false;
  std::optional<double> toward_m, away_m;
  double speed_m_s = 0.2e-3;
  double limit_N = 0.1;
  Plausible plausible = Plausible::kMeasured;
};

bool moves(const RigWords& words) {
  return words.what == "jog" || words.what == "home" || words.what == "lift";
}

bool zeroes(const RigWords& words) {
  return words.what == "set-zero" || words.what == "zero-force";
}

void show_zero(ResultVisitor& v, double position_m) {
  v("zero_m", position_m, "position of the controller that counts as 0 from now on");
}

void show_touch(ResultVisitor& v, double force_N) {
  v("force_N", force_N, "the largest change of the force");
  v("answered_on", today(), "the day");
}

CommandSyntax rig_syntax(RigWords& words) {
  CommandSyntax syntax;
  syntax.usage =
      "viscard rig list [--rig FILE] | check --rig FILE | touch --rig FILE | jog --rig FILE "
      "--away WAY | lift --rig FILE | home --rig FILE | set-zero --rig FILE | zero-force --rig "
      "FILE | overshoot [OPTIONS]";
  syntax.description =
      "list shows the serial ports and why one cannot be used, without opening any but the "
      "thermometer's of a rig file. check opens all devices of a rig file, identifies and measures "
      "them, and reports what to change; nothing moves. touch waits until a finger or a weight has "
      "pressed on the load cell and is away again, and writes the day into the rig file. jog moves "
      "the "
      "stage toward the specimen or away from it, lift moves it 2 mm away; they stop when the "
      "force has changed by --limit, away from the specimen only when it has risen by that or "
      "pulls with it. home runs the homing cycle of the controller, which only the "
      "force limits of the rig file stop. set-zero writes the position of the stage into the rig "
      "file, and jog, lift and home then also print positions counted from there; it refuses a "
      "controller that does not keep its own zero. zero-force makes the force at rest the zero of "
      "a balance or gauge that has one of its own. No test uses either: it finds the surface and "
      "measures the force out of contact itself. overshoot shows how far the force goes beyond a "
      "limit, on the emulated rig.";
  syntax.example = "viscard rig check --emulate";
  syntax.positional.add("what", &words.what, "what to do")
      .among(
          {"list", "check", "touch", "jog", "lift", "home", "set-zero", "zero-force", "overshoot"});
  syntax.options.add("rig", &words.rig_file, "rig.toml: ports, calibration");
  syntax.options.add("seconds", &words.seconds, "how long to listen (3; touch: 30)");
  syntax.options.add("emulate", &words.is_emulated, "use an emulated rig");
  syntax.options.add("toward", &words.toward_m, "jog: way toward the specimen, such as \"0.5 mm\"")
      .of("m");
  syntax.options.add("away", &words.away_m, "jog, lift: way from the specimen, such as \"1 mm\"")
      .of("m");
  syntax.options.add("speed", &words.speed_m_s, "jog, lift: speed")
      .of("m/s")
      .by_default("0.2 mm/s");
  syntax.options
      .add(
          "limit", &words.limit_N,
          "jog, lift: the stage stops when the force has changed by this; a falling force stops no "
          "lift")
      .of("N")
      .by_default("0.1 N");
  syntax.results = {
      described<RigList>("rig-list", "viscard rig list"),
      described<RigCheck>("rig-check", "viscard rig check"),
      {"rig-touch", "viscard rig touch", {[](ResultVisitor& v) { show_touch(v, 0.0); }}},
      {"rig-move", "viscard rig jog", {[](ResultVisitor& v) { show_keys(v, StageMoved{}); }}},
      {"rig-zero", "viscard rig set-zero", {[](ResultVisitor& v) { show_zero(v, 0.0); }}},
      described<ZeroedForce>("rig-zero-force", "viscard rig zero-force"),
      {"rig-overshoot", "viscard rig overshoot", {[](ResultVisitor& v) {
         show_keys(v, std::vector<OvershootRow>{});
       }}}};
  return syntax;
}

double listening_seconds(const RigWords& words, double otherwise_s) {
  const double seconds = words.seconds.value_or(otherwise_s);
  if (seconds >= 1.0 && seconds <= 3600.0) return seconds;
  throw UsageError(fmt::format("--seconds {} is outside 1 to 3600", seconds));
}

int check_and_print(const RigWords& words, bool as_json, Streams& streams) {
  if (!words.is_emulated && !words.rig_file) {
    throw UsageError("rig check needs --rig FILE (or --emulate to see what it prints)");
  }
  constexpr double kListen_s = 3.0;
  const double seconds = listening_seconds(words, kListen_s);
  const RigConfig rig = words.rig_file ? read_rig(*words.rig_file, words.plausible) : demo_rig();
  RigCheck found = check_rig_config(rig, words.is_emulated, seconds);
  if (words.rig_file) add_calibration(rig, found);
  if (as_json) {
    const Words inputs = words.rig_file ? Words{*words.rig_file} : Words{};
    print_result(
        {"viscard-rig-check/1", inputs}, [&](ResultVisitor& v) { show_keys(v, found); }, streams,
        kOneLine);
  } else {
    print_text(found, FittedText(streams));
  }
  return found.is_usable ? kDone : kFailed;
}

int touch_and_write(const RigWords& words, bool as_json, Streams& streams) {
  const std::optional<std::string>& file = words.rig_file;
  if (!words.is_emulated && !file) {
    throw UsageError("rig touch needs --rig FILE, whose load cell is touched");
  }
  constexpr double kWait_s = 30.0;
  const double wait_s = listening_seconds(words, kWait_s);
  const StopOnSignal on_signal;
  TouchOptions options;
  options.wait_s = wait_s;
  options.stop = &StopOnSignal::is_asked();
  options.ready = [&] {
    streams.err << "Put a finger or a weight on the load cell now, within " << wait_s << " s\n";
  };
  options.felt = [&] { streams.err << "Take it away again, within " << wait_s << " s\n"; };
  const double force_N =
      touch_rig(file ? read_rig(*file, words.plausible) : demo_rig(), words.is_emulated, options);
  if (file && !words.is_emulated) write_answer(*file, today());
  if (as_json) {
    print_result(
        {"viscard-rig-touch/1", file ? Words{*file} : Words{}},
        [&](ResultVisitor& v) { show_touch(v, force_N); }, streams, kOneLine);
  } else {
    streams.out << fmt::format("the load cell answered with {:.4f} N", force_N)
                << (file && !words.is_emulated
                        ? "; answered_on = " + today() + " is written to " + *file
                        : "")
                << "\n";
  }
  return kDone;
}

int set_zero_and_print(const RigWords& words, bool as_json, Streams& streams) {
  const std::optional<std::string>& file = words.rig_file;
  if (!file) throw UsageError("rig set-zero needs --rig FILE, into which the zero is written");
  const double position_m = lasting_position_m(read_rig(*file, words.plausible), words.is_emulated);
  if (!words.is_emulated) write_zero(*file, position_m);
  if (as_json) {
    print_result(
        {"viscard-rig-zero/1", {*file}}, [&](ResultVisitor& v) { show_zero(v, position_m); },
        streams, kOneLine);
  } else {
    streams.out << fmt::format("positions count from here, {:.3f} mm of the controller",
                               position_m * 1e3)
                << (words.is_emulated ? "" : "; zero is written to " + *file) << "\n";
  }
  return kDone;
}

int zero_force_and_print(const RigWords& words, bool as_json, Streams& streams) {
  const std::optional<std::string>& file = words.rig_file;
  if (!words.is_emulated && !file) {
    throw UsageError("rig zero-force needs --rig FILE, whose load cell is zeroed");
  }
  const StopOnSignal on_signal;
  const ZeroedForce zeroed = zero_rig_force(file ? read_rig(*file, words.plausible) : demo_rig(),
                                            words.is_emulated, &StopOnSignal::is_asked());
  if (as_json) {
    print_result(
        {"viscard-rig-zero-force/1", file ? Words{*file} : Words{}},
        [&](ResultVisitor& v) { show_keys(v, zeroed); }, streams, kOneLine);
  } else {
    streams.out << fmt::format("the instrument was zeroed: {:.4f} N, before {:.4f} N\n",
                               zeroed.after_N, zeroed.before_N);
  }
  return kDone;
}

// An option of a quantity as it was typed; a missing unit is the most frequent mistake. Empty: not
// given.
std::string as_typed(const CommandSyntax& syntax, const char* option, const char* si) {
  const Words typed = given_words(syntax, {option});
  if (typed.empty()) return "";
  return fmt::format("--{} is '{}'{}", option, typed.back(),
                     number_from_text(typed.back())
                         ? fmt::format(", without a unit and so in {}", si)
                         : std::string());
}

StageOrder order_from(const RigWords& words, const std::string& way_typed) {
  constexpr double kLift_m = 2e-3;
  StageOrder order;
  order.is_home = words.what == "home";
  order.speed_m_s = words.speed_m_s;
  order.limit_N = words.limit_N;
  const bool has_both = words.toward_m && words.away_m;
  if (words.what == "home" ? (words.toward_m || words.away_m)
                           : has_both || (words.what == "lift" && words.toward_m)) {
    throw UsageError("rig jog takes --toward or --away, rig lift --away alone, rig home none");
  }
  if (words.what == "jog" && !words.toward_m && !words.away_m) {
    throw UsageError("rig jog needs --toward or --away, such as --away \"0.5 mm\"");
  }
  const double way_m = words.toward_m.value_or(words.away_m.value_or(kLift_m));
  if (!(way_m > 0.0)) {
    throw UsageError(way_typed + "; it must be above 0");
  }
  order.toward_m = words.toward_m ? way_m : -way_m;
  return order;
}

int move_and_print(const RigWords& words, const CommandSyntax& syntax, Streams& streams) {
  const std::optional<std::string>& file = words.rig_file;
  if (!words.is_emulated && !file) {
    throw UsageError("rig " + words.what + " needs --rig FILE, whose stage is moved");
  }
  const OrderTexts typed{as_typed(syntax, words.toward_m ? "toward" : "away", "m"),
                         as_typed(syntax, "speed", "m/s"), as_typed(syntax, "limit", "N")};
  const StageOrder order = order_from(words, typed.way);
  const RigConfig rig = file ? read_rig(*file, words.plausible) : demo_rig();
  try {
    check_order(order, rig, typed);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  const bool has_answered = words.is_emulated || !rig.load_cell.answered_on.empty();
  if (order.toward_m > 0.0 && !has_answered) streams.err << "viscard: " << kUnanswered << "\n";
  const StopOnSignal on_signal;
  RunControl control;
  control.stop = &StopOnSignal::is_asked();
  Progress progress(streams, words.what);
  control.progress = [&](const RunProgress& now) {
    // Only the move itself has a planned duration; homing and the force before it have none.
    progress.show(now.phase == kMovePhase ? now.fraction : 0.0,
                  fmt::format("{}, {:.4f} N", now.phase, now.force_N));
  };
  const StageMoved moved = move_rig_stage(rig, words.is_emulated, order, control);
  progress.clear();
  if (syntax.as_json) {
    print_result(
        {"viscard-rig-move/1", file ? Words{*file} : Words{}},
        [&](ResultVisitor& v) { show_keys(v, moved); }, streams, kOneLine);
  } else {
    const std::string counted = moved.zero_m ? fmt::format(" ({:.3f} mm from your zero)",
                                                           (moved.to_m - *moved.zero_m) * 1e3)
                                             : "";
    streams.out << (order.is_home
                        ? fmt::format("homed; the stage stands at {:.3f} mm{}\n", moved.to_m * 1e3,
                                      counted)
                        : fmt::format(
                              "from {:.3f} to {:.3f} mm{}; force {:.4f} N, before {:.4f} N\n",
                              moved.from_m * 1e3, moved.to_m * 1e3, counted, moved.force_after_N,
                              moved.force_before_N));
  }
  if (!moved.note.empty()) streams.err << "viscard: " << moved.note << "\n";
  if (!moved.is_stopped_by_force) return kDone;
  streams.err << fmt::format(
      "viscard: the stage stopped before the end of its way, because the force {} by {} N{}\n",
      order.toward_m > 0.0 ? "changed" : "rose or pulled", order.limit_N,
      order.toward_m > 0.0 ? ""
                           : ". If it went toward the specimen, toward_specimen under [stage] of "
                             "the rig file has the wrong sign");
  return kFailed;
}

}  // namespace

int run_rig(const Words& words, Streams& streams) {
  RigWords asked;
  CommandSyntax syntax = rig_syntax(asked);
  if (!parse_words(syntax, words, streams)) return kDone;
  asked.plausible = given_plausible(syntax);
  for (const std::string option :
       {"rig", "seconds", "emulate", "toward", "away", "speed", "limit"}) {
    const bool is_of_move = option != "rig" && option != "seconds" && option != "emulate";
    const bool belongs = moves(asked)
                             ? option != "seconds"
                             : !is_of_move && (asked.what == "check" || asked.what == "touch" ||
                                               (zeroes(asked) && option != "seconds") ||
                                               (asked.what == "list" && option == "rig"));
    if (belongs || !is_given(syntax, option)) continue;
    const char* const verbs = is_of_move            ? "jog, lift or home"
                              : option == "seconds" ? "check or touch"
                              : option == "rig"
                                  ? "list, check, touch, jog, lift, home, set-zero or zero-force"
                                  : "check, touch, jog, lift, home, set-zero or "
                                    "zero-force";
    throw UsageError("--" + option + " is for viscard rig " + verbs + "; omit it");
  }
  const bool is_home = asked.what == "home";
  const char* const kJog =
      "rig jog and rig lift; the controller homes at its own speed, and only "
      "the force limits of the rig file stop it";
  refuse_idle<UsageError>({{"--speed", is_given(syntax, "speed"), !is_home, kJog},
                           {"--limit", is_given(syntax, "limit"), !is_home, kJog}});
  if (asked.what == "list") {
    std::optional<RigConfig> rig;
    if (asked.rig_file) rig = read_rig(*asked.rig_file, asked.plausible);
    return list_ports(rig, given_words(syntax, {"rig"}), syntax.as_json, streams);
  }
  if (asked.what == "overshoot") return show_overshoot(syntax.as_json, streams);
  if (moves(asked)) return move_and_print(asked, syntax, streams);
  if (asked.what == "set-zero") return set_zero_and_print(asked, syntax.as_json, streams);
  if (asked.what == "zero-force") return zero_force_and_print(asked, syntax.as_json, streams);
  if (asked.what == "touch") return touch_and_write(asked, syntax.as_json, streams);
  return check_and_print(asked, syntax.as_json, streams);
}

}  // namespace viscard
