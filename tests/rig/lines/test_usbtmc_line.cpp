// USB-TMC: a pair of sockets that keeps the borders of messages stands for the kernel's device.
#include "rig/cells/gauge_load_cell.h"
#include "rig/lines/port_probe.h"
#include "rig/lines/rig_error.h"
#include "rig/lines/tcp_line.h"
#include "rig/lines/usbtmc_line.h"
#include "rig/open_devices.h"

#include <catch2/catch.hpp>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

const RigClock& usbtmc_clock() {
  static const RigClock clock;
  return clock;
}

// The far end of the cable. A read on the near end without an answer fails after 0.2 s.
class UsbtmcInstrument {
 public:
  UsbtmcInstrument() {
    std::signal(SIGPIPE, SIG_IGN);
    REQUIRE(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends_.data()) == 0);
    const timeval short_time{0, 200'000};
    for (const int end : ends_) {
      REQUIRE(setsockopt(end, SOL_SOCKET, SO_RCVTIMEO, &short_time, sizeof short_time) == 0);
    }
  }
  ~UsbtmcInstrument() { unplug(); }
  UsbtmcInstrument(const UsbtmcInstrument&) = delete;
  UsbtmcInstrument& operator=(const UsbtmcInstrument&) = delete;

  int near_end() const { return ends_[0]; }  // closed by the line
  int far_end() const { return ends_[1]; }
  void unplug() {
    if (ends_[1] >= 0) ::close(ends_[1]);
    ends_[1] = -1;
  }
  // One message; "" if none comes within 0.2 s.
  std::string heard() const {
    std::array<char, 256> buffer{};
    const ssize_t n = ::recv(ends_[1], buffer.data(), buffer.size(), 0);
    return {buffer.data(), static_cast<std::size_t>(n > 0 ? n : 0)};
  }
  void answer(const std::string& message) const {
    REQUIRE(::send(ends_[1], message.data(), message.size(), MSG_NOSIGNAL) ==
            static_cast<ssize_t>(message.size()));
  }

 private:
  std::array<int, 2> ends_{-1, -1};
};

// What has come when the line has been quiet for quiet_s.
std::string fetched(UsbtmcLine& line, std::size_t count, double quiet_s = 1.0) {
  std::string bytes;
  const double until_s = monotonic_s() + quiet_s;
  while (bytes.size() < count && monotonic_s() < until_s) {
    wait_readable({&line}, usbtmc_clock(), 0.02);
    bytes += line.read_available().bytes;
  }
  return bytes;
}

TEST_CASE("a USB-TMC question is one message, and its answer becomes a line", "[rig]") {
  UsbtmcInstrument instrument;
  UsbtmcLine line(instrument.near_end(), "/dev/usbtmc0", usbtmc_clock());
  line.write("*CLS\n", 0.5);
  CHECK(instrument.heard() == "*CLS\n");
  line.write("READ?\n", 0.5);
  CHECK(instrument.heard() == "READ?\n");
  instrument.answer("+1.25E-03");  // without a newline, as some do
  CHECK(fetched(line, 10) == "+1.25E-03\n");
  line.write("*IDN?\n", 0.5);
  CHECK(instrument.heard() == "*IDN?\n");
  const std::string name = std::string(4096 + 100, 'x') + "\n";  // longer than one read
  instrument.answer(name.substr(0, 4096));
  instrument.answer(name.substr(4096));
  CHECK(fetched(line, name.size()) == name);
}

TEST_CASE("a USB-TMC message without a question is not read after", "[rig]") {
  UsbtmcInstrument instrument;
  UsbtmcLine line(instrument.near_end(), "/dev/usbtmc0", usbtmc_clock());
  for (const char* words : {"CONF:VOLT:DC\n", "TRIG:SOUR IMM\n"}) line.write(words, 0.5);
  CHECK(instrument.heard() == "CONF:VOLT:DC\n");
  CHECK(instrument.heard() == "TRIG:SOUR IMM\n");  // at once, not after a deadline
  CHECK(line.read_available().bytes.empty());
}

TEST_CASE("a USB-TMC answer that does not come holds up neither the program nor later answers",
          "[rig]") {
  UsbtmcInstrument instrument;
  UsbtmcLine line(instrument.near_end(), "/dev/usbtmc0", usbtmc_clock());
  line.write("READ?\n", 0.5);
  CHECK(instrument.heard() == "READ?\n");
  const double before_s = monotonic_s();
  for (int i = 0; i < 100; ++i) line.write("READ?\n", 0.5);  // one of them is kept
  CHECK(line.read_available().bytes.empty());
  CHECK(monotonic_s() - before_s < 0.1);
  std::string asked_again;
  for (int i = 0; i < 5 && asked_again.empty(); ++i) asked_again = instrument.heard();
  REQUIRE(asked_again == "READ?\n");
  instrument.answer("2\n");
  CHECK(fetched(line, 2) == "2\n");
  CHECK(instrument.heard().empty());
}

TEST_CASE("a USB-TMC instrument that is unplugged is gone", "[rig]") {
  UsbtmcInstrument instrument;
  UsbtmcLine line(instrument.near_end(), "/dev/usbtmc0", usbtmc_clock());
  instrument.unplug();
  line.write("READ?\n", 0.5);
  CHECK_THROWS_AS(fetched(line, 1), PortHungUp);
  CHECK_THROWS_WITH(line.write("READ?\n", 0.5), Contains("/dev/usbtmc0"));
}

TEST_CASE("a multimeter is read over USB-TMC", "[rig]") {
  UsbtmcInstrument instrument;
  std::vector<std::string> commands;
  std::atomic<bool> is_done{false};
  std::thread answering([&] {
    while (!is_done) {
      const std::string message = instrument.heard();
      if (message.empty()) continue;
      commands.push_back(message);
      if (message.find('?') == std::string::npos) continue;
      const bool is_reading = message.find("READ?") != std::string::npos;
      const bool is_error = message.find("ERR") != std::string::npos;
      const std::string text = is_reading ? "+1.50000000E+00\n"
                               : is_error ? "+0,\"No error\"\n"
                                          : "MAKER,34401A,0,1\n";
      ::send(instrument.far_end(), text.data(), text.size(), MSG_NOSIGNAL);
    }
  });
  std::vector<double> volts;
  {
    UsbtmcLine line(instrument.near_end(), "/dev/usbtmc0", usbtmc_clock());
    LoadCellConfig config;
    config.driver = "scpi";
    GaugeLoadCell cell(line, config, usbtmc_clock(), [](const RunRecord&) {});
    cell.set_listener([&](const LoadSample& sample) {
      if (sample.volts) volts.push_back(*sample.volts);
    });
    const Pump pump = [&] {
      wait_readable({&line}, usbtmc_clock(), 0.01);
      cell.service();
    };
    CHECK_NOTHROW(cell.connect(pump));
    const double until_s = monotonic_s() + 5.0;
    while (volts.size() < 5 && monotonic_s() < until_s) pump();
  }
  is_done = true;
  answering.join();
  REQUIRE(volts.size() >= 5);
  CHECK(volts[4] == 1.5);
  REQUIRE_FALSE(commands.empty());
}

TEST_CASE("USB-TMC serves SCPI only, and an absent device is named", "[rig]") {
  CHECK(is_usbtmc_port("/dev/usbtmc3"));
  CHECK_FALSE(is_usbtmc_port("/dev/ttyUSB0"));
  CHECK_THROWS_WITH(open_line("/dev/usbtmc77", 9600, usbtmc_clock()),
                    Contains("there is no port '/dev/usbtmc77'"));
  RigConfig rig;
  rig.stage.port = "/dev/ttyUSB0";
  rig.load_cell.driver = "mark10";
  rig.load_cell.port = "/dev/usbtmc0";
  CHECK_THROWS_WITH(check_devices(rig), Contains("USB-TMC") && Contains("mark10"));
  rig.load_cell.driver = "scpi";
  CHECK_NOTHROW(check_devices(rig));
}

}  // namespace
}  // namespace viscard
