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

std::string names_of(const Option& option) {
  const std::string letter = letter_of(option), value = value_of(option);
  std::string text =
      letter.empty() ? "--" + option.name : "-" + letter + " [ --" + option.name + " ]";
  if (!value.empty()) text += " " + value;
  if (!option.initial.empty()) text += " (=" + option.initial + ")";
  return text;
}

std::string row_of(const Option& option, std::size_t columns, bool is_coloured) {
  const std::string names = "  " + names_of(option);
  if (columns < kTwoColumns || names.size() > kNames) {
    return fitted(bold(names, is_coloured), is_coloured ? 0 : columns) + "\n" +
           wrapped(option.what, columns, columns < kTwoColumns ? 6 : kNames + 2) + "\n";
  }
  const std::string what = wrapped(option.what, columns, kNames + 2);
  return bold(names, is_coloured) + what.substr(std::min(names.size(), what.size())) + "\n";
}

}  // namespace

std::string value_of(const Option& option) {
  if (is_switch(option)) return "";
  if (!option.value.empty()) return option.value;
  return option.is_file ? "FILE" : "arg";
}

std::string letter_of(const Option& option) {
  return option.name == "help" ? "h" : "";
}

std::string help_text(const CommandSyntax& syntax, std::size_t columns, bool is_coloured) {
  columns = columns == 0 ? kUsual : std::min(columns, kUsual);
  std::string text = fitted("usage: " + std::string(syntax.usage), columns) + "\n\n" +
                     wrapped(syntax.description, columns, 0) + "\n\n";
  // Short lists need no headings.
  const bool has_groups = !syntax.options.all().front().group.empty();
  std::string heading;
  if (!has_groups) text += bold("Options:", is_coloured) + "\n";
  for (const Option& option : syntax.options.all()) {
    if (has_groups && option.group != heading) {
      text += (heading.empty() ? "" : "\n") + bold(option.group + ":", is_coloured) + "\n";
      heading = option.group;
    }
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
  std::vector<std::string> positional;
  for (const Option& one : syntax.positional.all()) positional.push_back(one.name);
  const auto& all = syntax.options.all();
  v("usage", text(syntax.usage), "the synopsis");
  v("description", description, "what the command does");
  v("example", text(syntax.example), "a command line that works as printed");
  v("positional", positional, "names of the words that are no options");
  v.list("options", "all options", std::vector<Option>{all.begin(), all.end()},
         [&](const Option& one) {
           const auto initial = one.initial.empty() ? std::nullopt : std::optional(one.initial);
           v("name", one.name, "without the dashes");
           v("takes_value", !is_switch(one), "whether a value follows");
           v.or_null("default", initial, "the value if it is not given");
           v("choices", one.choices, "the values that are allowed; empty: any");
           v("description", one.what, "what it does");
           v("group", one.group, "heading above it in the help");
           v("type", type_of(one), "flag, text, file, whole number, number or quantity");
           v("is_list", is_list(one), "whether it may be given several times");
           v("unit", one.unit, "SI unit of a quantity; empty: none");
           v("is_keyword", one.is_keyword, "whether Python has it as a keyword");
         });
}

}  // namespace viscard
