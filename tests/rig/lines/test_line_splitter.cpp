#include "rig/lines/line_splitter.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

namespace viscard {
namespace {

std::vector<std::string> lines_of(LineSplitter& splitter) {
  std::vector<std::string> lines;
  while (auto line = splitter.next()) lines.push_back(line->text);
  return lines;
}

}  // namespace

TEST_CASE("a line ends at CR, LF, CRLF or LFCR, at any split of the bytes", "[rig]") {
  const std::string terminator = GENERATE("\r", "\n", "\r\n", "\n\r");
  const std::string stream = "one" + terminator + "two" + terminator + "three" + terminator;
  for (std::size_t at = 0; at <= stream.size(); ++at) {
    LineSplitter splitter;
    splitter.feed(stream.substr(0, at), 0.0);
    splitter.feed(stream.substr(at), 1.0);
    CHECK(lines_of(splitter) == std::vector<std::string>{"one", "two", "three"});
  }
}

TEST_CASE("an empty line is a line, but the second character of a terminator makes none", "[rig]") {
  LineSplitter splitter;
  splitter.feed("\r\n\r\nok\r\n", 0.0);
  CHECK(lines_of(splitter) == std::vector<std::string>{"", "", "ok"});
  LineSplitter bare;
  bare.feed("a\n\nb\n", 0.0);
  CHECK(lines_of(bare) == std::vector<std::string>{"a", "", "b"});
}

TEST_CASE("a mebibyte without a line end is dropped, and the line after it is read", "[rig]") {
  LineSplitter splitter(256);
  const std::string block(4096, 'x');
  for (int i = 0; i < 256; ++i) splitter.feed(block, 0.0);
  splitter.feed("\nnext\n", 0.0);
  CHECK(splitter.n_overlong() == 1);
  CHECK(lines_of(splitter) == std::vector<std::string>{"next"});
}

TEST_CASE("lines of one read arrived earlier by the wire time of the bytes after them", "[rig]") {
  LineSplitter splitter;
  splitter.feed("12345678\nabcdefgh\n", 10.0, 1e-3);
  const auto first = splitter.next();
  const auto second = splitter.next();
  REQUIRE(first);
  REQUIRE(second);
  CHECK(first->time_s == Approx(10.0 - 9e-3).margin(1e-12));  // nine bytes follow: rounding only
  CHECK(second->time_s == 10.0);
}

TEST_CASE("NULs and bytes above 127 count as unprintable, but text does not", "[rig]") {
  LineSplitter noise;
  noise.feed(std::string("\x00\xff\x80\xfe", 4), 0.0);
  CHECK(noise.unprintable_fraction() == 1.0);
  LineSplitter text;
  text.feed("123,\t456\r\n", 0.0);
  CHECK(text.unprintable_fraction() == 0.0);
}

}  // namespace viscard
