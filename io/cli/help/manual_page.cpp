// The macros are those of man(7).
#include "io/basics/words.h"
#include "io/cli/help/documents.h"
#include "io/cli/words/help_text.h"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace viscard {
namespace {

// Text as it may stand in a page: a hyphen that people copy is a minus sign there.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else {
      out += c;
    }
  }
  return out;
}

// A line of text; one that begins with a dot or an apostrophe would be a macro.
std::string line_of(const std::string& text) {
  std::istringstream words(text);
  std::string line, word;
  while (words >> word) line += (line.empty() ? "" : " ") + word;
  line = escaped(line);
  const bool is_macro = !line.empty() && (line[0] == '.' || line[0] == '\'');
  return (is_macro ? "\\&" : "") + line + "\n";
}

std::string head_of(const std::string& name, const std::string& summary) {
  std::string title = name;
  std::transform(title.begin(), title.end(), title.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return ".TH " + title + " 1 \"\" \"viscard " VISCARD_VERSION "\" \"viscard\"\n.SH NAME\n" +
         escaped(name) + " \\- " + line_of(summary);
}

std::string option_of(const Option& option) {
  std::string text = ".TP\n";
  const std::string letter = letter_of(option), value = value_of(option);
  if (!letter.empty()) text += "\\fB\\-" + letter + "\\fR, ";
  text += "\\fB\\-\\-" + escaped(option.name) + "\\fR";
  if (!value.empty()) text += " \\fI" + escaped(value) + "\\fR";
  text += "\n" + line_of(option.what);
  if (!option.initial.empty()) text += ".br\nDefault: " + line_of(option.initial);
  if (!option.choices.empty()) text += ".br\n" + line_of("Values: " + listed(option.choices) + ".");
  return text;
}

std::string common_end() {
  return ".SH EXIT STATUS\n"
         ".TP\n0\nThe work is done.\n"
         ".TP\n1\nThe work failed, or its result is not to be trusted.\n"
         ".TP\n2\nThe command line is wrong.\n"
         ".SH ENVIRONMENT\n"
         ".TP\n\\fBNO_COLOR\\fR\nIf set and not empty, nothing is coloured unless "
         "\\fB\\-\\-color always\\fR is given.\n"
         ".TP\n\\fBTERM\\fR\nA terminal called \\(lqdumb\\(rq is not coloured.\n"
         ".TP\n\\fBCOLUMNS\\fR\nWidth of tables where the output is no terminal; at least 40.\n";
}

}  // namespace

std::string manual_page(const CommandDocument& document) {
  const CommandSyntax& syntax = document.syntax;
  std::string page = head_of("viscard-" + document.name, document.summary) + ".SH SYNOPSIS\n.nf\n" +
                     line_of(syntax.usage) + ".fi\n.SH DESCRIPTION\n" + line_of(syntax.description);
  for (const Option& word : syntax.positional.all()) {
    if (word.choices.empty()) continue;
    page += ".PP\n" + line_of(word.name + " is one of " + listed(word.choices) + ".");
  }
  page += ".SH OPTIONS\n";
  std::string heading;
  for (const Option& option : syntax.options.all()) {
    if (option.group != heading && !syntax.options.all().front().group.empty()) {
      page += ".SS " + escaped(option.group) + "\n";
    }
    heading = option.group;
    page += option_of(option);
  }
  page += common_end();
  return page + ".SH EXAMPLES\n.nf\n" + line_of(syntax.example) +
         ".fi\n.SH SEE ALSO\n.BR viscard (1)" +
         (document.name == "sweep" ? ",\n.BR viscard\\-mpi (1)\n" : "\n");
}

std::string manual_overview(const CommandDocuments& documents) {
  std::string page =
      head_of("viscard", "a soft polymer from a load cell to a validated simulation") +
      ".SH SYNOPSIS\n.nf\nviscard COMMAND [OPTIONS]\nviscard \\-\\-version [\\-\\-json]\n.fi\n"
      ".SH DESCRIPTION\n" +
      line_of(
          "viscard drives a load-cell indentation rig, fits a modulus and a Prony series to "
          "captures and tables, writes material cards for solvers, and simulates soft pillars "
          "on piezoelectric film. Results go to standard output, messages and progress to "
          "standard error. With --json every command prints one object with the keys schema, "
          "version and inputs, or, if it fails, error with code, message, where and hint.") +
      ".SH COMMANDS\n";
  for (const CommandDocument& one : documents) {
    page += ".TP\n\\fBviscard " + escaped(one.name) + "\\fR\n" + line_of(one.summary);
  }
  page += common_end();
  page +=
      ".SH EXAMPLES\nAll steps on an emulated rig:\n.PP\n.nf\nviscard demo \\-\\-out demo\n.fi\n"
      ".SH SEE ALSO\n";
  for (std::size_t i = 0; i < documents.size(); ++i) {
    page += ".BR viscard\\-" + escaped(documents[i].name) + " (1)" +
            (i + 1 < documents.size() ? ",\n" : "\n");
  }
  return page;
}

}  // namespace viscard
