#pragma once

#include "io/cli/words/command_line.h"

#include <functional>
#include <string>
#include <vector>

namespace viscard {

// What help, manual pages and completion know of a command.
struct CommandDocument {
  std::string name, summary;
  CommandSyntax syntax;
};
using CommandDocuments = std::vector<CommandDocument>;

// Asks all commands for their syntax, also help and completion.
using AskDocuments = std::function<CommandDocuments()>;

// Keys of viscard --version --json.
void show_version(ResultVisitor& v);

// viscard help: the overview, the help of a command, or a manual page.
// names: of all commands; overview: what `viscard --help` prints.
int run_help(const Words& words, Streams& streams, const Words& names,
             const AskDocuments& documents, const std::string& overview);
// viscard completion: the script of a shell.
int run_completion(const Words& words, Streams& streams, const AskDocuments& documents);

// The source of viscard-NAME.1, for man(1).
std::string manual_page(const CommandDocument& document);
// The source of viscard.1.
std::string manual_overview(const CommandDocuments& documents);

// The completion of all commands and options for bash, zsh or fish.
std::string bash_completion(const CommandDocuments& documents);
std::string zsh_completion(const CommandDocuments& documents);
std::string fish_completion(const CommandDocuments& documents);

}  // namespace viscard
