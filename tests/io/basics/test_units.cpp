#include "io/basics/number_text.h"
#include "io/basics/units.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>
#include <numbers>
#include <random>
#include <thread>
#include <vector>

namespace viscard {
namespace {

std::string error_of(const char* text, const char* si_unit) {
  try {
    si_from_text(text, si_unit);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST_CASE("quantities with a unit become SI exactly as the decimal number says", "[io][units]") {
  // Equality on purpose: a value written in another decimal unit is the same double as in SI.
  CHECK(si_from_text("40 um", "m") == 40e-6);
  CHECK(si_from_text("40 µm", "m") == 40e-6);  // U+00B5
  CHECK(si_from_text("40 μm", "m") == 40e-6);  // U+03BC
  CHECK(si_from_text("0.13 mm", "m") == 0.13e-3);
  CHECK(si_from_text("1.88 MPa", "Pa") == 1.88e6);
  CHECK(si_from_text("2.5e-3 mm", "m") == 2.5e-6);
  CHECK(si_from_text("2.5E+3 nm", "m") == 2.5e-6);
  CHECK(si_from_text("10 kPa", "Pa") == 10e3);
  CHECK(si_from_text("0.7255 V/N", "V/N") == 0.7255);
  CHECK(si_from_text("1.8 MPa", "Pa") == 1.8e6);
  CHECK(si_from_text("965 kg/m3", "kg/m3") == 965.0);
  CHECK(si_from_text("965 kg/m^3", "kg/m3") == 965.0);
  CHECK(si_from_text("4.4mm", "m") == 4.4e-3);
  CHECK(si_from_text("10 N/mm", "N/m") == 10e3);
  CHECK(si_from_text("3200 steps/mm", "1/m") == 3.2e6);
  CHECK(si_from_text("80 SPS", "Hz") == 80.0);
  CHECK(si_from_text(" -1e-3 ", "m") == -1e-3);
  CHECK(si_from_text("+2.5", "s") == 2.5);
  CHECK(si_from_text("2 %", "1") == 0.02);
}

TEST_CASE("a gram-force is the weight of a gram in standard gravity", "[io][units]") {
  // Standard gravity 9.80665 m/s2, 3rd CGPM 1901. 1e-15: one rounding of the product.
  CHECK(si_from_text("250 gf", "N") == Approx(0.250 * 9.80665).epsilon(1e-15));
  CHECK(si_from_text("1 kgf", "N") == Approx(9.80665).epsilon(1e-15));
}

TEST_CASE("temperatures carry their offset", "[io][units]") {
  // 1e-12 K: the offset 273.15 costs the last digits.
  CHECK(si_from_text("23 C", "degC") == Approx(23.0).margin(1e-12));
  CHECK(si_from_text("23 °C", "degC") == Approx(23.0).margin(1e-12));
  CHECK(si_from_text("296.15 K", "degC") == Approx(23.0).margin(1e-12));
  CHECK(si_from_text("73.4 degF", "degC") == Approx(23.0).margin(1e-12));
}

TEST_CASE("radians per second become hertz through two pi", "[io][units]") {
  CHECK(scale_to_si("rad/s", "Hz").factor == Approx(0.5 / std::numbers::pi).epsilon(1e-15));
  CHECK(scale_to_si("1/s", "Hz").factor == 1.0);
  CHECK(scale_to_si("kHz", "Hz").factor == Approx(1e3).epsilon(1e-15));
}

TEST_CASE("units of table headers give the scale to SI", "[io][units]") {
  CHECK(scale_to_si("MPa", "Pa").factor == 1e6);
  CHECK(scale_to_si("nN", "N").factor == Approx(1e-9).epsilon(1e-15));
  CHECK(scale_to_si("1/MPa", "1/Pa").factor == Approx(1e-6).epsilon(1e-15));
  CHECK(scale_to_si("-", "1").factor == 1.0);
  CHECK(is_unit("MPa"));
  CHECK(is_unit("-"));
  CHECK_FALSE(is_unit("specimen"));
  CHECK_FALSE(is_unit_of("MPa", "N"));
  CHECK_FALSE(is_unit_of("s", "Hz"));
}

TEST_CASE("a text that is not a quantity is refused with the text, the unit and an example",
          "[io][units]") {
  CHECK(error_of("40 MPa", "m") == "'MPa' is not a unit of m; write it like \"40 um\"");
  CHECK(error_of("40 furlongz", "m") ==
        "'furlongz' is not a known unit (capitals matter); expected a unit of m; write it like "
        "\"40 um\"");
  CHECK(error_of("250 g", "N").find("gf or kgf") != std::string::npos);
  CHECK(error_of("4,4 mm", "m").find("decimal sign here is a point") != std::string::npos);
  CHECK(error_of("thick", "m").find("does not begin with a number") != std::string::npos);
  CHECK(error_of("", "m").find("does not begin with a number") != std::string::npos);
  CHECK(error_of("nan mm", "m").find("not a finite number") != std::string::npos);
  CHECK(error_of("1e999 mm", "m").find("not a finite number") != std::string::npos);
}

TEST_CASE("a number written as text reads back as the same double", "[io][units]") {
  std::mt19937_64 bits(7);
  for (int i = 0; i < 10000; ++i) {
    const std::uint64_t pattern = bits();
    double value = 0.0;
    std::memcpy(&value, &pattern, sizeof value);
    if (!std::isfinite(value)) continue;
    REQUIRE(si_from_text(text_from_number(value), "m") == value);
  }
}

TEST_CASE("units are read in any locale and from several threads", "[io][units]") {
  const char* before = std::setlocale(LC_ALL, nullptr);
  const std::string saved = before;
  std::setlocale(LC_ALL, "de_DE.UTF-8");  // stays as it was where that is not installed
  std::vector<std::thread> threads;
  std::vector<int> wrong(4, 0);
  for (int thread = 0; thread < 4; ++thread) {
    threads.emplace_back([&wrong, thread] {
      for (int i = 0; i < 500; ++i) {
        if (si_from_text("0.5 mm/s", "m/s") != 0.5e-3) ++wrong[static_cast<std::size_t>(thread)];
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  std::setlocale(LC_ALL, saved.c_str());
  CHECK(wrong == std::vector<int>(4, 0));
}

}  // namespace
}  // namespace viscard
