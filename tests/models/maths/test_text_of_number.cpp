#include "models/maths/leading_number.h"
#include "models/maths/text_of_number.h"

#include <catch2/catch.hpp>

#include <clocale>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <utility>

namespace viscard {

TEST_CASE("numbers are read and written as text without regard to the locale", "[models]") {
  CHECK(number_from_text(" +1.25 ").value() == 1.25);
  CHECK(number_from_text("-0.00").value() == 0.0);
  for (const char* bad : {"", "1,25", "1.2.3", "nan", "inf", "0x10", "12a", "--1"}) {
    INFO(bad);
    CHECK_FALSE(number_from_text(bad));
  }
  CHECK(text_from_number(-0.0001, 3) == "0.000");
  CHECK(text_from_number(-1.23456789, 5) == "-1.23457");
}

TEST_CASE("a number at the beginning of a text is read as strtod reads it", "[models]") {
  const auto both = [](const std::string& text) {
    std::string_view rest;
    const double value = leading_number(text, &rest);
    return std::pair(value, std::string(rest));
  };
  CHECK(both("1.25 to 7") == std::pair(1.25, std::string(" to 7")));
  CHECK(both(" +2e3Pa") == std::pair(2000.0, std::string("Pa")));
  CHECK(both("-0.5") == std::pair(-0.5, std::string()));
  CHECK(both("1,5") == std::pair(1.0, std::string(",5")));
  CHECK(both("+-5") == std::pair(0.0, std::string("+-5")));
  CHECK(both("Pa") == std::pair(0.0, std::string("Pa")));
  CHECK(both("") == std::pair(0.0, std::string()));
  CHECK(std::isnan(leading_number("nan")));
  for (const char* extreme : {"1e400", "-1e400", "1e-400", "-2.5e-400", "4.9e-324", "2e308"}) {
    INFO(extreme);
    CHECK(leading_number(extreme) == std::strtod(extreme, nullptr));
  }
}

TEST_CASE("the language of the computer changes no text of a number", "[models]") {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "nl_NL.UTF-8"}) {
    std::setlocale(LC_ALL, name);  // stays as it was where that is not installed
    const std::string short_text = text_of(0.0461), scpi = scpi_text(-1.88, 3);
    const double read = leading_number("0.5 s");
    std::setlocale(LC_ALL, before.c_str());
    INFO(name);
    CHECK(short_text == "0.0461");
    CHECK(scpi == "-1.880E+00");
    CHECK(read == 0.5);
  }
  CHECK(text_of(-1e-14) == "-1e-14");
  CHECK(text_of(123456789.0) == "1.23457e+08");
  CHECK(text_of(std::numeric_limits<double>::infinity()) == "inf");
  CHECK(scpi_text(9.9e37, 8) == "+9.90000000E+37");
}

}  // namespace viscard
