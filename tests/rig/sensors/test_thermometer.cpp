// Thermometers beside a run, through real pseudo-terminals. None of them may end it.
#include "rig/protocols/temperature_text.h"
#include "rig/rig_check.h"
#include "tests/rig/cells/instrument_faults.h"

#include <utility>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

EmulatedRigOptions rig_with(const std::string& driver) {
  EmulatedRigOptions options = DeviceFixture::options();
  options.truth.surface_position_m = 0.1e-3;
  options.config.thermometer.driver = driver;
  return options;
}

std::vector<double> temperatures_of(const DeviceFixture& rig) {
  std::vector<double> values;
  for (const TemperatureSample& sample : rig.all<TemperatureSample>()) {
    values.push_back(sample.temperature_C);
  }
  return values;
}

bool has_thermometer_event(const DeviceFixture& rig, const std::string& value) {
  const auto events = rig.all<RunEvent>();
  return std::any_of(events.begin(), events.end(), [&](const RunEvent& event) {
    return event.name == "thermometer" && event.value == value;
  });
}

}  // namespace

TEST_CASE("a line of a thermometer is read with its name and its unit", "[rig]") {
  const auto read = [](const char* line) { return temperature_C_from_text(line, "degC"); };
  CHECK(*read("T=23.4") == 23.4);
  CHECK(*read("23.4") == 23.4);
  CHECK(*read("-5.06\r") == -5.06);
  CHECK(*read("+2.34000000E+01") == Approx(23.4).epsilon(1e-14));
  CHECK(*read("temp: 23.4") == 23.4);
  CHECK(*read("Temperature (C): 23.40 C") == 23.4);
  CHECK(*read("T = 23.4 \xc2\xb0"
              "C") == 23.4);
  CHECK(*read("T=23.4\xb0"
              "C") == 23.4);            // Latin 1
  CHECK(*read("23.41,45.2") == 23.41);  // a humidity behind it
  CHECK(*read("74.12 F") == Approx(23.4).epsilon(1e-12));
  CHECK(*read("296.55 K") == Approx(23.4).epsilon(1e-12));
  CHECK(*temperature_C_from_text("296.55", "K") == Approx(23.4).epsilon(1e-12));
  for (const char* line : {"", "T=", "ready", "rH=45.2", "nan", "9.9E37", "T=-127.00", "-127",
                           "23.4 V", "1200", "12a4", "Sensor 2 found"}) {
    CAPTURE(line);
    CHECK_FALSE(read(line).has_value());
  }
  CHECK(names_temperature("T=23.4"));
  CHECK(names_temperature("  Temp : 23.4"));
  CHECK_FALSE(names_temperature("23.4"));
  CHECK_FALSE(names_temperature("HX711 reading: 12345"));
  CHECK_FALSE(names_temperature("tare: 1"));
}

TEST_CASE("each kind of thermometer is recorded with a run, which is as it is without one",
          "[rig][pty]") {
  EmulatedRigOptions plain = rig_with("none");
  DeviceFixture alone(plain);
  const RunOutcome without = alone.run(shortest_test());
  REQUIRE(without.status == "finished");
  CHECK_FALSE(without.temperature.has_value());
  const std::string driver = GENERATE("text", "scpi", "load-cell");
  EmulatedRigOptions options = rig_with(driver);
  if (driver == "text") options.thermometer.before = "";  // a plain number
  DeviceFixture rig(options);
  const RunOutcome outcome = rig.run(shortest_test());
  INFO(driver << ": " << outcome.reason);
  REQUIRE(outcome.status == "finished");
  REQUIRE(outcome.temperature.has_value());
  CHECK(outcome.temperature->mean_C == Approx(23.4).epsilon(1e-12));
  CHECK(outcome.temperature->n_readings == temperatures_of(rig).size());
  CHECK(outcome.temperature->n_readings > 3);
  CHECK(outcome.thermometer_trouble.empty());
  CHECK(outcome.doubts == without.doubts);
  CHECK(outcome.stream.unreadable == 0);
  CHECK(outcome.stream.missing == 0);
  CHECK(outcome.peak_force_N == Approx(without.peak_force_N).margin(3e-3));
  const auto samples = rig.all<TemperatureSample>();
  for (std::size_t i = 2; i < samples.size(); ++i) {
    CHECK(samples[i].host_time_s - samples[i - 1].host_time_s == Approx(1.0).margin(0.2));
  }
  const auto raw = rig.all<RawBytes>();
  const bool has_raw = std::any_of(raw.begin(), raw.end(), [](const RawBytes& bytes) {
    return bytes.device == Device::kThermometer;
  });
  CHECK(has_raw == (driver != "load-cell"));
}

TEST_CASE("a thermometer that fails ends no run and is reported", "[rig][pty]") {
  EmulatedRigOptions options = rig_with("text");
  TestPlan plan = shortest_test();
  plan.hold_s = 12.0;
  SECTION("silent") {
    options.thermometer.silent_from_s = 3.0;
    DeviceFixture rig(options);
    const RunOutcome outcome = rig.run(plan);
    REQUIRE(outcome.status == "finished");
    CHECK(has_thermometer_event(rig, "silent"));
    CHECK_THAT(outcome.thermometer_trouble, Contains("has sent no temperature for"));
    REQUIRE(outcome.doubts.size() == 1);
    CHECK(outcome.temperature->n_readings > 1);
  }
  SECTION("silent for a while") {
    options.thermometer.silent_from_s = 3.0;
    options.thermometer.silent_until_s = 10.0;
    DeviceFixture rig(options);
    const RunOutcome outcome = rig.run(plan);
    REQUIRE(outcome.status == "finished");
    CHECK(has_thermometer_event(rig, "back"));
    CHECK(outcome.thermometer_trouble.empty());
    REQUIRE(outcome.doubts.size() == 1);
    CHECK_THAT(outcome.doubts[0], Contains("was silent for"));
  }
  SECTION("pulled") {
    DeviceFixture rig(options);
    bool is_pulled = false;
    rig.emulated.serve_too([&](double now_s) {
      if (now_s > 5.0 && !std::exchange(is_pulled, true)) {
        rig.emulated.cause(Incident::kPullThermometerCable);
      }
      return false;
    });
    const RunOutcome outcome = rig.run(plan);
    REQUIRE(outcome.status == "finished");
    CHECK_THAT(outcome.thermometer_trouble, Contains("is gone"));
    CHECK(outcome.temperature->n_readings > 2);
  }
  SECTION("never there") {
    DeviceFixture rig(options);
    RigConfig config = rig.config;
    config.thermometer.port = "/dev/no-thermometer";
    rig.devices.thermometer.reset();
    rig.devices.thermometer = make_thermometer(config, rig.clock, rig.sink);
    const RunOutcome outcome = rig.run(shortest_test());
    REQUIRE(outcome.status == "finished");
    CHECK(has_thermometer_event(rig, "missing"));
    CHECK_THAT(outcome.thermometer_trouble, Contains("/dev/no-thermometer"));
    CHECK_FALSE(outcome.temperature.has_value());
  }
  SECTION("not connected to its board") {
    options.thermometer.fail_every = 1;
    DeviceFixture rig(options);
    const RunOutcome outcome = rig.run(plan);
    REQUIRE(outcome.status == "finished");
    CHECK_FALSE(outcome.temperature.has_value());
    CHECK(outcome.doubts.size() == 1);
  }
}

TEST_CASE("a garbled temperature is left out, and one that drifts is reported", "[rig][pty]") {
  EmulatedRigOptions options = rig_with("text");
  TestPlan plan = shortest_test();
  plan.hold_s = 12.0;
  SECTION("garbled") {
    options.thermometer.garble_every = 4;
    DeviceFixture rig(options);
    const RunOutcome outcome = rig.run(plan);
    REQUIRE(outcome.status == "finished");
    for (const double temperature_C : temperatures_of(rig)) CHECK(temperature_C == 23.4);
    CHECK(outcome.doubts.empty());
  }
  SECTION("drift") {
    options.thermometer.drift_K_s = 0.1;
    DeviceFixture rig(options);
    const RunOutcome outcome = rig.run(plan);
    REQUIRE(outcome.status == "finished");
    REQUIRE(outcome.doubts.size() == 1);
    CHECK_THAT(outcome.doubts[0],
               Contains("the temperature went from 23.") && Contains("drift_limit allows 1.00 K"));
    CHECK(outcome.temperature->max_C - outcome.temperature->min_C > 1.0);
  }
}

TEST_CASE("a rig check shows the temperature, or why there is none", "[rig][pty]") {
  const std::string driver = GENERATE("text", "scpi", "load-cell");
  DeviceFixture rig(rig_with(driver));
  const RigCheck check = check_rig(*rig.devices.stage, *rig.devices.load_cell, rig.config,
                                   rig.clock, 2.0, rig.devices.thermometer.get());
  CHECK(check.has_thermometer);
  REQUIRE(check.temperature_C.has_value());
  CHECK(*check.temperature_C == Approx(23.4).epsilon(1e-12));
  CHECK(check.is_usable);
  EmulatedRigOptions options = rig_with(driver);
  options.thermometer.silent_from_s = 0.0;
  DeviceFixture silent(options);
  const RigCheck found = check_rig(*silent.devices.stage, *silent.devices.load_cell, silent.config,
                                   silent.clock, 2.0, silent.devices.thermometer.get());
  CHECK_FALSE(found.temperature_C.has_value());
  CHECK(found.is_usable);  // a run needs no thermometer
  CHECK(std::any_of(found.advice.begin(), found.advice.end(), [](const std::string& text) {
    return text.find("has sent no temperature") != std::string::npos;
  }));
}

TEST_CASE("wrong words of a thermometer are refused before any port is opened", "[rig]") {
  RigConfig rig = demo_rig();
  rig.stage.port = rig.load_cell.port = "/dev/none";
  const RigClock clock;
  rig.thermometer.driver = "mercury";
  CHECK_THROWS_WITH(open_ports(rig, clock), Contains("'mercury' under [thermometer]"));
  rig.thermometer.driver = "text";
  rig.thermometer.unit = "degR";
  CHECK_THROWS_WITH(open_ports(rig, clock), Contains("unit 'degR'"));
  rig.thermometer.unit = "degC";
  rig.thermometer.driver = "load-cell";
  rig.load_cell.driver = "scpi";
  CHECK_THROWS_WITH(open_ports(rig, clock), Contains("'scpi' is polled"));
}

TEST_CASE("an error of the sink while a temperature is recorded ends the run, as any other",
          "[rig][pty]") {
  DeviceFixture rig(rig_with("text"));
  const RecordSink full_disk = failing_once([](const RunRecord& record) {
    const auto* sample = std::get_if<TemperatureSample>(&record);
    if (sample != nullptr && sample->host_time_s > 8.0) throw RigError("the disk is full");
  });
  rig.devices.thermometer.reset();
  rig.devices.thermometer = make_thermometer(rig.config, rig.clock, full_disk);
  TestPlan plan = shortest_test();
  plan.hold_s = 12.0;
  const RunOutcome outcome = rig.run(plan);
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason, Contains("the disk is full"));
}

}  // namespace viscard
