#include "io/basics/words.h"
#include "io/cli/help/documents.h"
#include "io/cli/words/json_output.h"

#include <ostream>

namespace viscard {
namespace {

struct Shell {
  const char* name;
  std::string (*script)(const CommandDocuments& documents);
};
constexpr Shell kShells[] = {
    {"bash", bash_completion}, {"zsh", zsh_completion}, {"fish", fish_completion}};

std::vector<std::string> shell_names() {
  std::vector<std::string> names;
  for (const Shell& shell : kShells) names.emplace_back(shell.name);
  return names;
}

void show_script(ResultVisitor& v, const std::string& shell, const std::string& script) {
  v.word("shell", shell, {"bash", "zsh", "fish"}, "name of the shell");
  v("script", script, "the script");
}

}  // namespace

int run_completion(const Words& words, Streams& streams, const AskDocuments& documents) {
  std::string name;
  CommandSyntax syntax{"viscard completion SHELL [OPTIONS]",
                       "Prints the script with which bash, zsh or fish complete commands, options "
                       "and their values. For bash: source <(viscard completion bash)",
                       "viscard completion bash"};
  syntax.reads_quantities = false;
  syntax.positional.add("shell", &name, "the shell").such_as(shell_names());
  syntax.results = {{"completion", "viscard completion SHELL", {[](ResultVisitor& v) {
                       show_script(v, "", "");
                     }}}};
  if (!parse_words(syntax, words, streams)) return kDone;
  for (const Shell& shell : kShells) {
    if (name != shell.name) continue;
    const std::string script = shell.script(documents());
    const auto show = [&](ResultVisitor& v) { show_script(v, name, script); };
    if (!print_result(syntax, {"viscard-completion/1", {}}, show, streams)) streams.out << script;
    return kDone;
  }
  throw UsageError("there is no completion for '" + name + "'" +
                   did_you_mean(name, shell_names(), "") + " There are: " + listed(shell_names()));
}

}  // namespace viscard
