#include "io/basics/inputs.h"
#include "io/cli/serve/serve_command.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/stop_on_signal.h"
#include "io/flow/capture_setup.h"
#include "io/serve/rig_server.h"

#include <fmt/format.h>

#include <chrono>
#include <ostream>
#include <thread>

namespace viscard {
namespace {

constexpr std::chrono::milliseconds kPoll{50};
constexpr int kHighestPort = 65535;

void show_page(ResultVisitor& v, const std::string& address, int port, const std::string& folder) {
  v("address", address, "of the page");
  v("port", port, "of 127.0.0.1");
  v("folder", folder, "of the series");
}

CommandSyntax serve_syntax(ServeOptions& options, std::string& folder) {
  CommandSyntax syntax;
  syntax.reads_quantities = false;
  syntax.usage = "viscard serve FOLDER --rig FILE [OPTIONS]";
  syntax.description =
      "Shows a page at the rig: devices, specimens, the test, its expected course, live force and\n"
      "depth, stop, and the fit. FOLDER holds the series; it is created if it does not exist.\n"
      "Open the printed address in a browser on this machine. Closing the page stops nothing;\n"
      "Ctrl-C here stops a run, lifts the punch and ends the program.";
  syntax.example = "viscard serve series --emulate --speed 10";
  syntax.positional.add("folder", &folder, "folder of the series");
  const auto add = [&](const char* name, OptionTarget target, const char* what) -> Option& {
    return syntax.options.add(name, target, what);
  };
  add("rig", &options.rig_file, "rig.toml: ports, calibration");
  add("port", &options.port, "port of 127.0.0.1; 0: any free one");
  add("uncalibrated", &options.is_uncalibrated,
      "capture although the load cell's calibration has expired");
  add("emulate", &options.is_emulated, "use an emulated rig");
  add("seed", &options.seed, "seed of the emulated noise");
  add("speed", &options.speed,
      "largest speed of the emulated clock over the wall clock, up to 500; changes no result");
  syntax.results = {{"serve", "viscard serve, when the page can be opened", {[](ResultVisitor& v) {
                       show_page(v, "", 0, "");
                     }}}};
  return syntax;
}

void check_options(const ServeOptions& options) {
  if (options.folder.empty()) {
    throw UsageError("serve needs the folder of the series: viscard serve FOLDER --rig FILE");
  }
  check_port(options.port);
  if (!(options.speed > 0.0) || options.speed > kFastestEmulation) {
    throw UsageError(fmt::format("--speed is {}; it must be above 0 and at most {}", options.speed,
                                 kFastestEmulation));
  }
  if (options.is_emulated) return;
  if (options.seed || options.speed != 1.0) {
    throw UsageError("--seed and --speed are for an emulated rig: add --emulate");
  }
  if (!options.rig_file) {
    throw UsageError("serve needs --rig FILE (or --emulate to try it without hardware)");
  }
}

}  // namespace

void check_port(int port) {
  if (port >= 0 && port <= kHighestPort) return;
  throw UsageError(fmt::format("--port {} is outside 0 to {}", port, kHighestPort));
}

int run_serve(const Words& words, Streams& streams) {
  ServeOptions options;
  std::string folder;
  CommandSyntax syntax = serve_syntax(options, folder);
  if (!parse_words(syntax, words, streams)) return kDone;
  options.folder = folder;
  options.command = quoted_command_line("serve", words);
  check_options(options);
  accept_changed_inputs();  // captures grow, and their notes are edited
  const StopOnSignal on_signal;
  RigServer server(options);
  const auto show = [&](ResultVisitor& v) {
    show_page(v, server.address(), server.port(), folder);
  };
  if (!print_result(syntax, {"viscard-serve/1", given_words(syntax, {"rig"})}, show, streams)) {
    streams.out << "Open in a browser on this machine: " << server.address() << "\n";
    streams.err << "Ctrl-C ends it; a run is then stopped and the punch lifted\n";
  }
  streams.out << std::flush;
  while (!StopOnSignal::is_asked()) std::this_thread::sleep_for(kPoll);
  const LiveState before = server.last_run();
  server.close();
  const LiveState run = server.last_run();
  if (!before.is_running && run.number == before.number) return kDone;
  if (run.outcome && run.outcome->status == "finished") return kDone;
  streams.err << "viscard: " << (run.outcome ? run.outcome->reason : run.trouble) << "\n";
  return kFailed;
}

}  // namespace viscard
