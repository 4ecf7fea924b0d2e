#include "io/cli/command.h"

#include <algorithm>
#include <ostream>

namespace viscard {
namespace {

void print_overview(std::ostream& out) {
  out << "viscard " VISCARD_VERSION
         ": a soft polymer from a load cell to a validated simulation\n\n"
         "usage: viscard COMMAND [OPTIONS]      (viscard COMMAND --help says more)\n\n";
  for (const Command& command : commands()) {
    out << "  " << command.name << std::string(12 - std::string(command.name).size(), ' ')
        << command.summary << "\n";
  }
  out << "\nExample: viscard demo --out demo\n";
}

int dispatch(const std::vector<std::string>& words, Streams& streams) {
  if (words.empty() || words[0] == "help" || words[0] == "--help" || words[0] == "-h") {
    print_overview(words.empty() ? streams.err : streams.out);
    return words.empty() ? kBadWords : kDone;
  }
  if (words[0] == "--version") {
    streams.out << "viscard " VISCARD_VERSION "\n";
    return kDone;
  }
  std::vector<std::string> names;
  for (const Command& command : commands()) {
    if (words[0] == command.name) return command.run({words.begin() + 1, words.end()}, streams);
    names.emplace_back(command.name);
  }
  const std::string near = nearest_word(words[0], names);
  throw UsageError("there is no command '" + words[0] + "'" +
                   (near.empty() ? "" : "; did you mean '" + near + "'?") +
                   " 'viscard --help' lists them");
}

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitute = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substitute});
    }
  }
  return row[b.size()];
}

}  // namespace

const std::vector<Command>& commands() {
  static const std::vector<Command> table{};
  return table;
}

int run_viscard(const std::vector<std::string>& words, Streams& streams) {
  try {
    return dispatch(words, streams);
  } catch (const UsageError& error) {
    streams.err << "viscard: " << error.what() << "\n";
    return kBadWords;
  } catch (const std::exception& error) {
    streams.err << "viscard: " << error.what() << "\n";
    return kFailed;
  }
}

std::string nearest_word(const std::string& word, const std::vector<std::string>& known) {
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : known) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

}  // namespace viscard
