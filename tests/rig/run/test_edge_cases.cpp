// What ports and amplifiers do wrong, through real pseudo-terminals. The table in rig/README.md
// says which test stands for which case.
#include "rig/emulator/pty_port.h"
#include "tests/rig/read_line.h"
#include "tests/rig/rig_fixture.h"

#include <catch2/catch.hpp>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

// An amplifier that says what a test tells it to.
struct ScriptedAmplifier {
  explicit ScriptedAmplifier(const std::string& line_format = "counts")
      : line(device.path(), 115200, clock), cell(line, config(line_format), clock, sink()) {}

  static LoadCellConfig config(const std::string& line_format) {
    LoadCellConfig result;
    result.line_format = line_format;
    return result;
  }
  RecordSink sink() {
    return [this](const RunRecord& record) { records.push_back(record); };
  }

  // Ten numbers counting up, each with that terminator, so that the driver connects.
  void connect(const std::string& end = "\n") {
    for (int i = 0; i < 10; ++i) say(std::to_string(1000 + i) + end);
    cell.connect([this] { serve(); });
  }
  void say(const std::string& bytes) { device.write(bytes); }
  void serve() {
    device.write("");
    wait_readable({&line}, 0.002);
    cell.service();
  }
  void serve_all() {
    for (int i = 0; i < 20; ++i) serve();
  }
  std::vector<double> counts() const {
    std::vector<double> values;
    for (const RunRecord& record : records) {
      const auto* sample = std::get_if<LoadSample>(&record);
      if (sample != nullptr && sample->counts) values.push_back(*sample->counts);
    }
    return values;
  }
  std::string error() {
    try {
      serve_all();
    } catch (const RigError& problem) {
      return problem.what();
    }
    return "";
  }

  PtyPort device;
  RigClock clock;
  SerialLine line;
  std::vector<RunRecord> records;
  Hx711LoadCell cell;
};

}  // namespace

TEST_CASE("Readings cut into single bytes, or many in one read, are the same readings",
          "[rig][pty]") {
  const std::string end = GENERATE("\n", "\r", "\r\n", "\n\r");
  ScriptedAmplifier amplifier;
  amplifier.connect(end);
  amplifier.serve_all();
  amplifier.records.clear();
  const std::string text = "-8388600" + end + "12" + end + "0" + end + "77" + end;
  SECTION("single bytes") {
    for (const char c : text) {
      amplifier.say(std::string(1, c));
      amplifier.serve();
    }
  }
  SECTION("one read") {
    amplifier.say(text);
  }
  amplifier.say("5" +
                end);  // with CR alone the end of a line is only sure when the next byte is there
  amplifier.serve_all();
  const std::vector<double> counts = amplifier.counts();
  REQUIRE(counts.size() >= 4);
  CHECK(std::vector<double>(counts.begin(), counts.begin() + 4) ==
        std::vector<double>{-8388600.0, 12.0, 0.0, 77.0});
}

TEST_CASE("Garbage before and between readings costs only itself", "[rig][pty]") {
  ScriptedAmplifier amplifier;
  amplifier.say(std::string("\xff\x80\0\x01garbage\n\xc3\x28\n9", 17));
  amplifier.say("\nTare... put nothing on the scale\nReadings:\n");
  amplifier.connect();
  amplifier.serve_all();
  amplifier.records.clear();
  amplifier.say("100\n\x80\x81\xfe\n101\n" +
                std::string("10\0"
                            "2\n",
                            5) +
                "nonsense\n103\n");
  amplifier.serve_all();
  CHECK(amplifier.counts() == std::vector<double>{100.0, 101.0, 103.0});
  CHECK(amplifier.cell.counts().unreadable == 3);
}

TEST_CASE("Numbers that say they are none are handed out as such, ends of the range as saturated",
          "[rig][pty]") {
  ScriptedAmplifier amplifier;
  amplifier.connect();
  amplifier.serve_all();
  amplifier.records.clear();
  amplifier.say("nan\ninf\novf\n8388607\n-8388608\n1020\n-0.00\n");
  amplifier.serve_all();
  std::vector<LoadSample> samples;
  for (const RunRecord& record : amplifier.records) {
    if (const auto* sample = std::get_if<LoadSample>(&record)) samples.push_back(*sample);
  }
  REQUIRE(samples.size() == 7);
  for (int i = 0; i < 5; ++i) CHECK(samples[static_cast<std::size_t>(i)].is_saturated);
  CHECK_FALSE(samples[0].counts);
  CHECK(*samples[3].counts == 8388607.0);
  CHECK_FALSE(samples[5].is_saturated);
  CHECK(*samples[6].counts == 0.0);
}

TEST_CASE("A decimal comma is read where the format has no comma of its own", "[rig][pty]") {
  ScriptedAmplifier amplifier("volts");
  for (int i = 0; i < 10; ++i) amplifier.say("0,12" + std::to_string(i) + "\r\n");
  amplifier.cell.connect([&] { amplifier.serve(); });
  amplifier.say("-1,5\r\n");
  amplifier.serve_all();
  const auto* last = std::get_if<LoadSample>(&amplifier.records.back());
  REQUIRE(last != nullptr);
  CHECK(*last->volts == -1.5);
}

TEST_CASE("A unit that changes in mid-run ends it with both units named", "[rig][pty]") {
  ScriptedAmplifier amplifier("volts");
  for (int i = 0; i < 10; ++i) amplifier.say("12.5 g\n");
  amplifier.cell.connect([&] { amplifier.serve(); });
  amplifier.say("12.5 g\n0.44 lbs\n");
  CHECK_THAT(amplifier.error(), Contains("from 'g' to 'lbs'"));
}

TEST_CASE("A missing converter is named in the middle of a stream too", "[rig][pty]") {
  ScriptedAmplifier amplifier;
  amplifier.connect();
  amplifier.say("1011\nHX711 not found.\n");
  CHECK_THAT(amplifier.error(), Contains("HX711 not found") && Contains("wires"));
}

TEST_CASE("A wrong baud rate is suspected from what it makes of text", "[rig][pty]") {
  // 115200 read at 57600: mostly bytes that no text has.
  const std::string noise("\xf8\x1e\xe6\x80\x00\xfe\x66\x98\xe0\x86\x80\x78\x9e\x00\xf8\x86", 16);
  PtyPort device;
  const RigClock clock;
  SerialLine line(device.path(), 57600, clock);
  const RecordSink nowhere = [](const RunRecord&) {};
  const Pump pump = [&] {
    device.write(noise);
    wait_readable({&line}, 0.01);
  };
  SECTION("stage") {
    GrblStage stage(line, StageConfig{}, clock, nowhere, 0.1);
    CHECK_THROWS_WITH(stage.connect([&] {
      pump();
      stage.service();
    }),
                      Contains("baud rate of 57600"));
  }
  SECTION("load cell") {
    Hx711LoadCell cell(line, LoadCellConfig{}, clock, nowhere, 0.05);
    CHECK_THROWS_WITH(cell.connect([&] {
      pump();
      cell.service();
    }),
                      Contains("baud rate of 57600"));
  }
}

TEST_CASE("A port forbidden to the user says which group to join", "[rig][pty]") {
  PtyPort device;
  REQUIRE(::chmod(device.path().c_str(), 0) == 0);
  int ends[2];
  REQUIRE(::pipe(ends) == 0);
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    std::string text = "it opened";
    try {
      if (::geteuid() == 0 && ::setuid(65534) != 0) _exit(3);
      const RigClock clock;
      SerialLine line(device.path(), 115200, clock);
    } catch (const std::exception& error) {
      text = error.what();
    }
    _exit(::write(ends[1], text.data(), text.size()) < 0 ? 4 : 0);
  }
  ::close(ends[1]);
  char buffer[512] = {};
  CHECK(::read(ends[0], buffer, sizeof buffer - 1) > 0);
  ::close(ends[0]);
  ::waitpid(child, nullptr, 0);
  CHECK_THAT(buffer, Contains("no permission to open") && Contains("dialout"));
}

TEST_CASE("Two programs cannot share a port, under whatever names", "[rig][pty]") {
  PtyPort device;
  const std::filesystem::path other =
      std::filesystem::temp_directory_path() / ("viscard-port-" + std::to_string(::getpid()));
  std::filesystem::create_symlink(device.path(), other);
  const RigClock clock;
  SerialLine line(device.path(), 115200, clock);
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    try {
      SerialLine second(other.string(), 115200, clock);
      _exit(1);
    } catch (const RigError& error) {
      _exit(std::string(error.what()).find("in use by another program") != std::string::npos ? 0
                                                                                             : 2);
    }
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  std::filesystem::remove(other);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}

TEST_CASE("A stable name finds the device again wherever it comes back", "[rig][pty]") {
  const std::filesystem::path name =
      std::filesystem::temp_directory_path() / ("viscard-by-id-" + std::to_string(::getpid()));
  const RigClock clock;
  for (int i = 0; i < 2; ++i) {  // first ttyUSB0, after replugging ttyUSB1
    PtyPort device;
    std::filesystem::remove(name);
    std::filesystem::create_symlink(device.path(), name);
    SerialLine line(name.string(), 115200, clock);
    LineSplitter splitter;
    device.write("here\n");
    const auto received = read_line(line, splitter, 1.0);
    REQUIRE(received);
    CHECK(received->text == "here");
    device.hang_up();
    CHECK_THROWS_AS(read_line(line, splitter, 1.0), PortHungUp);
  }
  std::filesystem::remove(name);
}

TEST_CASE("Either cable pulled in any phase ends the run with all that came before", "[rig][pty]") {
  const std::string phase =
      GENERATE("tare", "approach", "baseline", "ramp", "hold", "unload", "recovery", "retract");
  const bool is_stage = GENERATE(false, true);
  RigFixture rig(RigFixture::options(40.0));
  when_phase(rig, phase, [&] {
    is_stage ? rig.emulated.pull_stage_cable() : rig.emulated.pull_load_cell_cable();
  });
  const RunOutcome outcome = rig.run(short_plan());
  INFO(phase << (is_stage ? ", stage: " : ", load cell: ") << outcome.reason);
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason, Contains("is gone") || Contains("took no more bytes"));
  CHECK(rig.has_event("phase", phase));
  CHECK(rig.has_event("interrupted", "reason"));
  if (is_stage && phase == "tare") {
    CHECK_THAT(outcome.reason, !Contains("by hand"));  // it had not moved
  } else if (is_stage) {
    CHECK_THAT(outcome.reason, Contains("by hand"));
  } else {
    CHECK_FALSE(rig.emulated.outcome().is_moving);
    CHECK(rig.emulated.outcome().final_position_m < demo_truth(10.0, 7).surface_position_m);
  }
}

TEST_CASE("A stall of this program changes no reading and stops nothing", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options(2.0);
  options.truth.surface_position_m = 0.1e-3;
  RigFixture rig(options);
  int n_progress = 0;
  rig.on_progress = [&](const RunProgress&) {
    if (++n_progress % 5 == 0) ::usleep(300'000);  // as SIGSTOP and SIGCONT would
  };
  TestPlan plan = short_plan();
  plan.approach_speed_m_s = 0.5e-3;
  plan.baseline_s = 0.2;
  plan.hold_s = 0.5;
  plan.recovery_s = 0.0;
  const RunOutcome outcome = rig.run(plan);
  INFO(outcome.reason);
  CHECK(outcome.status == "finished");
  CHECK(outcome.stream.missing == 0);
  CHECK(n_progress > 8);
}

}  // namespace viscard
