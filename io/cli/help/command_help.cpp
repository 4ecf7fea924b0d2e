#include "io/basics/words.h"
#include "io/cli/help/documents.h"
#include "io/cli/words/help_text.h"
#include "io/cli/words/json_output.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <ostream>

namespace viscard {
namespace {

using nlohmann::ordered_json;

const CommandDocument& named(const std::string& name, const CommandDocuments& documents) {
  return *std::find_if(documents.begin(), documents.end(),
                       [&](const CommandDocument& one) { return one.name == name; });
}

// "scene check": the help of a command explains its subcommands.
void check_subcommand(const CommandDocument& one, const std::string& what) {
  const Option* option = one.syntax.positional.find("what");
  if (option == nullptr) {
    throw UsageError("viscard " + one.name + " has no subcommands; write viscard help " + one.name);
  }
  const Words& known = option->choices;
  if (std::find(known.begin(), known.end(), what) != known.end()) return;
  throw UsageError("there is no '" + one.name + " " + what + "'" + did_you_mean(what, known, ";") +
                   " there are: " + listed(known));
}

ordered_json json_of_list(const CommandDocuments& documents) {
  ordered_json list = ordered_json::array();
  for (const CommandDocument& one : documents) {
    list.push_back({{"name", one.name}, {"summary", one.summary}});
  }
  return {{"commands", list}};
}

}  // namespace

int run_help(const Words& words, Streams& streams, const Words& names,
             const AskDocuments& ask_documents, const std::string& overview) {
  std::optional<std::string> name, what;
  bool is_page = false;
  CommandSyntax syntax{"viscard help [COMMAND] [OPTIONS]",
                       "Explains a command, as --help of the command does, or lists all commands. "
                       "--man prints the source of the manual page instead.",
                       "viscard help fit"};
  syntax.reads_quantities = false;
  syntax.positional.add("command", &name, "a command").such_as(names);
  syntax.positional.add("what", &what, "its subcommand");
  syntax.options.add("man", &is_page, "print the manual page, for man -l -");
  if (!parse_words(syntax, words, streams)) return kDone;
  if (name && std::find(names.begin(), names.end(), *name) == names.end()) {
    throw UsageError("there is no command '" + *name + "'" + did_you_mean(*name, names, ";") +
                     " 'viscard help' lists the commands");
  }
  const CommandDocuments documents = ask_documents();
  const CommandDocument* one = name ? &named(*name, documents) : nullptr;
  if (what) check_subcommand(*one, *what);
  const std::string page = !is_page         ? ""
                           : one != nullptr ? manual_page(*one)
                                            : manual_overview(documents);
  if (syntax.as_json) {
    ordered_json object = one != nullptr ? json_from_syntax(one->syntax) : json_of_list(documents);
    if (!page.empty()) object["manual_page"] = page;
    print_json({one != nullptr ? "viscard-help/1" : "viscard-commands/1", {}}, object, streams);
  } else if (!page.empty()) {
    streams.out << page;
  } else if (one != nullptr) {
    streams.out << help_text(one->syntax, streams.columns, streams.is_out_coloured);
  } else {
    streams.out << overview;
  }
  return kDone;
}

}  // namespace viscard
