#include "io/cli/words/help_text.h"

#include "io/basics/data_folder.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/terminal.h"


#include <algorithm>
#include <optional>
#include <sstream>

namespace viscard {
namespace {

constexpr std::size_t kUsual = 96;       // columns, if the terminal does not say
constexpr std::size_t kTwoColumns = 64;  // from here on descriptions stand beside the options
constexpr std::size_t kNames = 30;       // width of the column of names

// The words of a text in lines, each line indented.
std::string wrapped(const std::string& text, std::size_t columns, std::size_t indent) {
  std::istringstream words(text);
  std::string lines, word;
  std::size_t used = 0;
  while (words >> word) {
    if (used > 0 && indent + used + 1 + word.size() > columns) {
      lines += '\n';
      used = 0;
    }
    lines += used == 0 ? std::string(indent, ' ') : " ";
    used += (used == 0 ? 0 : 1) + word.size();
    lines += word;
  }
  return lines;
}

std::string names_of(const ShownOption& option) {
  std::string text = option.letter.empty() ? "--" + option.name
                                           : "-" + option.letter + " [ --" + option.name + " ]";
  if (!option.value.empty()) text += " " + option.value;
  if (!option.initial.empty()) text += " (=" + option.initial + ")";
  return text;
}

std::string row_of(const ShownOption& option, std::size_t columns, bool is_coloured) {
  const std::string names = "  " + names_of(option);
  if (columns < kTwoColumns || names.size() > kNames) {
    return fitted(bold(names, is_coloured), is_coloured ? 0 : columns) + "\n" +
           wrapped(option.what, columns, columns < kTwoColumns ? 6 : kNames + 2) + "\n";
  }
  const std::string what = wrapped(option.what, columns, kNames + 2);
  return bold(names, is_coloured) + what.substr(std::min(names.size(), what.size())) + "\n";
}

}  // namespace

std::vector<ShownOption> shown_options(const CommandSyntax& syntax) {
  std::vector<ShownOption> shown;
  for (const auto& option : syntax.options.options()) {
    ShownOption one;
    one.name = option->long_name();
    const std::string names = option->format_name();  // "-h [ --help ]" or "--out"
    if (names.size() > 1 && names[1] != '-') one.letter = names.substr(1, 1);
    if (option->semantic()->max_tokens() > 0) {
      std::string parameter = option->format_parameter();  // "arg (=50)"
      const std::size_t at = parameter.find(" (=");
      if (at != std::string::npos) {
        one.initial = parameter.substr(at + 3, parameter.size() - at - 4);
        parameter.erase(at);
      }
      one.value = parameter;
    }
    one.what = option->description();
    const auto choices = syntax.choices.find(one.name);
    if (choices != syntax.choices.end()) one.choices = choices->second;
    shown.push_back(std::move(one));
  }
  return shown;
}

std::string help_text(const CommandSyntax& syntax, std::size_t columns, bool is_coloured) {
  columns = columns == 0 ? kUsual : std::min(columns, kUsual);
  std::string text = fitted("usage: " + std::string(syntax.usage), columns) + "\n\n" +
                     wrapped(syntax.description, columns, 0) + "\n\n" +
                     bold("Options:", is_coloured) + "\n";
  for (const ShownOption& option : shown_options(syntax)) {
    text += row_of(option, columns, is_coloured);
  }
  // The example stays one line, so that it can be copied.
  return text + "\n" + bold("Example:", is_coloured) + " " + example_with_data(syntax.example) +
         "\n";
}

void show_keys(ResultVisitor& v, const CommandSyntax& syntax) {
  std::istringstream words(syntax.description == nullptr ? "" : syntax.description);
  std::string description, word;
  while (words >> word) description += (description.empty() ? "" : " ") + word;
  const auto text = [](const char* one) { return std::string(one == nullptr ? "" : one); };
  v("usage", text(syntax.usage), "the synopsis");
  v("description", description, "what the command does");
  v("example", text(syntax.example), "a command line that works as printed");
  v("positional", syntax.positional, "names of the words that are no options");
  v.list("options", "all options", shown_options(syntax), [&](const ShownOption& one) {
    const auto initial = one.initial.empty() ? std::nullopt : std::optional(one.initial);
    v("name", one.name, "without the dashes");
    v("takes_value", !one.value.empty(), "whether a value follows");
    v.or_null("default", initial, "the value if it is not given");
    v("choices", one.choices, "the values that are allowed; empty: any");
    v("description", one.what, "what it does");
  });
}

}  // namespace viscard
