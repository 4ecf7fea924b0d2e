#include "io/cli/words/command_line.h"

#include "io/basics/option_quantity.h"
#include "io/basics/words.h"
#include "io/cli/words/help_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/output_paths.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <ostream>
#include <typeinfo>

namespace po = boost::program_options;

namespace viscard {
namespace {

std::vector<std::string> option_names(const po::options_description& options) {
  std::vector<std::string> names;
  for (const auto& option : options.options()) names.push_back("--" + option->long_name());
  return names;
}

[[noreturn]] void throw_unknown(const std::string& word, const po::options_description& options,
                                const char* usage) {
  throw UsageError("there is no option '" + word + "'" + did_you_mean(word, option_names(options)) +
                   " Usage: " + usage);
}

// The words that belong to no option, in order.
Words free_words(const Words& words, const po::options_description& options) {
  Words free;
  const auto parsed = po::command_line_parser(words).options(options).allow_unregistered().run();
  for (const auto& option : parsed.options) {
    if (!option.string_key.empty() || option.position_key < 0) continue;
    free.insert(free.end(), option.value.begin(), option.value.end());
  }
  return free;
}

// "viscard card" of "viscard card MATERIAL.json --for TARGET".
std::string command_of(const CommandSyntax& syntax) {
  const std::string usage = syntax.usage;
  return usage.substr(0, usage.find(' ', usage.find(' ') + 1));
}

// Somebody may have typed an option as a subcommand: "viscard card check m.json".
[[noreturn]] void throw_too_many(const Words& words, const CommandSyntax& syntax) {
  const Words free = free_words(words, syntax.options);
  const std::string who = command_of(syntax);
  const std::string first = free.empty() ? "" : free.front();
  std::vector<std::string> names;
  for (const std::string& name : option_names(syntax.options)) names.push_back(name.substr(2));
  const std::string near = nearest_word(first, names);
  if (!first.empty() && !near.empty()) {
    throw UsageError("there is no '" + who + " " + first + "'; did you mean '" + who + " --" +
                     near + "'? Usage: " + syntax.usage);
  }
  const std::size_t n = syntax.positional.size();
  throw UsageError("too many words on the command line, from '" +
                   (n < free.size() ? free[n] : first) + "' on; usage: " + syntax.usage);
}

bool counts(const std::type_info& type) {
  return type == typeid(std::uint64_t) || type == typeid(std::size_t);
}

const std::type_info& type_of(const po::option_description& option) {
  const auto* typed = dynamic_cast<const po::typed_value_base*>(option.semantic().get());
  return typed != nullptr ? typed->value_type() : typeid(void);
}

// What a value of an option must be.
const char* expected_of(const po::option_description& option) {
  const std::type_info& type = type_of(option);
  if (type == typeid(void)) return "a value";
  if (counts(type)) return "a whole number from 0 on, such as 5";
  if (type == typeid(double) || type == typeid(std::vector<double>)) {
    return "a number without unit, such as 0.5";
  }
  const bool is_text = type == typeid(std::string) || type == typeid(std::vector<std::string>);
  return is_text ? "a text" : "a whole number, such as 5";
}

// "--terms cannot be 'x'; expected a whole number, such as 5".
[[noreturn]] void throw_bad_value(const po::validation_error& error, const Words& words,
                                  const po::options_description& options, const char* usage) {
  const std::string name = error.get_option_name();
  const std::string key = name.substr(std::min(name.size(), name.find_first_not_of('-')));
  const po::option_description* option = options.find_nothrow(key, false);
  if (option == nullptr) throw UsageError(std::string(error.what()) + "; usage: " + usage);
  std::string value;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i].starts_with(name + "=")) value = words[i].substr(name.size() + 1);
    if (words[i] == name && i + 1 < words.size()) value = words[i + 1];
  }
  throw UsageError(name + " cannot be '" + value + "'; expected " + expected_of(*option));
}

// The library reads "-3" as 18446744073709551613.
void refuse_negative_counts(const po::parsed_options& parsed) {
  for (const po::option& given : parsed.options) {
    const po::option_description* option =
        parsed.description->find_nothrow(given.string_key, false);
    if (option == nullptr || !counts(type_of(*option)) || given.value.empty()) continue;
    const std::string& value = given.value.front();
    if (!value.starts_with('-')) continue;
    throw UsageError("--" + given.string_key + " cannot be '" + value + "'; expected " +
                     expected_of(*option));
  }
}

// A command with subcommands takes them as its first word, "what".
void check_what(const CommandSyntax& syntax, const po::variables_map& values) {
  const auto choices = syntax.choices.find("what");
  if (choices == syntax.choices.end()) return;
  const auto what = given(values, "what");
  const std::vector<std::string>& known = choices->second;
  if (what && std::find(known.begin(), known.end(), *what) != known.end()) return;
  const std::string who = command_of(syntax);
  throw UsageError(
      (what ? "there is no '" + who + " " + *what + "'" + did_you_mean(*what, known, "; ")
            : who + " needs a word more; ") +
      (what && !nearest_word(*what, known).empty() ? " " : "") + "there are: " + listed(known) +
      ". Usage: " + syntax.usage);
}

void add_common_options(CommandSyntax& syntax) {
  syntax.options.add_options()("json", "print one machine-readable object on stdout, nothing else")(
      "color", po::value<std::string>()->default_value("auto")->value_name("WHEN"),
      "auto, always or never; auto colours a terminal unless NO_COLOR is set or TERM is dumb")(
      "help,h", "print this");
  syntax.choices["color"] = {"auto", "always", "never"};
  if (!syntax.reads_quantities) return;
  syntax.options.add_options()("plausible", po::value<std::string>()->default_value("on"),
                               "off: accept values that no test, material or scene can have (a "
                               "wrong unit, most often); the result says so");
  syntax.choices["plausible"] = {"on", "off"};
}

void check_color(const std::string& when) {
  if (when == "auto" || when == "always" || when == "never") return;
  throw UsageError("--color cannot be '" + when + "'; there are: auto, always, never");
}

// --help, or its object with --json, or the receiver of the syntax.
void show_help(const CommandSyntax& syntax, bool as_json, Streams& streams) {
  if (streams.on_help) return streams.on_help(syntax);
  if (as_json) return print_json({"viscard-help/1", {}}, json_from_syntax(syntax), streams);
  streams.out << help_text(syntax, streams.columns, streams.is_out_coloured);
}

}  // namespace

std::optional<po::variables_map> parse_words(CommandSyntax& syntax, const Words& words,
                                             Streams& streams) {
  add_common_options(syntax);
  po::options_description all;
  all.add(syntax.options);
  po::options_description hidden;
  po::positional_options_description positions;
  for (std::size_t i = 0; i < syntax.positional.size(); ++i) {
    const bool repeats = syntax.last_is_repeatable && i + 1 == syntax.positional.size();
    const char* name = syntax.positional[i].c_str();
    if (repeats) {
      hidden.add_options()(name, po::value<std::vector<std::string>>());
    } else {
      hidden.add_options()(name, po::value<std::string>());
    }
    positions.add(name, repeats ? -1 : 1);
  }
  all.add(hidden);

  po::variables_map values;
  try {
    // Shortened options are refused: a new option could change the meaning of an old script.
    const int style =
        po::command_line_style::default_style & ~po::command_line_style::allow_guessing;
    const po::parsed_options parsed =
        po::command_line_parser(words).options(all).positional(positions).style(style).run();
    refuse_negative_counts(parsed);
    po::store(parsed, values);
  } catch (const po::unknown_option& error) {
    throw_unknown(error.get_option_name(), syntax.options, syntax.usage);
  } catch (const po::too_many_positional_options_error&) {
    throw_too_many(words, syntax);
  } catch (const po::validation_error& error) {
    throw_bad_value(error, words, all, syntax.usage);
  } catch (const po::error& error) {
    throw UsageError(std::string(error.what()) + "; usage: " + syntax.usage);
  }
  if (values.count("help") > 0) {
    show_help(syntax, values.count("json") > 0, streams);
    return std::nullopt;
  }
  check_color(values["color"].as<std::string>());
  streams.accepts_implausible = given_plausible(values) == Plausible::kOff;
  check_output_paths(values, syntax.may_exist);
  check_what(syntax, values);
  po::notify(values);
  return values;
}

Plausible given_plausible(const po::variables_map& values, Plausible otherwise) {
  const auto word = given(values, "plausible");
  try {
    return word ? plausible_from_word(*word, otherwise) : otherwise;
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--") + error.what());
  }
}

std::optional<double> given_quantity(const po::variables_map& values, const char* name,
                                     const QuantityOrUnit& quantity) {
  try {
    return option_quantity(std::string("--") + name, given(values, name), quantity,
                           given_plausible(values));
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

std::string quoted_command_line(const std::string& command, const Words& words) {
  const std::string plain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789@%_-+=:,./";
  std::string line = "viscard " + command;
  for (const std::string& word : words) {
    line += ' ';
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) {
      line += word;
      continue;
    }
    line += '\'';
    for (const char c : word) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += '\'';
  }
  return line;
}

}  // namespace viscard
