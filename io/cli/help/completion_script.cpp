#include "io/cli/help/documents.h"
#include "io/cli/words/help_text.h"

#include <fmt/format.h>

namespace viscard {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::string names_joined(const CommandDocuments& documents) {
  std::vector<std::string> names;
  for (const CommandDocument& one : documents) names.push_back(one.name);
  return joined(names);
}

// The values of the first positional word; empty: a file.
std::string first_words(const CommandSyntax& syntax) {
  const auto& words = syntax.positional.all();
  return words.empty() ? "" : joined(words.front().choices);
}

// For a shell's single quotes.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string before(const std::string& text, const std::string& of, char mark) {
  std::string out;
  for (const char c : text) {
    if (of.find(c) != std::string::npos) out += mark;
    out += c;
  }
  return out;
}

std::string bash_case(const CommandDocument& one) {
  std::string options, cases;
  for (const Option& option : one.syntax.options.all()) {
    options += (options.empty() ? "--" : " --") + option.name;
    if (is_switch(option)) continue;
    cases += fmt::format("        --{}) values='{}'; is_value=1 ;;\n", option.name,
                         joined(option.choices));
  }
  return fmt::format(
      "    {})\n      options='{}'\n      words='{}'\n      case $previous in\n{}      esac\n"
      "      ;;\n",
      one.name, options, first_words(one.syntax), cases);
}

}  // namespace

std::string bash_completion(const CommandDocuments& documents) {
  std::string script =
      "# bash completion of viscard " VISCARD_VERSION
      ", printed by: viscard completion bash\n"
      "_viscard() {\n"
      "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
      "  local command= options= words= values= is_value=0 place=0 i\n"
      "  COMPREPLY=()\n"
      "  for ((i = 1; i < COMP_CWORD; i++)); do\n"
      "    [[ ${COMP_WORDS[i]} == -* ]] && continue\n"
      "    if [[ -z $command ]]; then command=${COMP_WORDS[i]}; else place=$((place + 1)); fi\n"
      "  done\n"
      "  case $command in\n";
  script += fmt::format(
      "    '') COMPREPLY=($(compgen -W '{} --help --version' -- \"$current\")); return ;;\n",
      names_joined(documents));
  for (const CommandDocument& one : documents) script += bash_case(one);
  return script +
         "  esac\n"
         "  if ((is_value)); then\n"
         "    [[ -z $values ]] || COMPREPLY=($(compgen -W \"$values\" -- \"$current\"))\n"
         "  elif [[ $current == -* ]]; then\n"
         "    COMPREPLY=($(compgen -W \"$options\" -- \"$current\"))\n"
         "  elif ((place == 0)) && [[ -n $words ]]; then\n"
         "    COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
         "  fi\n"
         "}\n"
         "complete -o default -F _viscard viscard  # files where nothing else is known\n";
}

std::string zsh_completion(const CommandDocuments& documents) {
  std::string script = "#compdef viscard\n# zsh completion of viscard " VISCARD_VERSION
                       ", printed by: viscard completion zsh\n_viscard() {\n"
                       "  local -a commands\n  commands=(\n";
  for (const CommandDocument& one : documents) {
    script += "    " + quoted(one.name + ":" + one.summary) + "\n";
  }
  script +=
      "  )\n  if ((CURRENT == 2)); then\n    _describe command commands\n    return\n  fi\n"
      "  local command=${words[2]}\n  shift words\n  ((CURRENT--))\n  case $command in\n";
  for (const CommandDocument& one : documents) {
    script += "    " + one.name + ")\n      _arguments";
    for (const Option& option : one.syntax.options.all()) {
      const std::string values =
          option.choices.empty() ? "_files" : "(" + joined(option.choices) + ")";
      script += " \\\n        " +
                quoted("*--" + option.name + "[" + before(option.what, "[]:\\", '\\') + "]" +
                       (is_switch(option) ? "" : ":" + option.name + ":" + values));
    }
    const std::string words = first_words(one.syntax);
    if (!words.empty()) {
      script += " \\\n        " +
                quoted("1:" + one.syntax.positional.all().front().name + ":(" + words + ")");
    }
    script += " \\\n        '*:file:_files'\n      ;;\n";
  }
  return script + "  esac\n}\n_viscard \"$@\"\n";
}

std::string fish_completion(const CommandDocuments& documents) {
  std::string script =
      "# fish completion of viscard " VISCARD_VERSION ", printed by: viscard completion fish\n";
  for (const CommandDocument& one : documents) {
    script += fmt::format("complete -c viscard -f -n __fish_use_subcommand -a {} -d {}\n", one.name,
                          quoted(one.summary));
  }
  for (const CommandDocument& one : documents) {
    const std::string after =
        "complete -c viscard -n '__fish_seen_subcommand_from " + one.name + "'";
    for (const Option& option : one.syntax.options.all()) {
      script += after + " -l " + option.name;
      if (!letter_of(option).empty()) script += " -s " + letter_of(option);
      if (!is_switch(option)) script += " -r";
      if (!option.choices.empty()) script += " -f -a " + quoted(joined(option.choices));
      script += " -d " + quoted(option.what) + "\n";
    }
    const std::string words = first_words(one.syntax);
    if (words.empty()) continue;
    const bool is_all = one.syntax.positional.all().size() == 1;  // no file follows
    script += after + (is_all ? " -f -a " : " -a ") + quoted(words) + "\n";
  }
  return script;
}

}  // namespace viscard
