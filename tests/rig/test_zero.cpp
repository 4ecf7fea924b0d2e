// The zero of positions, which a stage keeps or not, and the zero of an instrument's own.
#include "rig/cells/gauge_load_cell.h"
#include "rig/emulator/pty_port.h"
#include "rig/lines/rig_error.h"
#include "rig/lines/serial_line.h"
#include "rig/zero_force.h"
#include "tests/rig/device_fixture.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

EmulatedRigOptions with_instrument(const std::string& driver) {
  EmulatedRigOptions options = DeviceFixture::options("grbl", driver);
  options.truth.sample_rate_Hz = 40.0;
  options.truth.force_offset_N = 0.05;
  options.config.load_cell.expected_rate_Hz = 40.0;
  return options;
}

ZeroedForce zeroed_on(DeviceFixture& bench) {
  return zero_force(*bench.devices.load_cell, bench.config, bench.clock, nullptr);
}

// At the second connection: at the first one every board has just been switched on.
std::string trouble_on(const EmulatedRigOptions& options) {
  EmulatedRig emulated(options);
  const RigConfig config = emulated.config();
  const RigClock clock = emulated.clock();
  std::string trouble;
  for (int i = 0; i < 2; ++i) {
    if (i > 0) wait_readable({}, clock, 0.5);  // so that the emulator sees the port closed
    SerialLine line(config.stage.port, 115200, clock);
    const auto stage = make_stage(line, config.stage, clock, [](const RunRecord&) {});
    stage->keep_locked();
    stage->connect([&] {
      wait_readable({&line}, clock, 0.002);
      stage->service();
    });
    trouble = stage->trouble_with_zero();
  }
  return trouble;
}

// Why an instrument is not zeroed that sends these lines, one by one, once it was asked to; empty: it
// is zeroed.
std::string refusal_of(const std::string& driver, const std::vector<std::string>& lines) {
  PtyPort device;
  const RigClock clock;
  SerialLine line(device.path(), 115200, clock);
  LoadCellConfig config;
  config.driver = driver;
  GaugeLoadCell cell(line, config, clock, [](const RunRecord&) {});
  std::string received;
  std::size_t n_sent = 0;
  const Pump pump = [&] {
    received += device.read_available();
    if (!received.empty() && n_sent < lines.size()) device.write(lines[n_sent++]);
    wait_readable({&line}, clock, 0.005);
    cell.service();
  };
  try {
    cell.set_zero(pump);
  } catch (const RigError& error) {
    return error.what();
  }
  return "";
}

// A GRBL on a board with native USB, homed since it was switched on.
EmulatedRigOptions homed_grbl() {
  EmulatedRigOptions options = DeviceFixture::options();
  options.grbl.is_homing_enabled = options.grbl.has_hard_limits = true;
  options.grbl.is_homed = true;
  options.resets_on_open = false;
  return options;
}

TEST_CASE("a balance or gauge makes the force at rest its own zero", "[rig][pty]") {
  const std::string driver = GENERATE("mark10", "mt-sics", "sartorius");
  CAPTURE(driver);
  DeviceFixture bench(with_instrument(driver));
  const ZeroedForce zeroed = zeroed_on(bench);
  CHECK(zeroed.before_N == Approx(0.05).margin(0.005));
  CHECK(zeroed.after_N == Approx(0.0).margin(0.005));
}

TEST_CASE("a force that is no rest, a refusal, and a cell without its own zero are not zeroed",
          "[rig][pty]") {
  EmulatedRigOptions options = with_instrument("mark10");
  std::string expected;
  SECTION("a weight hangs on it") {
    options.truth.force_offset_N = 0.4;
    expected = "Take away what presses on it";
  }
  SECTION("the gauge has no such command") {
    options.gauge.has_no_zero = true;
    expected = "it answered '*10'";
  }
  SECTION("a bare amplifier") {
    options = DeviceFixture::options();
    expected = "driver 'hx711' has no zero that this program can set";
  }
  DeviceFixture bench(options);
  CHECK_THROWS_WITH(zeroed_on(bench), Contains(expected));
}

TEST_CASE("a late reading, or the echo of an adapter, is no answer to the command for zero",
          "[rig][pty]") {
  const char* kBalance = "S D      1.234 g\r\n";
  CHECK(refusal_of("mark10", {"Z\r\n", "1.23 N\r\n", "1.2?3 N\r\n"}) == "");  // it sends no answer
  CHECK(refusal_of("sartorius", {"+    1.234 g  \r\n", "+  ? 1.235 g  \r\n", "--\r\n"}) == "");
  CHECK(refusal_of("mt-sics", {"ZI\r\n", kBalance, "S I\r\n", "S -\r\n", "S S Error 10b\r\n",
                               "S D   1.2?4 g\r\n", "ZI D\r\n"}) == "");
  CHECK_THAT(refusal_of("mt-sics", {kBalance}), Contains("it did not answer"));
  CHECK_THAT(refusal_of("mt-sics", {kBalance, "ZI I\r\n"}), Contains("it answered 'ZI I'"));
  CHECK_THAT(refusal_of("mt-sics", {"S I\r\n", "ES\r\n"}), Contains("it answered 'ES'"));
  CHECK_THAT(refusal_of("sartorius", {"Err 54\r\n"}), Contains("it answered 'Err 54'"));
  CHECK_THAT(refusal_of("mark10", {"1.23 N\r\n", "*10\r\n"}), Contains("it answered '*10'"));
}

TEST_CASE("stages whose count lasts have no trouble with a zero", "[rig][pty]") {
  CHECK(trouble_on(homed_grbl()) == "");
  CHECK(trouble_on(DeviceFixture::options("zaber")) == "");
}

TEST_CASE("a stage that counts anew at each connection names why it keeps no zero", "[rig][pty]") {
  EmulatedRigOptions options = homed_grbl();
  std::string expected;
  SECTION("its board restarts") {
    options.resets_on_open = true;
    expected = "restarts when the port is opened";
  }
  SECTION("it does not home") {
    options.grbl.is_homing_enabled = options.grbl.is_homed = false;
    expected = "$22=0";
  }
  SECTION("it was not homed, and the connection before has not unlocked it") {
    options.grbl.is_homed = false;
    expected = "has not been homed since it was switched on";
  }
  SECTION("Marlin") {
    options = DeviceFixture::options("marlin");
    expected = "when it connects (G92)";
  }
  CHECK_THAT(trouble_on(options), Contains(expected));
}

}  // namespace
}  // namespace viscard
