#include "rig/cells/gauge_load_cell.h"
#include "rig/emulator/pty_port.h"
#include "rig/protocols/gauge_protocols.h"
#include "rig/rig_check.h"
#include "tests/rig/device_fixture.h"

#include <catch2/catch.hpp>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

TestPlan quick_plan() {
  TestPlan plan;
  plan.approach_speed_m_s = 0.1e-3;
  plan.baseline_s = 1.0;
  plan.hold_s = 2.0;
  plan.recovery_s = 0.0;
  return plan;
}

EmulatedRigOptions gauge_rig(const std::string& driver) {
  EmulatedRigOptions options = DeviceFixture::options("grbl", driver);
  options.truth.sample_rate_Hz = 40.0;
  options.config.load_cell.expected_rate_Hz = 40.0;
  return options;
}

}  // namespace

TEST_CASE("units of force are converted to newtons", "[rig]") {
  CHECK(*newtons_per_unit("N") == 1.0);
  CHECK(*newtons_per_unit(" mN ") == 1e-3);
  CHECK(*newtons_per_unit("gF") == Approx(9.80665e-3).epsilon(1e-14));
  CHECK(*newtons_per_unit("lbF") == Approx(4.4482216152605).epsilon(1e-13));  // NIST SP 811
  CHECK(*newtons_per_unit("ozF") == Approx(0.27801385095378).epsilon(1e-13));
  CHECK_FALSE(newtons_per_unit("V").has_value());
  CHECK_FALSE(newtons_per_unit("MN").has_value());
}

TEST_CASE("SCPI readings, overloads and errors are read", "[rig]") {
  CHECK(*parse_scpi_reading("+1.77900000E+00")->volts == 1.779);
  CHECK(*parse_scpi_reading("-1.0E-3,+2.5E-01")->volts == 0.25);  // the newest of several
  const auto overload = parse_scpi_reading("+9.90000000E+37");
  REQUIRE(overload.has_value());
  CHECK(overload->is_overload);
  CHECK_FALSE(overload->volts.has_value());
  CHECK_FALSE(parse_scpi_reading("HEWLETT-PACKARD,34401A,0,10-5-2").has_value());
  CHECK_FALSE(parse_scpi_reading("").has_value());
  CHECK(parse_scpi_error("+0,\"No error\"")->code == 0);
  CHECK(parse_scpi_error("-113,\"Undefined header\"")->text == "Undefined header");
  CHECK_FALSE(parse_scpi_error("1.0").has_value());
  CHECK_THROWS_WITH(scpi_protocol("34402"), Contains("34401a, gdm, owon"));
}

TEST_CASE("Mark-10 and Sauter readings are read in their units", "[rig]") {
  CHECK(*parse_mark10_reading("-18.78 lbF", "N")->force_N ==
        Approx(-18.78 * 4.4482216152605).epsilon(1e-12));
  CHECK(*parse_mark10_reading("4.285 N\r", "lbF")->force_N == 4.285);
  CHECK(*parse_mark10_reading("4.285", "mN")->force_N == Approx(4.285e-3).epsilon(1e-14));
  CHECK(parse_mark10_reading("*10", "N")->error == "*10");
  CHECK_FALSE(parse_mark10_reading("4.285 furlong", "N").has_value());
  CHECK_FALSE(parse_mark10_reading("ready", "N").has_value());
  CHECK(*parse_sauter_reading("0011.70", "N")->force_N == 11.70);   // compression
  CHECK(*parse_sauter_reading("1011.70", "N")->force_N == -11.70);  // tension
  CHECK_FALSE(parse_sauter_reading("0011.7", "N").has_value());
  CHECK_FALSE(parse_sauter_reading("2011.70", "N").has_value());
  CHECK_FALSE(parse_sauter_reading("00-1.70", "N").has_value());
  CHECK_THROWS_WITH(sauter_protocol("stone"), Contains("unit 'stone'"));
}

TEST_CASE("balances are read as their makers write them", "[rig]") {
  constexpr double kGram_N = 9.80665e-3;
  CHECK(*parse_mt_sics_reading("S S     100.00 g\r", "g")->force_N == Approx(100.0 * kGram_N));
  CHECK(*parse_mt_sics_reading("S D     -12.34 g", "g")->force_N == Approx(-12.34 * kGram_N));
  CHECK(*parse_mt_sics_reading("SI D      1.5 N", "g")->force_N == 1.5);
  CHECK(parse_mt_sics_reading("S +", "g")->is_overload);
  for (const char* refused : {"S -", "S I", "S L", "ES", "ET", "EL", "S S Error 10b"}) {
    CAPTURE(refused);
    CHECK(parse_mt_sics_reading(refused, "g")->error == refused);
  }
  for (const char* other :
       {"I4 A \"1114350697\"", "Z A", "S D 12 pcs", "S", "", "12.34 g", "S D 1:2 g"}) {
    CAPTURE(other);
    CHECK_FALSE(parse_mt_sics_reading(other, "g"));
  }
  CHECK(*parse_sartorius_reading("+   123.56 g  \r", "g")->force_N == Approx(123.56 * kGram_N));
  CHECK(*parse_sartorius_reading("N     -   123.56 g  ", "g")->force_N ==
        Approx(-123.56 * kGram_N));
  CHECK(*parse_sartorius_reading("+    0.006    ", "kg")->force_N ==
        Approx(6.0 * kGram_N));  // in motion
  CHECK(*parse_sartorius_reading("+   123.5[6] g  ", "g")->force_N == Approx(123.56 * kGram_N));
  CHECK(parse_sartorius_reading("       H        ", "g")->is_overload);
  CHECK(parse_sartorius_reading("Stat     High         ", "g")->is_overload);
  for (const char* refused : {"L", "Cal.Int.", "Err 54", "APP. ERR", "--"}) {
    CAPTURE(refused);
    CHECK(parse_sartorius_reading(refused, "g")->error == refused);
  }
  for (const char* other : {"SerNo. 0031801165", "", "+ 12 pcs", "BCE623-1S", "+ 1 2 g"}) {
    CAPTURE(other);
    CHECK_FALSE(parse_sartorius_reading(other, "g"));
  }
  CHECK(*newtons_per_unit("mg") == Approx(1e-3 * kGram_N));
}

TEST_CASE("each kind of load cell is identified and measured by a rig check", "[rig][pty]") {
  const std::string driver =
      GENERATE("scpi", "mark10", "mark10-continuous", "sauter", "mt-sics", "sartorius");
  EmulatedRigOptions options = gauge_rig(driver);
  options.gauge.echoes = driver == "scpi";
  DeviceFixture rig(options);
  const RigCheck check =
      check_rig(*rig.devices.stage, *rig.devices.load_cell, rig.config, rig.clock, 1.0);
  INFO(driver);
  // A query takes time in addition to the reading, and more on a busy machine.
  CHECK(check.rate_Hz > 20.0);
  CHECK(check.rate_Hz < (driver == "mark10-continuous" ? 51.0 : 40.5));  // AOUT50
  // 1 mN is the last digit of the emulated Sauter; noise 0.5 mN.
  CHECK(check.force_N == Approx(options.truth.force_offset_N).margin(1e-3));
  CHECK(check.stream.unreadable == 0);
}

TEST_CASE("a whole test runs on a multimeter and on force gauges", "[rig][pty]") {
  const std::string driver =
      GENERATE("scpi", "mark10", "mark10-continuous", "sauter", "mt-sics", "sartorius");
  DeviceFixture rig(gauge_rig(driver));
  const RunOutcome outcome = rig.run(quick_plan());
  INFO(driver << ": " << outcome.reason);
  REQUIRE(outcome.status == "finished");
  const EmulatedOutcome bench = rig.emulated.outcome();
  CHECK(bench.peak_depth_m == Approx(0.13e-3).margin(8e-6));
  CHECK(outcome.peak_force_N == Approx(bench.peak_force_N).margin(5e-3));  // last digit and noise
  CHECK(rig.all<LoadSample>().front().volts.has_value() == (driver == "scpi"));
}

TEST_CASE("lost and late answers are never taken for the answer to another query", "[rig][pty]") {
  EmulatedRigOptions options = gauge_rig("mark10");
  options.gauge.late_answer_every = 9;
  options.gauge.late_s = 0.58;  // after the driver has given up
  options.truth.force_noise_N = 0.0;
  DeviceFixture rig(options);
  LoadCell& cell = *rig.devices.load_cell;
  cell.connect(rig.pump());
  // The load steps while answers are on their way; every reading must have been made after its
  // query.
  std::vector<std::pair<double, double>> steps;
  for (int i = 0; i < 5; ++i) {
    rig.emulated.hang_weight(0.1 * i);
    steps.emplace_back(rig.clock.now_s(), 0.1 * i + options.truth.force_offset_N);
    rig.pump_for(0.35);
  }
  int n_checked = 0;
  for (const LoadSample& sample : rig.all<LoadSample>()) {
    for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
      // Asked for and received within one step, a few ms from its ends.
      if (*sample.device_time_s < steps[i].first + 0.01 ||
          sample.host_time_s > steps[i + 1].first) {
        continue;
      }
      ++n_checked;
      CHECK(*sample.force_N == Approx(steps[i].second).margin(1e-4));
    }
  }
  CHECK(n_checked > 8);
  CHECK(cell.counts().duplicate >= 1);  // late answers are counted and left out
}

TEST_CASE("a load cell that changes its unit, refuses its setup or goes silent is an error",
          "[rig][pty]") {
  SECTION("unit") {
    EmulatedRigOptions options = gauge_rig("mark10");
    options.gauge.changes_unit_after = 20;
    DeviceFixture rig(options);
    rig.devices.load_cell->connect(rig.pump());
    CHECK_THROWS_WITH(rig.pump_for(3.0), Contains("from 'N' to 'lbF'"));
  }
  SECTION("setup") {
    EmulatedRigOptions options = gauge_rig("scpi");
    options.gauge.refuses_setup = true;
    DeviceFixture rig(options);
    CHECK_THROWS_WITH(rig.devices.load_cell->connect(rig.pump()), Contains("Undefined header"));
  }
  SECTION("silent") {
    EmulatedRigOptions options = gauge_rig("sauter");
    options.gauge.lose_answer_every = 1;
    DeviceFixture rig(options);
    CHECK_THROWS_WITH(rig.devices.load_cell->connect(rig.pump()), Contains("no reading came"));
  }
}

TEST_CASE("a unit that the gauge does not send is taken from the rig file", "[rig][pty]") {
  EmulatedRigOptions options = gauge_rig("mark10");
  options.gauge.unit = "gF";
  options.gauge.hides_unit = true;
  options.config.load_cell.unit = "gF";
  DeviceFixture rig(options);
  rig.devices.load_cell->connect(rig.pump());
  rig.pump_for(0.2);
  CHECK(*rig.all<LoadSample>().back().force_N ==
        Approx(options.truth.force_offset_N).margin(6 * options.truth.force_noise_N));
}

TEST_CASE("a number with a unit on an HX711 line is a force", "[rig][pty]") {
  EmulatedRigOptions options = DeviceFixture::options();
  options.amplifier.format = AmplifierFormat::kVolts;  // a plain number with decimals
  options.config.load_cell.unit = "g";
  options.config.load_cell.line_format = "auto";
  options.config.calibration.volts_per_newton = 1.0;
  options.truth.cell_gain = 1.0 / 9.80665e-3;  // an amplifier that was scaled to grams
  options.config.load_cell.volts_per_count = 1e-4;
  DeviceFixture rig(options);
  rig.devices.load_cell->connect(rig.pump());
  rig.pump_for(2.0);
  const LoadSample sample = rig.all<LoadSample>().back();
  REQUIRE(sample.force_N.has_value());
  CHECK(*sample.force_N ==
        Approx(options.truth.force_offset_N).margin(6 * options.truth.force_noise_N));
}

TEST_CASE("framings other than 8N1 are set, and an unknown one is refused", "[rig][pty]") {
  const PtyPort port;
  const RigClock clock;
  CHECK_NOTHROW(SerialLine(port.path(), 9600, clock, "7E2"));
  CHECK_THROWS_WITH(SerialLine(port.path(), 9600, clock, "9N1"), Contains("framing '9N1'"));
}

}  // namespace viscard
