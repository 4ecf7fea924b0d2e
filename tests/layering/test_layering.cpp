#include "tests/layering/declarations.h"
#include "tests/layering/source_tree.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <regex>

namespace viscard {
namespace {

const SourceTree& tree() {
  static const SourceTree kTree = read_source_tree(VISCARD_SOURCE_DIR);
  return kTree;
}

bool is_ours(const std::string& include) {
  static const std::regex kOurs("^(models|fit|rig|io|tests)/");
  return std::regex_search(include, kOurs);
}

// The rooms that the files of each room include.
Graph included_rooms() {
  Graph graph;
  for (const auto& [path, file] : tree().files) {
    for (const std::string& include : file.includes) {
      if (folder_of(include) != folder_of(path)) graph[folder_of(path)].insert(folder_of(include));
    }
  }
  return graph;
}

bool begins_with_any(const std::string& text, const std::vector<std::string>& beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](const std::string& b) { return text.rfind(b, 0) == 0; });
}

// What the folders at the top may know of each other, even if their rooms list more.
struct Border {
  const char* folder;
  std::vector<std::string> may_know;  // beginnings of folders
  std::vector<std::string> outside;   // beginnings of headers in angle brackets it may not include
};

const std::vector<std::string> kFiles{"fstream", "iostream", "filesystem"};

std::vector<Border> borders() {
  return {
      {"models/",
       {"models/"},
       {"fstream", "iostream", "filesystem", "chrono", "fmt/", "nlohmann/", "sqlite3", "toml++/",
        "boost/program_options", "ceres/", "libserial/"}},
      {"fit/",
       {"models/", "fit"},
       {"fstream", "iostream", "filesystem", "sqlite3", "toml++/", "boost/program_options",
        "libserial/"}},
      {"rig/", {"models/", "rig"}, {"sqlite3", "toml++/", "boost/", "ceres/", "nlohmann/"}},
      // The emulator answers as a device does: it knows the protocols, not our drivers.
      {"rig/emulator/", {"models/", "rig/lines", "rig/protocols", "rig/emulator"}, {}},
      {"io/", {"models/", "fit", "io", "rig"}, {"ceres/", "libserial/"}},
  };
}

// Rooms of io that may meet the rig.
bool may_know_rig(const std::string& folder) {
  return begins_with_any(folder, {"io/flow", "io/cli", "io/serve", "io/python"});
}

std::string words_of(const std::set<std::string>& rooms) {
  std::string words;
  for (const std::string& room : rooms) words += (words.empty() ? "" : ", ") + room;
  return words;
}

// The rooms in a README's line "May include: models/maths, models/material."
std::set<std::string> rooms_in_readme(const std::string& line) {
  static const std::regex kRoom(R"((models|fit|rig|io)(/\w+)*)");
  std::set<std::string> rooms;
  const std::string list = line.substr(std::min(line.size(), line.find(':')));
  for (std::sregex_iterator i(list.begin(), list.end(), kRoom), end; i != end; ++i) {
    rooms.insert(i->str());
  }
  return rooms;
}

}  // namespace

TEST_CASE("every file stands in a room that lists it", "[layering]") {
  REQUIRE(tree().rooms.size() > 30);
  for (const auto& [path, file] : tree().files) {
    CAPTURE(path);
    CHECK(tree().rooms.count(folder_of(path)) == 1);
  }
}

TEST_CASE("a room includes the rooms behind USES and uses no others", "[layering]") {
  const Graph included = included_rooms();
  for (const auto& [folder, room] : tree().rooms) {
    CAPTURE(folder);
    const auto found = included.find(folder);
    CHECK(words_of(room.uses) == (found == included.end() ? "" : words_of(found->second)));
  }
}

TEST_CASE("arrows between rooms run one way", "[layering]") {
  CHECK(nodes_on_circles(graph_of_rooms(tree())).empty());
  CHECK(nodes_on_circles({{"a", {"b"}}, {"b", {"c"}}, {"c", {"b"}}}) ==
        std::vector<std::string>{"b", "c"});
}

TEST_CASE("files include each other one way", "[layering]") {
  const std::vector<std::string> circles = nodes_on_circles(graph_of_files(tree()));
  CAPTURE(circles);
  CHECK(circles.empty());
}

TEST_CASE("the folders at the top know each other one way", "[layering]") {
  for (const Border& border : borders()) {
    for (const auto& [path, file] : tree().files) {
      if (path.rfind(border.folder, 0) != 0) continue;
      CAPTURE(path);
      for (const std::string& include : file.includes) {
        CAPTURE(include);
        CHECK(begins_with_any(include, border.may_know));
        if (begins_with_any(path, {"io/"}) && !may_know_rig(folder_of(path))) {
          CHECK(include.rfind("rig/", 0) != 0);
        }
      }
      for (const std::string& include : file.outside_includes) {
        CAPTURE(include);
        CHECK_FALSE(begins_with_any(include, border.outside));
        CHECK_FALSE(is_ours(include));
      }
    }
  }
}

TEST_CASE("one file knows Boost.Program_options, which splits the words of a command line",
          "[layering]") {
  for (const auto& [path, file] : tree().files) {
    if (path == "io/cli/words/command_line.cpp") continue;
    CAPTURE(path);
    for (const std::string& include : file.outside_includes) {
      CHECK(include.rfind("boost/program_options", 0) != 0);
    }
  }
}

// A program that calls setlocale(), such as Python with a window, gets 0,5 from these or reads 0 from 0.5.
TEST_CASE("numbers become text and text becomes numbers without functions that follow the locale",
          "[layering]") {
  static const std::regex kFollowsLocale(
      R"(\b(strtod|strtof|strtold|stod|stof|stold|atof|sscanf|wcstod)\s*\(|printf\s*\([^;]*%[-+ #0-9.*]*[aefgAEFG])");
  const auto follows_locale = [](const std::string& line) {
    const std::string code = line.substr(0, line.find("//"));
    const auto has = [&](const char* word) { return code.find(word) != std::string::npos; };
    const bool is_near = has("printf") || has("sto") || has("strto") || has("ato") || has("scanf");
    return is_near && std::regex_search(code, kFollowsLocale);
  };
  REQUIRE(follows_locale("std::snprintf(text, 9, \"%.*g\", digits, value);"));
  REQUIRE(follows_locale("return std::stod(cell);"));
  REQUIRE_FALSE(follows_locale("fmt::format(\"{:g}\", value);"));
  for (const auto& [path, file] : tree().files) {
    CAPTURE(path);
    for (const std::string& line : lines_of(file.text)) {
      CAPTURE(line);
      CHECK_FALSE(follows_locale(line));
    }
  }
}

TEST_CASE("two files include the header of the HTTP library, which is expensive to compile",
          "[layering]") {
  std::vector<std::string> places;
  for (const auto& [path, file] : tree().files) {
    for (const std::string& include : file.outside_includes) {
      if (include == "httplib.h") places.push_back(path);
    }
  }
  CHECK(places ==
        std::vector<std::string>{"io/serve/deadline_server.h", "io/serve/page_server.cpp"});
}

TEST_CASE("what x.h declares is defined in x.cpp or in a file of that room without a header",
          "[layering]") {
  std::map<std::string, std::set<std::string>> declared_in, class_in;  // headers by name
  for (const auto& [path, file] : tree().files) {
    if (!has_suffix(path, ".h")) continue;
    const Declarations found = declarations_in(file.text);
    for (const std::string& name : found.functions) declared_in[name].insert(path);
    for (const std::string& name : found.classes) class_in[name].insert(path);
  }
  REQUIRE(declared_in.size() > 500);
  const auto is_in_place = [&](const std::string& source, const std::string& header) {
    if (without_suffix(source) == without_suffix(header)) return true;
    return folder_of(source) == folder_of(header) &&
           tree().files.count(without_suffix(source) + ".h") == 0;
  };
  int checked = 0;
  for (const auto& [path, file] : tree().files) {
    // What the system and Python call by name: main() and PYBIND11_MODULE.
    const bool is_entry = has_suffix(path, "/main.cpp") || path == "io/python/core.cpp";
    if (!has_suffix(path, ".cpp") || is_entry) continue;
    CAPTURE(path);
    const std::string& source = path;  // clang 14 captures no structured bindings
    const Definitions found = definitions_in(file.text);
    const auto check = [&](const std::set<std::string>& names, const auto& headers) {
      for (const std::string& name : names) {
        CAPTURE(name);
        const auto place = headers.find(name);
        ++checked;
        CHECK(place != headers.end());  // else defined for others, but no header declares it
        if (place == headers.end()) continue;
        CHECK(std::any_of(place->second.begin(), place->second.end(),
                          [&](const std::string& header) { return is_in_place(source, header); }));
      }
    };
    check(found.functions, declared_in);
    check(found.classes, class_in);
  }
  CHECK(checked > 500);
}

// A linker keeps one of two classes of the same name, and the members of the other are lost without a word.
TEST_CASE("no two headers define a class of the same name", "[layering]") {
  std::map<std::string, std::set<std::string>> headers;
  for (const auto& [path, file] : tree().files) {
    if (!has_suffix(path, ".h")) continue;
    for (const std::string& name : declarations_in(file.text).classes) headers[name].insert(path);
  }
  REQUIRE(headers.size() > 500);
  for (const auto& [name, places] : headers) {
    CAPTURE(name, words_of(places));
    CHECK(places.size() == 1);
  }
}

TEST_CASE("declarations and definitions are found in C++ text", "[layering]") {
  const Declarations header = declarations_in(R"(
#define MACRO(x) x
namespace viscard {
// void commented(int x);
struct Box { int side() const; int volume() { return 1; } };
double area_m2(const Box& box, double scale = 1.0);
inline double twice(double x) { return 2.0 * x; }
template <typename T> T half(T x) { return x / 2; }
inline constexpr double kPi = 3.14;
const char* text();  // "void in_string(int);"
}  // namespace viscard
)");
  CHECK(header.functions == std::set<std::string>{"area_m2", "text"});
  CHECK(header.classes == std::set<std::string>{"Box"});
  const Definitions source = definitions_in(R"(
namespace viscard {
namespace {
double hidden(double x) { return x; }
const double kTable[] = {1.0, 2.0};
}  // namespace
int Box::side() const { if (true) { return 1; } return 2; }
double area_m2(const Box& box, double scale) { return hidden(scale); }
}  // namespace viscard
)");
  CHECK(source.functions == std::set<std::string>{"area_m2"});
  CHECK(source.classes == std::set<std::string>{"Box"});
}

TEST_CASE("each room has a README that says what lives there and what it may include",
          "[layering]") {
  for (const auto& [folder, room] : tree().rooms) {
    CAPTURE(folder);
    REQUIRE(room.readme.size() >= 2);
    CHECK(room.readme[0].rfind("# " + folder + ": ", 0) == 0);
    CHECK(room.readme[1].rfind("May include: ", 0) == 0);
    CHECK(words_of(rooms_in_readme(room.readme[1])) == words_of(room.uses));
  }
}

}  // namespace viscard
