#include "rig/protocols/apt_protocol.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <string>

namespace viscard {
namespace {

std::string bytes_of(const std::string& hex) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 3) {
    bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  }
  return bytes;
}

std::optional<AptMessage> only_message(const std::string& hex) {
  AptSplitter splitter;
  splitter.feed(bytes_of(hex), 1.0, 0.5);
  return splitter.next();
}

const std::string kAtRest = "91 04 0e 00 81 50 01 00 80 21 00 00 00 00 00 00 00 35 00 80";

}  // namespace

TEST_CASE("APT commands have the documented bytes", "[rig]") {
  CHECK(format_apt(apt::kAskInfo, 0, 0) == bytes_of("05 00 00 00 50 01"));
  CHECK(format_apt(apt::kEnable, 1, 1) == bytes_of("10 02 01 01 50 01"));
  CHECK(format_apt(apt::kGoHome, 1, 0) == bytes_of("43 04 01 00 50 01"));
  CHECK(format_apt(apt::kStop, 1, apt::kAtOnce) == bytes_of("65 04 01 01 50 01"));
  CHECK(format_apt(apt::kStop, 1, apt::kWithRamp) == bytes_of("65 04 01 02 50 01"));
  CHECK(format_apt_move(34304) == bytes_of("53 04 06 00 d0 01 01 00 00 86 00 00"));
  CHECK(format_apt_move(-8576) == bytes_of("53 04 06 00 d0 01 01 00 80 de ff ff"));
  CHECK(format_apt_velocity({131, 38368}) ==
        bytes_of("13 04 0e 00 d0 01 01 00 00 00 00 00 83 00 00 00 e0 95 00 00"));
}

TEST_CASE("APT speeds and accelerations have the documented words", "[rig]") {
  const AptUnits servo = *apt_units("KDC101");
  CHECK_FALSE(servo.is_stepper);
  CHECK(std::llround(34304 * servo.speed_word) == 767367);
  CHECK(std::llround(34304 * servo.acceleration_word) == 262);
  CHECK(std::llround(34554.96 * servo.speed_word) == 772981);
  CHECK(std::llround(34554.96 * servo.acceleration_word) == 264);
  CHECK(std::llround(24600 * servo.speed_word) == 550293);
  CHECK(std::llround(24600 * servo.acceleration_word) == 188);
  const AptUnits stepper = *apt_units("LTS150");
  CHECK(stepper.is_stepper);
  CHECK(std::llround(0.05 * 409600 * stepper.speed_word) == 1099366);
  CHECK(std::llround(0.5 * 409600 * stepper.acceleration_word) == 2253);
  CHECK(apt_units("TST001")->speed_word == 1.0);
  CHECK_FALSE(apt_units("KPZ101"));
}

TEST_CASE("an APT status is read for servos and steppers", "[rig]") {
  const auto status = parse_apt_status(*only_message(kAtRest));
  REQUIRE(status);
  CHECK(status->position == 8576);
  CHECK(status->bits == 0x80003500U);
  CHECK((status->bits & apt::kMoving) == 0);
  CHECK((status->bits & apt::kIsHomed) != 0);
  CHECK((status->bits & apt::kIsEnabled) != 0);
  const auto stepper = parse_apt_status(
      *only_message("81 04 0e 00 81 50 01 00 00 70 fe ff 00 00 00 00 10 04 00 80"));
  REQUIRE(stepper);
  CHECK(stepper->position == -102400);
  CHECK((stepper->bits & apt::kMoving) != 0);
  const auto other_channel =
      only_message("91 04 0e 00 81 50 02 00 80 21 00 00 00 00 00 00 00 35 00 80");
  CHECK_FALSE(parse_apt_status(*other_channel));
  CHECK_FALSE(parse_apt_velocity(*other_channel));
}

TEST_CASE("an APT unit names itself", "[rig]") {
  std::string data = bytes_of("a1 86 9c 01 4b 44 43 31 30 31 00 00 10 00 05 01 02 00");
  data.resize(84, '\0');
  AptSplitter splitter;
  splitter.feed(format_apt(apt::kInfo, data, true), 0.0, 0.5);
  const auto info = parse_apt_info(splitter.next().value());
  REQUIRE(info);
  CHECK(info->model == "KDC101");
  CHECK(info->serial == 27035297U);
  CHECK(info->firmware == "2.1.5");
}

TEST_CASE("APT messages are found however reads split them, and after lost bytes", "[rig]") {
  const std::string event = bytes_of("64 04 01 00 01 50"), status = bytes_of(kAtRest);
  AptSplitter splitter;
  SECTION("one byte at a time") {
    for (const char c : event + status) splitter.feed(std::string(1, c), 1.0, 0.5);
    CHECK(splitter.n_skipped() == 0);
  }
  SECTION("behind garbage, and behind the rest of a message") {
    splitter.feed("\x01Hello" + status.substr(9) + event + status, 1.0, 0.5);
    CHECK(splitter.n_skipped() == 17);
  }
  SECTION("behind a message whose rest never came") {
    splitter.feed(status.substr(0, 11), 0.0, 0.5);
    splitter.feed(event + status, 1.0, 0.5);
    CHECK(splitter.n_skipped() == 11);
  }
  CHECK(splitter.next().value().id == apt::kMoveCompleted);
  CHECK(splitter.next().value().id == apt::kServoStatus);
  CHECK_FALSE(splitter.next());
}

TEST_CASE("what no APT unit sends is no message", "[rig]") {
  for (const char* hex :
       {"91 04 0e 00 81 51 01 00 80 21 00 00 00 00 00 00 00 35 00 80",     // source
        "91 04 0f 00 81 50 01 00 80 21 00 00 00 00 00 00 00 35 00 80 00",  // length
        "99 09 01 00 01 50", "53 04 06 00 d0 01 01 00 00 86 00 00"}) {
    INFO(hex);
    CHECK_FALSE(only_message(hex));
  }
}

}  // namespace viscard
