// Instruments behind TCP, on the loopback interface.
#include "rig/lines/port_probe.h"
#include "rig/lines/rig_error.h"
#include "rig/lines/tcp_line.h"

#include <arpa/inet.h>
#include <catch2/catch.hpp>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <string>

using namespace viscard;
using Catch::Matchers::Contains;

namespace {

const RigClock& wall() {
  static const RigClock clock;
  return clock;
}

// An instrument that listens; one client at a time.
class Instrument {
 public:
  Instrument() : listening_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const int yes = 1;
    setsockopt(listening_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    listen_at(0);
  }
  ~Instrument() {
    hang_up();
    ::close(listening_);
  }
  Instrument(const Instrument&) = delete;
  Instrument& operator=(const Instrument&) = delete;

  std::string port() const { return "tcp://127.0.0.1:" + std::to_string(number_); }
  void accept() { client_ = ::accept(listening_, nullptr, nullptr); }
  void say(const std::string& bytes) const {
    REQUIRE(::send(client_, bytes.data(), bytes.size(), MSG_NOSIGNAL) ==
            static_cast<ssize_t>(bytes.size()));
  }
  std::string heard() const {
    std::array<char, 256> buffer{};
    const ssize_t n = ::recv(client_, buffer.data(), buffer.size(), 0);
    return {buffer.data(), static_cast<std::size_t>(std::max<ssize_t>(0, n))};
  }
  void hang_up() {
    if (client_ >= 0) ::close(client_);
    client_ = -1;
  }

 private:
  void listen_at(std::uint16_t number) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(number);
    socklen_t size = sizeof address;
    REQUIRE(::bind(listening_, reinterpret_cast<sockaddr*>(&address), size) == 0);
    REQUIRE(::listen(listening_, 1) == 0);
    REQUIRE(getsockname(listening_, reinterpret_cast<sockaddr*>(&address), &size) == 0);
    number_ = ntohs(address.sin_port);
  }

  int listening_;
  int client_ = -1;
  int number_ = 0;
};

std::string read_all(TcpLine& line, std::size_t count) {
  std::string bytes;
  for (int i = 0; i < 500 && bytes.size() < count; ++i) {
    wait_readable({&line}, wall(), 0.02);
    bytes += line.read_available().bytes;
  }
  return bytes;
}

}  // namespace

TEST_CASE("a port behind TCP names its host and number", "[rig]") {
  for (const char* port :
       {"tcp://", "tcp://:5025", "tcp://10.0.0.1", "tcp://10.0.0.1:", "tcp://a:0", "tcp://a:65536",
        "tcp://a:50 25", "tcp://a:-1", "tcp://[]:5025"}) {
    CAPTURE(port);
    CHECK_THROWS_WITH(TcpLine(port, wall()), Contains("such as tcp://192.168.1.20:5025"));
    CHECK_THAT(port_status(port).trouble, Contains("a host and a number"));
  }
  CHECK(port_status("tcp://[::1]:5025").trouble.empty());
}

TEST_CASE("nobody behind a TCP port is a port that is unavailable", "[rig]") {
  std::string port;
  {
    Instrument gone;
    port = gone.port();
  }
  CHECK_THROWS_AS(TcpLine(port, wall()), PortUnavailable);
  CHECK_THROWS_WITH(TcpLine(port, wall()),
                    Contains("refuses the connection") && Contains("one at a time"));
}

TEST_CASE("bytes pass both ways over TCP, in pieces or together", "[rig]") {
  Instrument instrument;
  const std::unique_ptr<Transport> opened = open_line(instrument.port(), 9600, wall());
  auto& line = dynamic_cast<TcpLine&>(*opened);
  instrument.accept();
  CHECK(line.read_available().bytes.empty());
  line.write("*IDN?\n", 0.5);
  CHECK(instrument.heard() == "*IDN?\n");
  instrument.say("MAKER,MO");
  CHECK(read_all(line, 8) == "MAKER,MO");
  instrument.say("DEL\n1.0\n2.0\n");
  CHECK(read_all(line, 12) == "DEL\n1.0\n2.0\n");
}

TEST_CASE("a port behind TCP is not asked for a baud rate that it does not have", "[rig]") {
  Instrument instrument;
  const auto line = open_line(instrument.port(), 9600, wall());
  CHECK_THAT(line->question(), Contains("port number") && Contains("device server"));
  CHECK_THAT(line->question(), !Contains("00 right"));
}

TEST_CASE("an instrument that closes the connection is gone, and may come back", "[rig]") {
  Instrument instrument;
  TcpLine line(instrument.port(), wall());
  instrument.accept();
  instrument.say("last\n");
  instrument.hang_up();
  CHECK(read_all(line, 5) == "last\n");
  wait_readable({&line}, wall(), 0.5);
  CHECK_THROWS_AS(line.read_available(), PortHungUp);
  REQUIRE(line.reopen());
  instrument.accept();
  instrument.say("again\n");
  CHECK(read_all(line, 6) == "again\n");
}

TEST_CASE("an instrument that stops reading is an error after the time asked for", "[rig]") {
  Instrument instrument;
  TcpLine line(instrument.port(), wall());
  instrument.accept();
  const std::string much(1 << 24, 'x');
  CHECK_THROWS_WITH(line.write(much, 0.2), Contains("stopped reading"));
}
