#include "rig/emulator/pty_port.h"
#include "rig/lines/port_probe.h"
#include "rig/open_devices.h"
#include "rig/rig_check.h"
#include "rig/touch_cell.h"
#include "tests/rig/rig_fixture.h"

#include <catch2/catch.hpp>
#include <unistd.h>

#include <algorithm>

namespace viscard {

TEST_CASE("a rig check measures rate and noise, reads settings and moves nothing", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.truth.sample_rate_Hz = 90.0;  // an HX711's own oscillator is off by more than a clock
  RigFixture rig(options);
  const RigCheck check = check_rig(rig.stage, rig.load_cell, rig.config, rig.clock, 10.0);
  CHECK(check.stage_identity == "Grbl 1.1h");
  CHECK(check.rate_Hz == Approx(90.0).epsilon(0.01));  // one reading in 900 more or less, delays
  const EmulatedTruth& truth = options.truth;
  CHECK(check.noise_N == Approx(truth.force_noise_N).epsilon(0.15));  // 5/sqrt(2*900)
  CHECK(check.force_N == Approx(truth.force_offset_N).margin(1e-4));  // 6 sigma/sqrt(900)
  CHECK(check.latency.n > 5);
  CHECK(check.is_usable);
  CHECK_FALSE(rig.emulated.outcome().is_moving);
  CHECK(rig.emulated.outcome().final_position_m == 0.0);
  bool names_rate = false;
  for (const std::string& text : check.advice) {
    names_rate = names_rate || text.find("expected_rate") != std::string::npos;
  }
  CHECK(names_rate);
}

TEST_CASE("a converter at 10 readings/s is usable, one at 1 reading/s is not", "[rig][pty]") {
  const double rate_Hz = GENERATE(10.0, 1.0);
  EmulatedRigOptions options = RigFixture::options();
  options.truth.sample_rate_Hz = rate_Hz;
  options.config.load_cell.expected_rate_Hz = rate_Hz;
  RigFixture rig(options);
  const RigCheck check = check_rig(rig.stage, rig.load_cell, rig.config, rig.clock, 20.0);
  CHECK(check.is_usable == (rate_Hz == 10.0));
  CHECK(std::any_of(check.advice.begin(), check.advice.end(), [&](const std::string& text) {
    return text.find(rate_Hz == 10.0 ? "waits for a reading" : "too few") != std::string::npos;
  }));
}

TEST_CASE("numbers with a decimal point and no unit are read as volts, and the advice reports it",
          "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.config.load_cell.line_format = "auto";
  options.amplifier.format = AmplifierFormat::kVolts;
  const auto advised = [](const RigCheck& check) {
    return std::any_of(check.advice.begin(), check.advice.end(), [](const std::string& text) {
      return text.find("are read as volts") != std::string::npos;
    });
  };
  RigFixture rig(options);
  const RigCheck check = check_rig(rig.stage, rig.load_cell, rig.config, rig.clock, 5.0);
  CHECK(check.reads_as == "volts");
  CHECK(advised(check));
  options.config.load_cell.line_format = "volts";
  RigFixture stated(options);
  CHECK_FALSE(advised(check_rig(stated.stage, stated.load_cell, stated.config, stated.clock, 5.0)));
}

namespace {

// Touches the load cell of a rig whose force changes as asked while it listens: what the weight is
// at a time since the connection, N.
double touched(double (*weight_N)(double since_ready_s, bool is_ready)) {
  RigFixture rig(RigFixture::options());
  double ready_s = 0.0;
  bool is_ready = false;
  rig.on_record = [&](const RunRecord& record) {
    const auto* sample = std::get_if<LoadSample>(&record);
    if (sample == nullptr) return;
    rig.emulated.hang_weight(weight_N(sample->host_time_s - ready_s, is_ready));
  };
  TouchOptions options;
  options.wait_s = 8.0;
  options.ready = [&] {
    ready_s = rig.clock.now_s();
    is_ready = true;
  };
  return await_touch(rig.load_cell, rig.config, rig.clock, options);
}

}  // namespace

TEST_CASE("a finger answers, and neither a drift nor a zero that jumps does", "[rig][pty]") {
  CHECK(touched([](double s, bool is_ready) {
          return is_ready && s > 1.0 && s < 2.0 ? 0.3 : 0.0;
        }) == Approx(0.3).epsilon(0.02));
  using Catch::Matchers::Contains;
  CHECK_THROWS_WITH(touched([](double s, bool) { return 0.05 * s; }), Contains("drifts by 5"));
  CHECK_THROWS_WITH(touched([](double s, bool) { return -0.03 * s; }), Contains("drifts by -3"));
  CHECK_THROWS_WITH(
      touched([](double s, bool is_ready) { return is_ready && s > 1.0 ? 0.1 : 0.0; }),
      Contains("did not come back"));
  CHECK_THROWS_WITH(touched([](double, bool) { return 0.4; }), Contains("before anything"));
  CHECK_THROWS_WITH(touched([](double, bool) { return 0.0; }), Contains("has not answered"));
}

TEST_CASE("two devices on one port are refused, also under two names", "[rig]") {
  RigConfig rig;
  rig.stage.port = "/dev/null";
  rig.load_cell.port = "/dev/../dev/null";
  CHECK_THROWS_WITH(check_devices(rig), Catch::Contains("is the same port as that of [stage]"));
  rig.load_cell.port = "/dev/zero";
  CHECK_NOTHROW(check_devices(rig));
  rig.thermometer.driver = "text";
  rig.thermometer.port = "/dev/zero";
  CHECK_THROWS_WITH(check_devices(rig), Catch::Contains("that of [load_cell]"));
}

TEST_CASE("the state of a port is reported without opening it", "[rig][pty]") {
  PtyPort device;
  CHECK(port_status(device.path()).trouble.empty());
  CHECK_FALSE(device.is_open_by_host());
  CHECK(port_status("/dev/no_such_port").trouble.find("there is no port") == 0);
  CHECK(port_status("/tmp").trouble.find("a folder") != std::string::npos);
}

}  // namespace viscard
