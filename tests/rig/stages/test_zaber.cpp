#include "rig/stages/zaber_stage.h"
#include "tests/rig/device_fixture.h"

#include <catch2/catch.hpp>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

EmulatedRigOptions zaber_rig() {
  return DeviceFixture::options("zaber");
}

}  // namespace

TEST_CASE("Zaber checksums agree with the ones printed for known messages", "[rig]") {
  CHECK(zaber_checksum("1 0 get pos") == "AD");
  CHECK(zaber_checksum("01 0 OK IDLE -- 0") == "8D");
  CHECK(zaber_checksum("1 1 move rel 1000") == "63");
  CHECK(format_zaber_command(1, 1, 7, "get pos") ==
        "/1 1 07 get pos:" + zaber_checksum("1 1 07 get pos") + "\n");
}

TEST_CASE("Zaber replies, alerts and infos are distinguished, with and without id and checksum",
          "[rig]") {
  const auto reply = parse_zaber_message("@01 1 12 RJ IDLE WR BADDATA");
  REQUIRE(reply.has_value());
  CHECK(reply->is_rejected);
  CHECK(reply->id == 12);
  CHECK(reply->flag == "WR");
  CHECK(reply->data == "BADDATA");
  const auto plain = parse_zaber_message("@01 0 OK BUSY -- 0:8D");  // checksum of another text
  CHECK_FALSE(plain.has_value());
  const auto checked = parse_zaber_message("@01 0 OK IDLE -- 0:8D");
  REQUIRE(checked.has_value());
  CHECK_FALSE(checked->id.has_value());
  CHECK(checked->data == "0");
  const auto alert = parse_zaber_message("!03 2 IDLE FS");
  REQUIRE(alert.has_value());
  CHECK(alert->kind == ZaberMessage::Kind::kAlert);
  CHECK(alert->device == 3);
  CHECK(is_zaber_fault(alert->flag));
  const auto info = parse_zaber_message("#01 1 07 limit\tinfo \\");
  REQUIRE(info.has_value());
  CHECK(info->is_continued);
  CHECK(parse_zaber_message("garbage@01 1 05 OK BUSY NI -42")->data == "-42");
  for (const char* text : {"", "@", "@01", "@01 1", "@01 1 OK", "@01 1 05 OK IDLE", "/1 1 get pos",
                           "@x1 1 OK IDLE -- 0", "@01 1 MAYBE IDLE -- 0", "@01 1 OK LAZY -- 0"}) {
    INFO(text);
    CHECK_FALSE(parse_zaber_message(text).has_value());
  }
}

TEST_CASE("Zaber speeds and accelerations survive the conversion to data units", "[rig]") {
  CHECK(zaber_speed_data(10000.0) == 16384);
  CHECK(microsteps_s_from_zaber(16384.0) == Approx(10000.0).epsilon(1e-12));
  CHECK(microsteps_s2_from_zaber(1.6384) == Approx(10000.0).epsilon(1e-12));
}

TEST_CASE("a Zaber stage reports its dynamics and reaches its target at the speed asked for",
          "[rig][pty]") {
  EmulatedRigOptions options = zaber_rig();
  SECTION("as it comes") {}
  SECTION("with alerts, a talking neighbour and no checksums") {
    options.zaber = {.sends_checksums = false, .sends_alerts = true, .has_neighbour = true};
  }
  SECTION("with lost and garbled replies") {
    options.zaber = {.lose_reply_every = 5, .garble_reply_every = 7};
  }
  SECTION("mounted the other way round, slow to answer") {
    options.config.stage.toward_specimen = 1;
    options.zaber.reply_delay_s = 0.2;
  }
  DeviceFixture rig(options);
  rig.devices.stage->connect(rig.pump());
  const StageDynamics dynamics = rig.devices.stage->dynamics();
  CHECK(dynamics.steps_per_m == Approx(3200e3).epsilon(1e-9));
  CHECK(dynamics.max_speed_m_s == Approx(10e-3).epsilon(1e-4));    // whole data units
  CHECK(dynamics.acceleration_m_s2 == Approx(0.2).epsilon(0.02));  // 105 data units
  REQUIRE(rig.move(0.5e-3, 0.25e-3));
  REQUIRE(rig.move(0.3e-3, 2e-3));
  CHECK(rig.emulated.outcome().final_position_m == Approx(0.3e-3).margin(1e-9));
  CHECK(rig.devices.stage->position_m() == Approx(0.3e-3).margin(1e-9));
  const auto moves = rig.all<CommandedMove>();
  REQUIRE(moves.size() == 2);
  CHECK(moves[0].move.to_m == Approx(0.5e-3).margin(1e-9));
  CHECK(moves[0].move.speed_m_s == Approx(0.25e-3).epsilon(1e-3));
  CHECK(moves[1].move.from_m == Approx(0.5e-3).margin(1e-9));
}

TEST_CASE("a Zaber stage stops gently or at once and can be moved again", "[rig][pty]") {
  EmulatedRigOptions options = zaber_rig();
  options.zaber.knows_estop = GENERATE(true, false);
  DeviceFixture rig(options);
  Stage& stage = *rig.devices.stage;
  stage.connect(rig.pump());
  stage.begin_move(2e-3, 1e-3, "approach");
  rig.pump_for(0.3);
  stage.stop_soft();
  while (stage.is_moving()) rig.pump()();
  const double stopped_m = stage.position_m();
  CHECK(stopped_m > 0.1e-3);
  CHECK(stopped_m < 1.0e-3);
  CHECK(rig.all<CommandedMove>().back().move.to_m == Approx(stopped_m).margin(1e-12));
  stage.begin_move(2e-3, 1e-3, "approach");
  rig.pump_for(0.2);
  stage.stop_hard();
  stage.recover(rig.pump());
  CHECK_FALSE(stage.is_moving());
  CHECK(stage.position_m() < 1.9e-3);
  REQUIRE(rig.move(0.0, 2e-3));
}

TEST_CASE("a Zaber stage without a reference position is refused unless it may home",
          "[rig][pty]") {
  EmulatedRigOptions options = zaber_rig();
  options.zaber.has_reference = false;
  SECTION("refused") {
    DeviceFixture rig(options);
    CHECK_THROWS_WITH(rig.devices.stage->connect(rig.pump()), Contains("home"));
  }
  SECTION("homed") {
    options.config.stage.home = true;
    DeviceFixture rig(options);
    rig.devices.stage->connect(rig.pump());
    CHECK(rig.move(0.2e-3, 1e-3));
  }
}

TEST_CASE("a Zaber stage without microstep in the rig file is refused with the place to find it",
          "[rig]") {
  RigConfig rig;
  rig.stage.driver = "zaber";
  rig.stage.port = "/dev/null";
  const RigClock clock;
  struct NoTransport final : Transport {
    std::string name() const override { return "none"; }
    int baud() const override { return 1; }
    int descriptor() const override { return -1; }
    Chunk read_available() override { return {}; }
    void write(std::string_view, double) override {}
  } transport;
  CHECK_THROWS_WITH(make_stage(transport, rig.stage, clock, [](const RunRecord&) {}),
                    Contains("microstep"));
  rig.stage.driver = "zabre";
  CHECK_THROWS_WITH(make_stage(transport, rig.stage, clock, [](const RunRecord&) {}),
                    Contains("grbl, zaber"));
}

}  // namespace viscard
