#include "io/cli/words/command_line.h"

#include "io/basics/units.h"
#include "io/basics/words.h"
#include "io/cli/words/help_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/output_paths.h"

#include <nlohmann/json.hpp>

#include <ostream>

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

void add_common_options(CommandSyntax& syntax) {
  syntax.options.add_options()("json", "print one machine-readable object on stdout, nothing else")(
      "color", po::value<std::string>()->default_value("auto")->value_name("WHEN"),
      "auto, always or never; auto colours a terminal unless NO_COLOR is set or TERM is dumb")(
      "help,h", "print this");
  syntax.choices["color"] = {"auto", "always", "never"};
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
    po::store(po::command_line_parser(words).options(all).positional(positions).style(style).run(),
              values);
  } catch (const po::unknown_option& error) {
    throw_unknown(error.get_option_name(), syntax.options, syntax.usage);
  } catch (const po::too_many_positional_options_error&) {
    throw UsageError(std::string("too many words on the command line; usage: ") + syntax.usage);
  } catch (const po::error& error) {
    throw UsageError(std::string(error.what()) + "; usage: " + syntax.usage);
  }
  if (values.count("help") > 0) {
    show_help(syntax, values.count("json") > 0, streams);
    return std::nullopt;
  }
  check_color(values["color"].as<std::string>());
  check_output_paths(values);
  po::notify(values);
  return values;
}

std::optional<double> given_quantity(const po::variables_map& values, const char* name,
                                     const char* si_unit) {
  const auto text = given(values, name);
  if (!text) return std::nullopt;
  try {
    return si_from_text(*text, si_unit);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--") + name + ": " + error.what());
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
