#include "rig/protocols/grbl_protocol.h"
#include "tests/rig/rig_fixture.h"

#include <catch2/catch.hpp>

#include <cmath>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

}  // namespace

TEST_CASE("the format of an amplifier's lines is learnt", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.config.load_cell.line_format = "auto";
  Hx711Format expected = Hx711Format::kCounts;
  SECTION("micros,counts") {
    expected = Hx711Format::kMicrosCounts;
  }
  SECTION("millis,counts") {
    options.amplifier.format = AmplifierFormat::kMillisCounts;
    expected = Hx711Format::kMillisCounts;
  }
  SECTION("counts alone, bare LF") {
    options.amplifier.format = AmplifierFormat::kCounts;
    options.amplifier.line_end = "\n";
  }
  SECTION("a sentence") {
    options.amplifier.format = AmplifierFormat::kReadingText;
  }
  SECTION("volts, CR") {
    options.amplifier.format = AmplifierFormat::kVolts;
    options.amplifier.line_end = "\r";
    expected = Hx711Format::kVolts;
  }
  RigFixture rig(options);
  rig.load_cell.connect(rig.pump());
  CHECK(rig.load_cell.format() == expected);
  pump_for(rig, 3.0);
  CHECK(rig.load_cell.counts().received > 100);
  CHECK(rig.load_cell.counts().unreadable == 0);
}

TEST_CASE("noise depends only on the seed and the number of the reading", "[rig]") {
  const EmulatedTruth truth = demo_truth(10.0, 42);
  const RigConfig config = demo_rig();
  const double volts_per_count = config.load_cell.volts_per_count;
  const AmplifierOptions options{.format = AmplifierFormat::kCounts, .line_end = ""};
  EmulatedAmplifier one(truth, config.calibration, volts_per_count, options);
  EmulatedAmplifier other(truth, config.calibration, volts_per_count, options);
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kN = 20000;
  for (int i = 0; i < kN; ++i) {
    const std::string line = one.convert(0.0, false);
    REQUIRE(line == other.convert(0.0, false));
    const double force_N =
        force_N_from_volts(config.calibration, std::stod(line) * volts_per_count) -
        truth.force_offset_N;
    sum += force_N;
    squares += force_N * force_N;
  }
  // Standard errors: sigma/sqrt(n) of the mean and sigma/sqrt(2n) of the deviation; 5 of them.
  const double sigma_N = truth.force_noise_N;
  CHECK(std::abs(sum / kN) < 5 * sigma_N / std::sqrt(kN));
  CHECK(std::sqrt(squares / kN) == Approx(sigma_N).epsilon(5 / std::sqrt(2.0 * kN)));
}

TEST_CASE("a counter that wraps during the run loses no reading", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.amplifier.micros_at_reset = 4294967295u - 1500000u;  // wraps after 1.5 s
  RigFixture rig(options);
  rig.load_cell.connect(rig.pump());
  pump_for(rig, 5.0);
  CHECK(rig.load_cell.counts().received > 250);
  CHECK(rig.load_cell.counts().missing == 0);
  const auto samples = rig.all<LoadSample>();
  for (std::size_t i = 1; i < samples.size(); ++i) {
    REQUIRE(*samples[i].device_time_s - *samples[i - 1].device_time_s ==
            Approx(0.0125).margin(2e-6));
  }
}

TEST_CASE("the estimated time of a reading recovers from the delay of a stall", "[rig][pty]") {
  RigFixture rig(RigFixture::on_wall_clock(1.0));
  rig.load_cell.connect(rig.pump());
  pump_for(rig, 0.5);
  rig.emulated.stall(0.1);
  pump_for(rig, 0.5);
  const auto samples = rig.all<LoadSample>();
  REQUIRE(samples.size() > 60);
  double latest_arrival_s = 0.0;
  for (const LoadSample& sample : samples) {
    const double made_s = rig.load_cell.made_at_s(sample);
    CHECK(made_s <= sample.host_time_s + 1e-9);
    latest_arrival_s = std::max(latest_arrival_s, sample.host_time_s - made_s);
  }
  CHECK(latest_arrival_s > 0.05);  // the stall shows in the stamps only
  CHECK(rig.load_cell.counts().missing == 0);
}

TEST_CASE("incidents of the amplifier are distinguished", "[rig][pty]") {
  RigFixture rig(RigFixture::options());
  rig.load_cell.connect(rig.pump());
  SECTION("restart") {
    rig.emulated.cause(Incident::kRestartLoadCell);
    CHECK_THROWS_AS(pump_for(rig, 10.0), DeviceRestarted);
  }
  SECTION("cable pulled") {
    rig.emulated.cause(Incident::kPullLoadCellCable);
    CHECK_THROWS_AS(pump_for(rig, 10.0), PortHungUp);
  }
}

TEST_CASE("a port without readings is refused with the bytes that came instead", "[rig][pty]") {
  EmulatedRig emulated(RigFixture::options());
  const RigClock clock = emulated.clock();
  SerialLine line(emulated.load_cell_port(), 115200, clock);
  LoadCellConfig config;
  config.line_format = "parrots";
  CHECK_THROWS_WITH(Hx711LoadCell(line, config, clock, [](const RunRecord&) {}),
                    Contains("'parrots' is unknown"));
}

TEST_CASE("moves of the emulated GRBL are as slow as the firmware's timer makes them", "[rig]") {
  // At 3200 steps/mm and 16 MHz, cycles of a step: ceil(16666.7) in 8 periods of 2083 + 1, 5000 in 4
  // of 1250 + 1, 2500 in 2 of 1250 + 1, 1250 in 1 of 1250 + 1.
  struct Row {
    double speed_mm_s, cycles, with_timer;
  };
  const Row row = GENERATE(Row{0.3, 16e6 / 960.0, 8 * 2084.0}, Row{1.0, 5000.0, 4 * 1251.0},
                           Row{2.0, 2500.0, 2 * 1251.0}, Row{4.0, 1250.0, 1251.0});
  const bool is_hal = GENERATE(false, true);
  EmulatedGrbl grbl(demo_truth(10.0, 1), 'Z', -1, {.is_hal = is_hal});
  grbl.reset(0.0);
  grbl.receive(format_grbl_jog('Z', -5.0, row.speed_mm_s * 60.0) + "\n", 1.0);
  const double from_s = 1.1, to_s = 1.9;
  const double speed_mm_s =
      (grbl.bench_position_m(to_s) - grbl.bench_position_m(from_s)) * 1e3 / (to_s - from_s);
  const double expected = is_hal ? 1.0 : row.cycles / row.with_timer;
  CHECK(speed_mm_s / row.speed_mm_s == Approx(expected).epsilon(1e-7));
}

}  // namespace viscard
