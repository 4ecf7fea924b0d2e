// An emulated rig that waits for the program gives the same answer however late the program is.
#include "tests/rig/rig_fixture.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

namespace viscard {
namespace {

// Everything of a record, so that two runs can be compared.
struct RecordText {
  std::string operator()(const RawBytes& raw) const {
    return "raw " + std::to_string(raw.host_time_s) + " " + std::to_string(raw.is_sent) + raw.bytes;
  }
  std::string operator()(const LoadSample& sample) const {
    return "sample " + std::to_string(sample.host_time_s) + " " + std::to_string(*sample.counts);
  }
  std::string operator()(const StageReport& report) const {
    return "report " + std::to_string(report.host_time_s) + " " + std::to_string(report.position_m);
  }
  std::string operator()(const CommandedMove& move) const {
    return "move " + move.purpose + " " + std::to_string(move.move.start_time_s) + " " +
           std::to_string(move.start_uncertainty_s) + " " + std::to_string(move.move.to_m * 1e6);
  }
  std::string operator()(const TemperatureSample& sample) const {
    return "temperature " + std::to_string(sample.host_time_s) + " " +
           std::to_string(sample.temperature_C);
  }
  std::string operator()(const RunEvent& event) const {
    return "event " + std::to_string(event.host_time_s) + " " + event.name + " " + event.value +
           " " + event.text;
  }
};

std::vector<std::string> texts_of(const RigFixture& rig) {
  std::vector<std::string> texts;
  for (const RunRecord& record : rig.records) texts.push_back(std::visit(RecordText{}, record));
  return texts;
}

void late_now_and_then(RigFixture& rig) {
  rig.sink = [&rig, n = 0](const RunRecord& record) mutable {
    rig.records.push_back(record);
    if (++n % 200 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(30));
  };
}

}  // namespace

TEST_CASE("a rig that waits gives the same records at any speed and however late the program is",
          "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.truth.surface_position_m = 0.2e-3;
  RigFixture plain(options);
  const RunOutcome outcome = plain.run(short_plan());
  INFO(outcome.reason);
  REQUIRE(outcome.status == "finished");
  CHECK(outcome.n_late == 0);
  options.config.clock_speed = 40.0;
  RigFixture late(options);
  late_now_and_then(late);
  CHECK(late.run(short_plan()).status == "finished");
  const std::vector<std::string> expected = texts_of(plain), found = texts_of(late);
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) REQUIRE(found[i] == expected[i]);
}

TEST_CASE(
    "the disturbed lines of a rig that waits have the same faults however late the program is",
    "[rig][pty][faults]") {
  LineFaults faults;
  faults.cell = {.seed = 3, .to_host = {.drop = 0.01, .split = 0.05, .delay = 0.01}};
  faults.stage = {.seed = 4, .to_host = {.split = 0.1, .delay = 0.02}};
  EmulatedRigOptions options = RigFixture::options();
  options.truth.surface_position_m = 0.1e-3;
  RigFixture plain(options, faults);
  plain.run(short_plan());
  RigFixture late(options, faults);
  late_now_and_then(late);
  late.run(short_plan());
  CHECK(plain.cell_proxy->counts().faults > 10);
  CHECK(plain.cell_proxy->counts().faults == late.cell_proxy->counts().faults);
  const std::vector<std::string> expected = texts_of(plain), found = texts_of(late);
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) REQUIRE(found[i] == expected[i]);
}

}  // namespace viscard
