#include "io/cli/words/command_line.h"

#include "io/basics/words.h"
#include "io/basics/written_path.h"
#include "io/cli/words/help_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/output_paths.h"
#include "io/cli/words/printable_stream.h"

#include <boost/program_options.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <ostream>

namespace po = boost::program_options;

namespace viscard {
namespace {

std::vector<std::string> option_names(const OptionList& options) {
  std::vector<std::string> names;
  for (const Option& option : options.all()) names.push_back("--" + option.name);
  return names;
}

[[noreturn]] void throw_unknown(const std::string& word, const CommandSyntax& syntax) {
  throw UsageError("there is no option '" + word + "'" +
                   did_you_mean(word, option_names(syntax.options)) + " Usage: " + syntax.usage);
}

// "viscard card" of "viscard card MATERIAL.json --for TARGET".
std::string command_of(const CommandSyntax& syntax) {
  const std::string usage = syntax.usage;
  return usage.substr(0, usage.find(' ', usage.find(' ') + 1));
}

// Somebody may have typed an option as a subcommand: "viscard card check m.json".
[[noreturn]] void throw_too_many(const Words& free, const CommandSyntax& syntax) {
  const std::string who = command_of(syntax);
  const std::string first = free.empty() ? "" : free.front();
  std::vector<std::string> names;
  for (const Option& option : syntax.options.all()) names.push_back(option.name);
  const bool is_file = first.find_first_of("./") != std::string::npos;
  const std::string near = is_file ? "" : nearest_word(first, names);
  if (!first.empty() && !near.empty()) {
    throw UsageError("there is no '" + who + " " + first + "'; did you mean '" + who + " --" +
                     near + "'? Usage: " + syntax.usage);
  }
  const std::size_t n = syntax.positional.all().size();
  throw UsageError("too many words on the command line, from '" +
                   (n < free.size() ? free[n] : first) + "' on; usage: " + syntax.usage);
}

// A command with subcommands takes them as its first word, "what".
void check_what(const CommandSyntax& syntax) {
  const Option* option = syntax.positional.find("what");
  if (option == nullptr || option->choices.empty()) return;
  const Words what = given_words(syntax, {"what"});
  const std::vector<std::string>& known = option->choices;
  if (!what.empty() && std::find(known.begin(), known.end(), what.front()) != known.end()) return;
  const std::string who = command_of(syntax);
  throw UsageError((what.empty() ? who + " needs a word more; "
                                 : "there is no '" + who + " " + what.front() + "'" +
                                       did_you_mean(what.front(), known, "; ")) +
                   (!what.empty() && !nearest_word(what.front(), known).empty() ? " " : "") +
                   "there are: " + listed(known) + ". Usage: " + syntax.usage);
}

void check_positional(const CommandSyntax& syntax) {
  for (const Option& word : syntax.positional.all()) {
    const bool is_optional = std::holds_alternative<std::optional<std::string>*>(word.target);
    if (is_optional || is_given(syntax, word.name)) continue;
    throw UsageError("no " + word.name + " given; usage: " + syntax.usage);
  }
}

// The library splits words into names and values and knows nothing of their types.
void describe(const OptionList& options, po::options_description& all) {
  for (const Option& option : options.all()) {
    const std::string name = option.name == "help" ? "help,h" : option.name;
    if (is_switch(option)) {
      all.add_options()(name.c_str(), "");
    } else if (is_list(option)) {
      all.add_options()(name.c_str(), po::value<Words>()->composing(), "");
    } else {
      all.add_options()(name.c_str(), po::value<std::string>(), "");
    }
  }
}

// The values of all options that are given, and the words that belong to none.
Words take_given(const Words& words, CommandSyntax& syntax) {
  Words free;
  try {
    po::options_description options;
    describe(syntax.options, options);
    describe(syntax.positional, options);  // a word may be named, such as --scene FILE
    // Shortened options are refused: a new option could change the meaning of an old script.
    const int style =
        po::command_line_style::default_style & ~po::command_line_style::allow_guessing;
    const po::parsed_options parsed =
        po::command_line_parser(words).options(options).style(style).run();
    po::variables_map checked;  // refuses an option that is given twice
    po::parsed_options named = parsed;
    std::erase_if(named.options, [](const po::option& one) { return one.position_key >= 0; });
    po::store(named, checked);
    for (const po::option& one : parsed.options) {
      Words& into = one.position_key >= 0 ? free : syntax.given[one.string_key];
      into.insert(into.end(), one.value.begin(), one.value.end());
    }
  } catch (const po::unknown_option& error) {
    throw_unknown(error.get_option_name(), syntax);
  } catch (const po::error& error) {
    throw UsageError(std::string(error.what()) + "; usage: " + syntax.usage);
  }
  return free;
}

void take_positional(const Words& free, CommandSyntax& syntax) {
  std::size_t next = 0;
  for (const Option& word : syntax.positional.all()) {
    if (is_given(syntax, word.name)) continue;  // by its name
    const std::size_t end = is_list(word) ? free.size() : std::min(free.size(), next + 1);
    if (next < end)
      syntax.given[word.name].assign(free.begin() + static_cast<long>(next),
                                     free.begin() + static_cast<long>(end));
    next = end;
  }
  if (next < free.size()) throw_too_many(free, syntax);
}

void set_all(const OptionList& options, const CommandSyntax& syntax) {
  const Plausible judged = given_plausible(syntax);
  for (const Option& option : options.all()) {
    const auto found = syntax.given.find(option.name);
    if (found != syntax.given.end()) set_option(option, found->second, judged);
  }
}

// "--out --json": a value was forgotten, and the next option would become the name of a file.
void refuse_forgotten_values(const CommandSyntax& syntax) {
  for (const auto& [name, values] : syntax.given) {
    for (const std::string& value : values) {
      const bool is_option = value.starts_with("--") &&
                             syntax.options.find(value.substr(2, value.find('=') - 2)) != nullptr;
      if (is_option) throw UsageError("--" + name + " needs a value; '" + value + "' is an option");
    }
  }
}

// Of files that a command reads or writes, whose folders --strip-paths keeps out of what is written.
void remember_folders(const Words& words) {
  for (const std::string& word : words) {
    remember_folder_of(word);
    if (const std::size_t equals = word.find('='); equals != std::string::npos)
      remember_folder_of(word.substr(equals + 1));
  }
}

// --help, or its object with --json, or the receiver of the syntax.
void show_help(const CommandSyntax& syntax, Streams& streams) {
  if (streams.on_help) return streams.on_help(syntax);
  if (syntax.as_json) {
    return print_result(
        {"viscard-help/1", {}}, [&](ResultVisitor& v) { show_keys(v, syntax); }, streams);
  }
  streams.out << AsItIs{help_text(syntax, streams.columns, streams.is_out_coloured)};
}

}  // namespace

bool parse_words(CommandSyntax& syntax, const Words& words, Streams& streams) {
  bool is_help = false, strips_paths = false;
  std::string color = "auto";  // read by main() before the command begins
  std::string plausible = "on";
  syntax.options.group("All commands");
  if (syntax.reads_quantities && syntax.options.find("plausible") == nullptr) {
    syntax.options
        .add("plausible", &plausible,
             "off: accept values that no test, material or scene can have (a wrong unit, most "
             "often); the result states it")
        .among({"on", "off"});
  }
  syntax.options
      .add("json", &syntax.as_json, "print one machine-readable object on stdout, nothing else")
      .only_typed();
  syntax.options
      .add("color", &color,
           "auto, always or never; auto colours a terminal unless NO_COLOR is set or TERM is dumb")
      .shown_as("WHEN")
      .among({"auto", "always", "never"})
      .only_typed();
  syntax.options
      .add("strip-paths", &strips_paths,
           "write the names of files without their folders, which often name persons, into all "
           "that is written")
      .only_typed();
  syntax.options.add("help", &is_help, "print this").only_typed();
  const Words free = take_given(words, syntax);
  syntax.as_json = is_given(syntax, "json");
  strip_written_paths(is_given(syntax, "strip-paths"));
  remember_folders(words);
  if (is_given(syntax, "help")) {
    show_help(syntax, streams);
    return false;
  }
  refuse_forgotten_values(syntax);
  take_positional(free, syntax);
  streams.accepts_implausible = given_plausible(syntax) == Plausible::kOff;
  check_output_paths(syntax);
  check_what(syntax);
  with_usage_errors([&] {
    set_all(syntax.options, syntax);
    set_all(syntax.positional, syntax);
    refuse_without_effect(syntax.options,
                          [&](const std::string& name) { return is_given(syntax, name); });
  });
  check_positional(syntax);
  return true;
}

bool is_given(const CommandSyntax& syntax, const std::string& name) {
  return syntax.given.count(name) > 0;
}

Plausible given_plausible(const CommandSyntax& syntax, Plausible otherwise) {
  const Words words = given_words(syntax, {"plausible"});
  try {
    return words.empty() ? otherwise : plausible_from_word(words.back(), otherwise);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--") + error.what());
  }
}

Words given_words(const CommandSyntax& syntax, std::initializer_list<const char*> names) {
  Words words;
  for (const char* name : names) {
    const auto found = syntax.given.find(name);
    if (found != syntax.given.end())
      words.insert(words.end(), found->second.begin(), found->second.end());
  }
  return words;
}

std::string quoted_command_line(const std::string& command, const Words& words) {
  Words all{"viscard", command};
  all.insert(all.end(), words.begin(), words.end());
  std::erase(all, "--json");  // no file is another one for it
  std::erase(all, "--strip-paths");
  for (std::string& word : all) word = written_word(word);
  return quoted_for_shell(all);
}

}  // namespace viscard
