#include "tests/layering/source_tree.h"

#include <catch2/catch.hpp>

#include <fstream>
#include <regex>
#include <sstream>

namespace viscard {

// .ci/draw_architecture draws the picture from the CMake targets and leaves out arrows that follow
// from others.
TEST_CASE("the architecture picture shows the rooms and arrows of the CMake targets",
          "[layering]") {
  std::ifstream in(VISCARD_SOURCE_DIR "/data/pictures/architecture.svg");
  REQUIRE(in);
  std::ostringstream text;
  text << in.rdbuf();
  const std::string svg = text.str();
  static const std::regex kArrow(R"(<title>([\w/]+)&#45;&gt;([\w/]+)</title>)");
  Graph drawn;
  for (std::sregex_iterator i(svg.begin(), svg.end(), kArrow), end; i != end; ++i) {
    drawn[(*i)[1]].insert((*i)[2]);
  }
  const SourceTree tree = read_source_tree(VISCARD_SOURCE_DIR);
  for (const auto& [folder, room] : tree.rooms) {
    CAPTURE(folder);
    CHECK(svg.find("<title>" + folder + "</title>") != std::string::npos);
    drawn[folder];
  }
  CHECK(closure(drawn) == closure(graph_of_rooms(tree)));
}

}  // namespace viscard
