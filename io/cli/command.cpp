#include "io/cli/command.h"

#include "io/basics/inputs.h"
#include "io/basics/program.h"
#include "io/basics/words.h"
#include "io/basics/words_file.h"
#include "io/cli/card/card_words.h"
#include "io/cli/fit/fit_command.h"
#include "io/cli/help/documents.h"
#include "io/cli/report/report_commands.h"
#include "io/cli/rig/rig_commands.h"
#include "io/cli/scene/scene_commands.h"
#include "io/cli/serve/serve_command.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/folderless_stream.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/printable_stream.h"
#include "io/cli/words/terminal.h"
#include "models/maths/failure_text.h"

#include <algorithm>
#include <filesystem>
#include <new>
#include <ostream>
#include <sstream>

namespace viscard {
namespace {

std::string overview(const Streams& streams) {
  const bool is_coloured = streams.is_out_coloured;
  std::string text = "viscard " VISCARD_VERSION
                     ": a soft polymer from a load cell to a validated simulation\n\n"
                     "usage: viscard COMMAND [OPTIONS]      (details: viscard help COMMAND)\n\n";
  for (const Command& command : commands()) {
    const std::string name = command.name;
    text += "  " + bold(name, is_coloured) + std::string(12 - name.size(), ' ') + command.summary +
            "\n";
  }
  text += "\n" + bold("Where to begin", is_coloured) +
          ", without a rig and without data:\n"
          "  viscard demo --out demo  runs all steps on an emulated rig and writes a page\n"
          "  viscard help fit         explains a command, with an example that works as printed\n"
          "\n@FILE among the words stands for the words in that file, one a line.\n"
          "\nExample: viscard demo --out demo\n";
  return fitted(text, streams.columns);
}

Words command_names() {
  Words names;
  for (const Command& command : commands()) names.emplace_back(command.name);
  return names;
}

// Every command hands over its table of options in the place of its help.
CommandDocuments ask_documents() {
  CommandDocuments documents;
  for (const Command& command : commands()) {
    std::ostringstream nothing;
    Streams streams{nothing, nothing};
    streams.on_help = [&](const CommandSyntax& syntax) {
      documents.push_back({command.name, command.summary, syntax});
    };
    command.run({"--help"}, streams);
  }
  return documents;
}

int dispatch(const Words& typed, Streams& streams) {
  const Words words = with_words_of_files(typed);
  if (words.empty()) {
    streams.err << AsItIs{overview(streams)};
    return kBadWords;
  }
  if (words[0] == "--help" || words[0] == "-h") {
    Words others{words.begin() + 1, words.end()};
    return run_help(others, streams, command_names(), ask_documents, overview(streams));
  }
  if (words[0] == "--version") {
    if (std::find(words.begin(), words.end(), "--json") != words.end()) {
      print_result({"viscard-version/1", {}}, show_version, streams);
    } else {
      streams.out << program_with_version() << "\n";
    }
    return kDone;
  }
  for (const Command& command : commands()) {
    if (words[0] == command.name) return command.run({words.begin() + 1, words.end()}, streams);
  }
  const std::string meant = did_you_mean(words[0], command_names(), "");
  throw UsageError(std::string("there is no ") +
                   (words[0].rfind('-', 0) == 0 ? "option" : "command") + " '" + words[0] + "'" +
                   (meant.empty() ? ";" : meant) + " 'viscard --help' lists the commands");
}

}  // namespace

const std::vector<Command>& commands() {
  static const std::vector<Command> table{
      {"rig", "list serial ports, check a rig", run_rig},
      {"capture", "run one indentation on the rig, or on an emulated one", run_capture},
      {"serve", "show a page at the rig: run a series of specimens and fit it", run_serve},
      {"desk", "show a page for tables of any machine: read, fit, look, take a card", run_desk},
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
      {"sweep", "answer a scene at many values of its parameters, to be stopped and continued",
       run_sweep_command},
      {"cost", "measure what accuracy costs: error against time over meshes and effects", run_cost},
      {"report", "write one page about captures, tables and materials", run_report},
      {"demo", "run all steps on the emulated rig",
       [](const Words& words, Streams& streams) { return run_demo(words, streams, run_viscard); }},
      {"help", "explain a command; with --man as a manual page",
       [](const Words& words, Streams& streams) {
         return run_help(words, streams, command_names(), ask_documents, overview(streams));
       }},
      {"completion", "print the completion script of bash, zsh or fish",
       [](const Words& words, Streams& streams) {
         return run_completion(words, streams, ask_documents);
       }},
  };
  return table;
}

int run_viscard(const Words& words, Streams& streams) {
  const bool strips = std::find(words.begin(), words.end(), "--strip-paths") != words.end();
  if (!strips)
    return with_exit_status("viscard", words, streams, [&] { return dispatch(words, streams); });
  // The screen shows where the files are.
  const bool is_out_shown = dynamic_cast<PrintableStream*>(&streams.out) != nullptr,
             is_err_shown = streams.err_is_terminal || streams.is_err_coloured;
  FolderlessStream out(streams.out), err(streams.err);
  Streams inner{.out = is_out_shown ? streams.out : out,
                .err = is_err_shown ? streams.err : err,
                .err_is_terminal = streams.err_is_terminal,
                .columns = streams.columns,
                .is_out_coloured = streams.is_out_coloured,
                .is_err_coloured = streams.is_err_coloured,
                .on_help = streams.on_help};
  return with_exit_status("viscard", words, inner, [&] { return dispatch(words, inner); });
}

namespace {

// Whatever the command is, and whether it ends well.
class NotesAtEnd {
 public:
  explicit NotesAtEnd(Streams& streams) : streams_(streams) {}
  ~NotesAtEnd() {
    try {
      for (const InputFile& file : provenance_of_inputs()) {
        if (!file.note.empty())
          streams_.err << "viscard: note: " << file.path << ": " << file.note << "\n";
      }
    } catch (const std::bad_alloc&) {  // the command has stated the lack of memory
    }
  }
  NotesAtEnd(const NotesAtEnd&) = delete;
  NotesAtEnd& operator=(const NotesAtEnd&) = delete;

 private:
  Streams& streams_;
};

}  // namespace

int with_exit_status(const char* program, const Words& words, Streams& streams,
                     const std::function<int()>& work) {
  const InputRecorder recorder;
  const NotesAtEnd notes(streams);
  const AsItIs who{bold_red(program + std::string(":"), streams.is_err_coloured) + " "};
  try {
    return with_json_errors(words, streams, [&] {
      try {
        return work();
      } catch (const std::exception& error) {
        if (!is_lack_of_memory(error)) throw;
        throw std::runtime_error(failure_text(error, "this command"));
      }
    });
  } catch (const UsageError& error) {
    streams.err << who << shortened(error.what()) << "\n";
    return kBadWords;
  } catch (const std::filesystem::filesystem_error& error) {
    streams.err << who << "'" << error.path1().string() << "': " << error.code().message()
                << "; choose another place\n";
    return kFailed;
  } catch (const std::exception& error) {
    streams.err << who << shortened(error.what()) << "\n";
    return kFailed;
  }
}

}  // namespace viscard
