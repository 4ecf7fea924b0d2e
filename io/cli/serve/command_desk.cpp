#include "io/basics/inputs.h"
#include "io/cli/serve/serve_command.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/stop_on_signal.h"
#include "io/serve/desk_server.h"

#include <fmt/format.h>

#include <chrono>
#include <ostream>
#include <thread>

namespace viscard {
namespace {

constexpr std::chrono::milliseconds kLook{50};

void show_desk(ResultVisitor& v, const std::string& address, int port, const std::string& folder) {
  v("address", address, "of the page");
  v("port", port, "of 127.0.0.1");
  v("folder", folder, "of the tables");
}

}  // namespace

int run_desk(const Words& words, Streams& streams) {
  DeskOptions options;
  std::string folder;
  CommandSyntax syntax{
      "viscard desk FOLDER [OPTIONS]",
      "Shows a page for tables of any machine: drop a file, see how it is read, fit it, look at "
      "data, curve and residuals, and take the card of a solver away; predict, compare, check a "
      "card, solve a scene and write a report. FOLDER holds the tables and "
      "what is made of them; it is created if it does not exist, and nothing in it is replaced. "
      "Open the printed address in a browser on this machine. Ctrl-C ends the program.",
      "viscard desk data/demo"};
  syntax.reads_quantities = false;
  syntax.positional.add("folder", &folder, "folder of the tables");
  syntax.options.add("port", &options.port, "port of 127.0.0.1; 0: any free one");
  syntax.results = {{"desk", "viscard desk, when the page can be opened", {[](ResultVisitor& v) {
                       show_desk(v, "", 0, "");
                     }}}};
  if (!parse_words(syntax, words, streams)) return kDone;
  options.folder = folder;
  check_port(options.port);
  accept_changed_inputs();  // of the folder
  const StopOnSignal on_signal;
  const DeskServer server(options);
  const auto show = [&](ResultVisitor& v) {
    show_desk(v, server.address(), server.port(), folder);
  };
  if (!print_result(syntax, {"viscard-desk/1", {}}, show, streams)) {
    streams.out << "Open in a browser on this machine: " << server.address() << "\n";
    streams.err << "Ctrl-C ends it\n";
  }
  streams.out << std::flush;
  while (!StopOnSignal::is_asked()) std::this_thread::sleep_for(kLook);
  return kDone;
}

}  // namespace viscard
