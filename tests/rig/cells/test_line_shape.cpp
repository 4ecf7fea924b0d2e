#include "rig/cells/line_shape.h"

#include <catch2/catch.hpp>

#include <string>

namespace viscard {

TEST_CASE("a line is recognised by the shape of all lines before it", "[rig]") {
  CHECK(shape_of_line("Load_cell output val: -12.30") ==
        shape_of_line("Load_cell output val: 7.99"));
  CHECK(shape_of_line("12.30") != shape_of_line("12.3"));
  CHECK(shape_of_line("1000,84213") == shape_of_line("99,-3"));
  CHECK(shape_of_line("1000,84.13") != shape_of_line("1000,84213"));
  LineShape shape;
  for (int i = 0; i < 64; ++i) REQUIRE(shape.fits("val: " + std::to_string(i) + ".25"));
  CHECK(shape.fits("val: -123.99"));
  CHECK_FALSE(shape.fits("val: 12.3"));
  CHECK_FALSE(shape.fits("vbl: 12.30"));
  CHECK(shape.fits("val: 12.30"));
}

TEST_CASE("a stream whose lines differ by nature is not judged by their shape", "[rig]") {
  LineShape shape;
  for (int i = 0; i < 63; ++i) REQUIRE(shape.fits("1.25"));
  REQUIRE(shape.fits("1.2"));  // this device prints no zeros at the end
  for (int i = 0; i < 100; ++i) REQUIRE(shape.fits("1.25"));
  CHECK(shape.fits("1.5"));
}

}  // namespace viscard
