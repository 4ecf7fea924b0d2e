#include "io/cli/command.h"

#include "io/basics/words.h"
#include "io/cli/card/card_words.h"
#include "io/cli/fit/fit_command.h"
#include "io/cli/report/report_commands.h"
#include "io/cli/rig/rig_commands.h"
#include "io/cli/scene/scene_commands.h"
#include "io/cli/serve/serve_command.h"
#include "io/cli/words/json_output.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <ostream>

namespace viscard {
namespace {

void print_overview(std::ostream& out) {
  out << "viscard " VISCARD_VERSION
         ": a soft polymer from a load cell to a validated simulation\n\n"
         "usage: viscard COMMAND [OPTIONS]      (details: viscard COMMAND --help)\n\n";
  for (const Command& command : commands()) {
    out << "  " << command.name << std::string(12 - std::string(command.name).size(), ' ')
        << command.summary << "\n";
  }
  out << "\nExample: viscard demo --out demo\n";
}

int dispatch(const Words& words, Streams& streams) {
  if (words.empty() || words[0] == "help" || words[0] == "--help" || words[0] == "-h") {
    print_overview(words.empty() ? streams.err : streams.out);
    return words.empty() ? kBadWords : kDone;
  }
  if (words[0] == "--version") {
    if (std::find(words.begin(), words.end(), "--json") != words.end()) {
      print_json<nlohmann::ordered_json>({"viscard-version/1", {}}, {{"program", "viscard"}},
                                         streams);
    } else {
      streams.out << "viscard " VISCARD_VERSION "\n";
    }
    return kDone;
  }
  std::vector<std::string> names;
  for (const Command& command : commands()) {
    if (words[0] == command.name) return command.run({words.begin() + 1, words.end()}, streams);
    names.emplace_back(command.name);
  }
  throw UsageError("there is no command '" + words[0] + "'" + did_you_mean(words[0], names, "") +
                   " 'viscard --help' lists the commands");
}

}  // namespace

const std::vector<Command>& commands() {
  static const std::vector<Command> table{
      {"rig", "list serial ports, check a rig", run_rig},
      {"capture", "run one indentation on the rig, or on an emulated one", run_capture},
      {"serve", "show a page at the rig: run a series of specimens and fit it", run_serve},
      {"calibrate", "find the load cell's gain with weights, or the frame's stiffness on a block",
       run_calibrate},
      {"export", "write a capture as CSV", run_export},
      {"fit", "find modulus and Prony series in captures or tables", run_fit},
      {"predict", "predict creep, relaxation, cycles, oscillation or any history, with its band",
       run_predict},
      {"card", "write, check or prove a material card for a solver", run_card},
      {"validate", "check a material in a pillar against exact creep and relaxation", run_validate},
      {"scene", "check a scene file and draw its geometry", run_scene},
      {"plan", "choose the effects that a scene needs at its tolerance, with reasons", run_plan},
      {"simulate", "solve a scene: static, modes, buckling, creep, with error estimates",
       run_simulate},
      {"design", "compute closed-form limits of a pillar sensor and its admissible region",
       run_design},
      {"cost", "measure what accuracy costs: error against time over meshes and effects", run_cost},
      {"report", "write one page about captures, tables and materials", run_report},
      {"demo", "run all steps on the emulated rig",
       [](const Words& words, Streams& streams) { return run_demo(words, streams, run_viscard); }},
  };
  return table;
}

int run_viscard(const Words& words, Streams& streams) {
  try {
    return with_json_errors(words, streams, [&] { return dispatch(words, streams); });
  } catch (const UsageError& error) {
    streams.err << "viscard: " << error.what() << "\n";
    return kBadWords;
  } catch (const std::filesystem::filesystem_error& error) {
    streams.err << "viscard: '" << error.path1().string() << "': " << error.code().message()
                << "; choose another place\n";
    return kFailed;
  } catch (const std::exception& error) {
    streams.err << "viscard: " << error.what() << "\n";
    return kFailed;
  }
}

}  // namespace viscard
