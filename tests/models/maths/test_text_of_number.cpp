#include "models/maths/text_of_number.h"

#include <catch2/catch.hpp>

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

}  // namespace viscard
