// Names, permissions and exclusive use of ports, through real pseudo-terminals.
#include "rig/emulator/pty_port.h"
#include "rig/lines/rig_error.h"
#include "rig/lines/serial_line.h"
#include "tests/rig/read_line.h"

#include <catch2/catch.hpp>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

}  // namespace

TEST_CASE("a port that the user may not open is refused with the group to join", "[rig][pty]") {
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

TEST_CASE("two programs cannot share a port, even under different names", "[rig][pty]") {
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

TEST_CASE("a stable name finds the device again after it was plugged in elsewhere", "[rig][pty]") {
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

}  // namespace viscard
