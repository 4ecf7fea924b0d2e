#include "io/basics/atomic_file.h"
#include "io/basics/json_string.h"
#include "io/basics/program.h"
#include "io/basics/words.h"
#include "io/cli/help/documents.h"
#include "io/cli/words/help_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/printable_stream.h"
#include "io/flow/command_error.h"
#include "io/scenes/scene_file.h"

#include <algorithm>
#include <filesystem>
#include <ostream>

namespace viscard {
namespace {

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

void show_list(ResultVisitor& v, const CommandDocuments& documents) {
  v.list("commands", "all commands in the order of the flow", documents,
         [&](const CommandDocument& one) {
           v("name", one.name, "of the command");
           v("summary", one.summary, "one line");
         });
}

void show_page(ResultVisitor& v, const std::string& page) {
  v.when(!page.empty(), [&] { v("manual_page", page, "source of the manual page, with --man"); });
}

}  // namespace

void show_version(ResultVisitor& v) {
  v("program", "viscard", "viscard");
  v("source", program_version(), "version and commit of the source");
}

namespace {

// Those of no command of their own, and of this one.
std::vector<DescribedResult> common_results() {
  DescribedResult error{"error",
                        "any command that fails before it has a result",
                        {[](ResultVisitor& v) { v("error", CommandError{}, "why it failed"); }}};
  error.has_inputs = false;
  return {error,
          {"version", "viscard --version", {show_version}},
          {"help", "viscard help COMMAND, viscard COMMAND --help", {[](ResultVisitor& v) {
             show_keys(v, CommandSyntax{});
             show_page(v, "");
           }}},
          {"commands", "viscard help", {[](ResultVisitor& v) {
             show_list(v, {});
             show_page(v, "");
           }}}};
}

// A file for each schema, keys.md and keys.txt about all of them, and scenes.md about scene files.
void write_schemas(const std::filesystem::path& folder, bool overwrite,
                   const CommandDocuments& documents) {
  std::filesystem::create_directories(folder);
  std::vector<DescribedResult> results;
  for (const CommandDocument& one : documents) {
    for (const DescribedResult& result : one.syntax.results) {
      results.push_back(result);
      write_file(folder / (result.name + ".schema.json"),
                 text_from_json(schema_of(result), 1) + "\n", overwrite);
    }
  }
  write_file(folder / "keys.md", table_of_keys(results), overwrite);
  write_file(folder / "keys.txt", list_of_keys(results), overwrite);
  write_file(folder / "scenes.md", table_of_scene_keys(), overwrite);
}

}  // namespace

int run_help(const Words& words, Streams& streams, const Words& names,
             const AskDocuments& ask_documents, const std::string& overview) {
  std::optional<std::string> name, what, schemas;
  bool is_page = false, overwrite = false;
  CommandSyntax syntax{"viscard help [COMMAND] [OPTIONS]",
                       "Explains a command, as --help of the command does, or lists all commands. "
                       "--man prints the source of the manual page instead.",
                       "viscard help fit"};
  syntax.reads_quantities = false;
  syntax.positional.add("command", &name, "a command").such_as(names);
  syntax.positional.add("what", &what, "its subcommand");
  syntax.options.add("man", &is_page, "print the manual page, for man -l -");
  syntax.options.add("schemas", &schemas,
                     "folder to write JSON Schemas of what --json prints into, with tables of all "
                     "keys, also those of scene files");
  syntax.options.add("force", &overwrite, "overwrite existing files").only_with({"schemas"});
  syntax.may_exist = {"schemas"};
  syntax.results = common_results();
  if (!parse_words(syntax, words, streams)) return kDone;
  if (name && std::find(names.begin(), names.end(), *name) == names.end()) {
    throw UsageError("there is no command '" + *name + "'" + did_you_mean(*name, names, ";") +
                     " 'viscard help' lists the commands");
  }
  const CommandDocuments documents = ask_documents();
  if (schemas) write_schemas(*schemas, overwrite, documents);
  const CommandDocument* one = name ? &named(*name, documents) : nullptr;
  if (what) check_subcommand(*one, *what);
  const std::string page = !is_page         ? ""
                           : one != nullptr ? manual_page(*one)
                                            : manual_overview(documents);
  if (syntax.as_json) {
    const auto show = [&](ResultVisitor& v) {
      one != nullptr ? show_keys(v, one->syntax) : show_list(v, documents);
      show_page(v, page);
    };
    print_result({one != nullptr ? "viscard-help/1" : "viscard-commands/1", {}}, show, streams);
  } else if (!page.empty()) {
    streams.out << page;
  } else if (one != nullptr) {
    streams.out << AsItIs{help_text(one->syntax, streams.columns, streams.is_out_coloured)};
  } else {
    streams.out << AsItIs{overview};
  }
  return kDone;
}

}  // namespace viscard
