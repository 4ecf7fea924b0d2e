#include "tests/layering/source_tree.h"

#include <catch2/catch.hpp>

#include <fstream>
#include <regex>
#include <sstream>

namespace viscard {
namespace {

// The longest folder with a box of its own that a room lies in; "" if there is none.
std::string box_of(const std::string& room, const std::set<std::string>& boxes) {
  for (std::string folder = room;; folder = folder_of(folder)) {
    if (boxes.count(folder) > 0) return folder;
    if (folder.find('/') == std::string::npos) return "";
  }
}

}  // namespace

// .ci/draw_architecture draws the picture from the lists behind USES and leaves out arrows that follow
// from others.
TEST_CASE("the architecture picture shows the rooms in at most 35 boxes and all that they include",
          "[layering]") {
  std::ifstream in(VISCARD_SOURCE_DIR "/data/pictures/architecture.svg");
  REQUIRE(in);
  std::ostringstream text;
  text << in.rdbuf();
  const std::string svg = text.str();

  static const std::regex kBox(R"(<title>((?:models|fit|rig|io)(?:/\w+)*)</title>)");
  std::set<std::string> boxes;
  for (std::sregex_iterator i(svg.begin(), svg.end(), kBox), end; i != end; ++i) {
    boxes.insert((*i)[1]);
  }
  CHECK(boxes.size() <= 35);

  static const std::regex kArrow(R"(<title>([\w/]+)&#45;&gt;([\w/]+)</title>)");
  Graph drawn, expected;
  for (const std::string& box : boxes) drawn[box];
  for (std::sregex_iterator i(svg.begin(), svg.end(), kArrow), end; i != end; ++i) {
    drawn[(*i)[1]].insert((*i)[2]);
  }
  CHECK(nodes_on_circles(drawn).empty());

  for (const auto& [folder, room] : read_source_tree(VISCARD_SOURCE_DIR).rooms) {
    CAPTURE(folder);
    const std::string box = box_of(folder, boxes);
    CHECK_FALSE(box.empty());
    for (const std::string& used : room.uses) {
      if (box_of(used, boxes) != box) expected[box].insert(box_of(used, boxes));
    }
    expected[box];
  }
  CHECK(closure(drawn) == closure(expected));
}

}  // namespace viscard
