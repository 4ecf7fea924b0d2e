#include "tests/layering/source_tree.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace viscard {
namespace {

struct Question {
  const char* sought;
  const char* folder;  // the answer may also lie in a room below it
};

const std::vector<Question> kQuestions{
    {"Prony series and temperature shift", "models/material"},
    {"laws of rubber and their stability", "models/hyperelastic"},
    {"force of a punch tip on a bonded layer", "models/contact"},
    {"propagation of an uncertain input", "models/uncertainty"},
    {"factorisation and eigenvalues of the matrices of a pillar", "models/pillar/system"},
    {"meshes of the section of a pillar", "models/pillar/mesh"},
    {"time steps and readout of a film", "models/pillar/time"},
    {"rows of pillars on one film", "models/array/plane"},
    {"heat and noise of an electrode", "models/array/sensing"},
    {"plan of the effects of a scene", "models/scene"},
    {"closed-form limits of a sensor", "models/sensor"},
    {"spikes and averages of the input columns", "fit/samples"},
    {"profiles, bootstrap and covariance", "fit/intervals"},
    {"stiffness of the frame", "fit/calibration"},
    {"drivers of the stage", "rig/stages"},
    {"serial ports", "rig/lines"},
    {"emulated rig without hardware", "rig/emulator"},
    {"columns of tables from another machine", "io/tables"},
    {"material written for a solver", "io/cards"},
    {"the Python module", "io/python"},
};

std::set<std::string> words_in(const std::string& text) {
  std::string plain = text;
  std::transform(plain.begin(), plain.end(), plain.begin(), [](unsigned char c) {
    return std::isalnum(c) != 0 ? static_cast<char>(std::tolower(c)) : ' ';
  });
  static const std::set<std::string> kEmpty{"a",  "an", "the", "of",  "and", "on",
                                            "to", "in", "by",  "for", "its", "their"};
  std::set<std::string> words;
  std::istringstream in(plain);
  for (std::string word; in >> word;) {
    if (kEmpty.count(word) == 0) words.insert(word);
  }
  return words;
}

// "pillars" and "pillar" are the same word.
bool is_same_word(const std::string& a, const std::string& b) {
  const auto is_plural = [](const std::string& many, const std::string& one) {
    return many == one + "s" || many == one + "es";
  };
  return a == b || is_plural(a, b) || is_plural(b, a);
}

// How many of the words that are sought stand in a line.
int words_found(const std::set<std::string>& sought, const std::string& line) {
  const std::set<std::string> words = words_in(line);
  return static_cast<int>(std::count_if(sought.begin(), sought.end(), [&](const std::string& word) {
    return std::any_of(words.begin(), words.end(),
                       [&](const std::string& other) { return is_same_word(word, other); });
  }));
}

// The rooms whose first lines have the most of the words.
std::vector<std::string> rooms_found(const SourceTree& tree, const std::string& sought) {
  const std::set<std::string> words = words_in(sought);
  std::vector<std::string> best;
  int most = 1;
  for (const auto& [folder, room] : tree.rooms) {
    const int found = room.readme.empty() ? 0 : words_found(words, room.readme[0]);
    if (found > most) best.clear();
    if (found >= most) best.push_back(folder);
    most = std::max(most, found);
  }
  return best;
}

}  // namespace

TEST_CASE("the first lines of the READMEs lead to the room of what is sought", "[layering]") {
  const SourceTree tree = read_source_tree(VISCARD_SOURCE_DIR);
  REQUIRE(kQuestions.size() == 20);
  for (const Question& question : kQuestions) {
    const std::vector<std::string> found = rooms_found(tree, question.sought);
    CAPTURE(question.sought, question.folder, found);
    CHECK_FALSE(found.empty());
    for (const std::string& folder : found) {
      CHECK((folder + "/").rfind(question.folder + std::string("/"), 0) == 0);
    }
  }
}

TEST_CASE("a search of first lines prefers the line with more of the words", "[layering]") {
  SourceTree tree;
  tree.rooms["a"].readme = {"# a: serial ports"};
  tree.rooms["b"].readme = {"# b: files of a serial"};
  CHECK(rooms_found(tree, "the serial port") == std::vector<std::string>{"a"});
  CHECK(rooms_found(tree, "serial numbers") == std::vector<std::string>{"a", "b"});
  CHECK(rooms_found(tree, "of the weather").empty());
}

}  // namespace viscard
