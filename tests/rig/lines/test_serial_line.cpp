#include "rig/emulator/pty_port.h"
#include "rig/lines/port_probe.h"
#include "rig/lines/rig_error.h"
#include "rig/lines/serial_line.h"
#include "tests/rig/read_line.h"

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <string>

namespace viscard {
namespace {

const RigClock& wall() {
  static const RigClock clock;
  return clock;
}

}  // namespace

TEST_CASE("a port that cannot be used is refused with the reason", "[rig][pty]") {
  using Catch::Matchers::Contains;
  SECTION("missing") {
    CHECK_THROWS_WITH(SerialLine("/dev/no_such_port", 115200, wall()),
                      Contains("there is no port"));
  }
  SECTION("none given") {
    CHECK_THROWS_WITH(SerialLine("", 115200, wall()), Contains("no port is given"));
  }
  SECTION("a regular file") {
    char name[] = "/tmp/viscard_regular_XXXXXX";
    const int descriptor = mkstemp(name);
    REQUIRE(descriptor >= 0);
    CHECK_THROWS_WITH(SerialLine(name, 115200, wall()), Contains("is a regular file"));
    close(descriptor);
    std::remove(name);
  }
  SECTION("a device that is no terminal: libserial would abort on closing it") {
    CHECK_THROWS_WITH(SerialLine("/dev/null", 115200, wall()), Contains("without a serial line"));
  }
  SECTION("a folder") {
    CHECK_THROWS_WITH(SerialLine("/tmp", 9600, wall()), Contains("a folder"));
  }
  SECTION("baud rate that does not exist") {
    PtyPort device;
    CHECK_THROWS_WITH(SerialLine(device.path(), 123456, wall()), Contains("123456 baud"));
  }
  SECTION("busy") {
    PtyPort device;
    SerialLine first(device.path(), 115200, wall());
    CHECK_THROWS_WITH(SerialLine(device.path(), 115200, wall()), Contains("in use by another"));
  }
}

TEST_CASE("a port that was closed can be opened again", "[rig][pty]") {
  PtyPort device;
  for (int i = 0; i < 3; ++i) {
    SerialLine line(device.path(), 115200, wall());
    device.write("hello\n");
    LineSplitter splitter;
    const auto received = read_line(line, splitter, 1.0);
    REQUIRE(received);
    CHECK(received->text == "hello");
  }
}

TEST_CASE("bytes pass unchanged in both directions, 8 bits wide", "[rig][pty]") {
  PtyPort device;
  SerialLine line(device.path(), 115200, wall());
  std::string all;
  for (int i = 0; i < 256; ++i) all += static_cast<char>(i);
  line.write(all, 1.0);
  std::string there;
  for (int i = 0; i < 100 && there.size() < 256; ++i) {
    there += device.read_available();
    usleep(1000);
  }
  CHECK(there == all);
  device.write(all);
  std::string back;
  for (int i = 0; i < 100 && back.size() < 256; ++i) {
    wait_readable({&line}, wall(), 0.01);
    back += line.read_available().bytes;
  }
  CHECK(back == all);
}

TEST_CASE("what was written last, such as a stop, is not lost when the port is closed",
          "[rig][pty]") {
  PtyPort device;
  {
    SerialLine line(device.path(), 115200, wall());
    line.write("M410\n", 1.0);
  }
  std::string there;
  for (int i = 0; i < 100 && there.size() < 5; ++i) {
    there += device.read_available();
    usleep(1000);
  }
  CHECK(there == "M410\n");
}

TEST_CASE("a pulled cable is a hang-up after the last bytes, and closing does not abort",
          "[rig][pty]") {
  auto device = std::make_unique<PtyPort>();
  auto line = std::make_unique<SerialLine>(device->path(), 115200, wall());
  LineSplitter splitter;
  device->write("last words\nhalf a li");
  REQUIRE(read_line(*line, splitter, 1.0)->text == "last words");
  device->hang_up();
  CHECK_THROWS_AS(read_line(*line, splitter, 5.0), PortHungUp);
  CHECK_THROWS_AS(line->write("?", 0.1), PortHungUp);
  line.reset();  // libserial's own destructor would end the process here
  SUCCEED("closed after the hang-up");
}

TEST_CASE("descriptors are released after a hang-up", "[rig][pty]") {
  const auto lowest_free = [] {
    const int descriptor = open("/dev/null", O_RDONLY);
    close(descriptor);
    return descriptor;
  };
  const int before = lowest_free();
  for (int i = 0; i < 5; ++i) {
    PtyPort device;
    SerialLine line(device.path(), 115200, wall());
    device.hang_up();
    CHECK_THROWS_AS(line.write("x", 0.1), PortHungUp);
  }
  CHECK(lowest_free() == before);
}

TEST_CASE("a deadline without a line returns nothing and keeps the bytes received", "[rig][pty]") {
  PtyPort device;
  SerialLine line(device.path(), 115200, wall());
  LineSplitter splitter;
  device.write("be");
  CHECK_FALSE(read_line(line, splitter, 0.02));
  device.write("gun\n");
  const auto received = read_line(line, splitter, 1.0);
  REQUIRE(received);
  CHECK(received->text == "begun");
}

TEST_CASE("a mebibyte without a line end is dropped, and the stream continues", "[rig][pty]") {
  PtyPort device;
  SerialLine line(device.path(), 115200, wall());
  LineSplitter splitter;
  device.write(std::string(1 << 20, 'x') + "\nafter\n");
  std::optional<ReceivedLine> received;
  for (int i = 0; i < 20000 && !received; ++i) {
    received = read_line(line, splitter, 0.001);
    device.write("");
  }
  REQUIRE(received);
  CHECK(received->text == "after");
  CHECK(splitter.n_overlong() == 1);
}

TEST_CASE("writing to a device that does not read ends at the deadline", "[rig][pty]") {
  PtyPort device;
  SerialLine line(device.path(), 115200, wall());
  CHECK_THROWS_WITH(line.write(std::string(1 << 20, 'x'), 0.05),
                    Catch::Matchers::Contains("stopped reading"));
}

}  // namespace viscard
