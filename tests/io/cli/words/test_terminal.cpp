// Text that fits the terminal, colours, manual pages and completion scripts.
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/printable_stream.h"
#include "io/cli/words/terminal.h"
#include "tests/support/error_text.h"
#include "tests/support/run_command.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace viscard {
namespace {

using test::contains;
using test::run_command;

std::size_t widest_line(const std::string& text) {
  std::istringstream in(text);
  std::size_t widest = 0;
  for (std::string line; std::getline(in, line);) widest = std::max(widest, line.size());
  return widest;
}

// What a command prints on a terminal of so many columns.
std::string printed_on(std::size_t columns, const Words& words) {
  std::ostringstream out, err;
  Streams streams{out, err, false};
  streams.columns = columns;
  run_viscard(words, streams);
  return out.str();
}

// The words of a text in order, without blanks and line breaks.
std::string words_of(const std::string& text) {
  std::istringstream in(text);
  std::string joined;
  for (std::string word; in >> word;) joined += word + " ";
  return joined;
}

TEST_CASE("text fits the terminal, keeps the cells of a table whole, and loses no word", "[cli]") {
  const std::string table =
      "  effect         if off     what decides\n"
      "  relaxation     1.2e-03    the time of the load over the shortest relaxation time\n";
  CHECK(fitted(table, 0) == table);
  CHECK(fitted(table, 200) == table);
  const std::string narrow = fitted(table, 40);
  CHECK(widest_line(narrow) <= 40);
  CHECK(words_of(narrow) == words_of(table));
  CHECK(fitted("  one two  three four five  six", 20) == "  one two  three\n      four five  six");
  CHECK(fitted("  name   what it does, in many words", 33) ==
        "  name   what it does, in many\n         words");
  CHECK(fitted("a-word-that-is-longer-than-ten", 10) == "a-word-that-is-longer-than-ten");
  CHECK(fitted("\n\n", 10) == "\n\n");
}

TEST_CASE("names with control characters do nothing to a terminal", "[cli]") {
  std::ostringstream sink;
  PrintableStream err(sink);
  err << "viscard: " << std::string("a\x1b[2J\r\0b.csv", 12) << 'c' << '\a' << 12 << "\n\ttext\n";
  CHECK(sink.str() == "viscard: a\\x1b[2J\\x0d\\x00b.csvc\\x0712\n\ttext\n");
  sink.str("");
  err << "µ 力 "
      << "\xc2\x9b"
      << "1m \xb5 \x7f";
  CHECK(sink.str() == "µ 力 \\xc2\\x9b1m \\xb5 \\x7f");
  sink.str("");
  err << AsItIs{kEraseLine} << "50 %" << std::flush;
  CHECK(sink.str() == "\r\033[K50 %");
  std::ostringstream plain;
  plain << AsItIs{kEraseLine};
  CHECK(plain.str() == "\r\033[K");
}

TEST_CASE("text for people shows control characters of names", "[cli]") {
  std::ostringstream out, err;
  Streams streams{out, err, false};
  {
    FittedText text(streams);
    static_cast<std::ostream&>(text) << "column 'E\x1b[31m'\n";
  }
  CHECK(out.str() == "column 'E\\x1b[31m'\n");
}

TEST_CASE("help and tables fit down to 40 columns", "[cli]") {
  const std::string scene = VISCARD_SOURCE_DIR "/data/scenes/pillar_modal.toml";
  for (const std::size_t columns : {40u, 60u, 80u}) {
    for (const Command& command : commands()) {
      CAPTURE(command.name, columns);
      std::string help = printed_on(columns, {command.name, "--help"});
      help.erase(help.find("\nExample: "));  // stays one line, so that it can be copied
      CHECK(widest_line(help) <= columns);
    }
    CHECK(widest_line(printed_on(columns, {"--help"})) <= columns);
    CHECK(widest_line(printed_on(columns, {"plan", scene})) <=
          std::max<std::size_t>(columns, scene.size() + 1));
    CHECK(widest_line(printed_on(columns, {"card", "--list"})) <= columns);
    CHECK(widest_line(printed_on(columns, {"design"})) <= columns);
  }
  std::string help = run_command({"fit", "--help"}).out;
  help.erase(help.find("\nExample: "));
  CHECK(widest_line(help) <= 96);
}

TEST_CASE("colour follows --color, NO_COLOR and TERM", "[cli]") {
  constexpr int kNoTerminal = -1;
  CHECK_FALSE(is_coloured({}, kNoTerminal));
  CHECK(is_coloured({"fit", "--color", "always"}, kNoTerminal));
  CHECK(is_coloured({"fit", "--color=always"}, kNoTerminal));
  CHECK_FALSE(is_coloured({"fit", "--color", "never"}, kNoTerminal));
  CHECK(run_command({"design", "--color", "sometimes"}).status == kBadWords);
  CHECK_FALSE(contains(run_command({"fit", "--help"}).out, "\033"));
}

TEST_CASE("viscard help NAME is viscard NAME --help", "[cli]") {
  for (const Command& command : commands()) {
    CAPTURE(command.name);
    CHECK(run_command({"help", command.name}).out == run_command({command.name, "--help"}).out);
  }
  const auto unknown = run_command({"help", "fti"});
  CHECK(unknown.status == kBadWords);
  CHECK(contains(unknown.err, "did you mean 'fit'?"));
}

TEST_CASE("every option stands in the manual page and in all completion scripts", "[cli]") {
  const std::string bash = run_command({"completion", "bash"}).out;
  const std::string zsh = run_command({"completion", "zsh"}).out;
  const std::string fish = run_command({"completion", "fish"}).out;
  const std::string overview = run_command({"help", "--man"}).out;
  for (const Command& command : commands()) {
    const std::string name = command.name;
    const std::string page = run_command({"help", "--man", name}).out;
    CHECK(page.rfind(".TH VISCARD-", 0) == 0);
    CHECK(contains(page, ".SH EXIT STATUS"));
    CHECK(contains(overview, ".BR viscard\\-" + name + " (1)"));
    const auto json = nlohmann::json::parse(run_command({name, "--help", "--json"}).out);
    REQUIRE(json["options"].size() >= 3);
    for (const auto& option : json["options"]) {
      const auto long_name = option["name"].get<std::string>();
      CAPTURE(name, long_name);
      std::string in_page;
      for (const char c : long_name) in_page += c == '-' ? std::string("\\-") : std::string(1, c);
      CHECK(contains(page, "\\fB\\-\\-" + in_page + "\\fR"));
      CHECK(contains(bash, "--" + long_name));
      CHECK(contains(zsh, "'*--" + long_name + "["));
      CHECK(contains(fish, "from " + name + "' -l " + long_name));
    }
  }
  CHECK(run_command({"completion", "tcsh"}).status == kBadWords);
}

}  // namespace
}  // namespace viscard
