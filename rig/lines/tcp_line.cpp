#include "rig/lines/tcp_line.h"

#include "rig/lines/port_probe.h"
#include "rig/lines/rig_error.h"
#include "rig/lines/serial_line.h"
#include "rig/lines/tcp_port.h"
#include "rig/lines/usbtmc_line.h"

#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>

namespace viscard {
namespace {

constexpr int kConnect_ms = 3000;
constexpr unsigned kSilent_ms = 10'000;

struct FreeAddresses {
  void operator()(addrinfo* list) const { freeaddrinfo(list); }
};

// Waits for the end of connect(); the error number, 0: connected.
int connected(int descriptor, const addrinfo& at) {
  if (::connect(descriptor, at.ai_addr, at.ai_addrlen) == 0) return 0;
  if (errno != EINPROGRESS) return errno;
  pollfd entry{descriptor, POLLOUT, 0};
  if (poll(&entry, 1, kConnect_ms) <= 0) return ETIMEDOUT;
  int error = 0;
  socklen_t size = sizeof error;
  return getsockopt(descriptor, SOL_SOCKET, SO_ERROR, &error, &size) == 0 ? error : errno;
}

void set_option(int descriptor, int level, int name, int value) {
  setsockopt(descriptor, level, name, &value, sizeof value);
}

// Lines leave at once, and a cable that was pulled is noticed.
void configure(int descriptor) {
  set_option(descriptor, IPPROTO_TCP, TCP_NODELAY, 1);
  set_option(descriptor, SOL_SOCKET, SO_KEEPALIVE, 1);
  set_option(descriptor, IPPROTO_TCP, TCP_KEEPIDLE, 4);
  set_option(descriptor, IPPROTO_TCP, TCP_KEEPINTVL, 2);
  set_option(descriptor, IPPROTO_TCP, TCP_KEEPCNT, 3);
  set_option(descriptor, IPPROTO_TCP, TCP_USER_TIMEOUT, static_cast<int>(kSilent_ms));
}

std::string why_not_connected(int error) {
  switch (error) {
    case ECONNREFUSED:
      return "the instrument refuses the connection. Compare the number of the port with its "
             "manual, and close other programs: many instruments serve one at a time";
    case ETIMEDOUT:
      return "nobody answers within 3 s. Check the address, the cable and that the instrument is "
             "on";
    default:
      return std::string(std::strerror(error)) + ". Check the address and the network";
  }
}

}  // namespace

TcpLine::TcpLine(const std::string& port, const RigClock& clock) : port_(port), clock_(clock) {
  open();
}

TcpLine::~TcpLine() {
  close();
}

void TcpLine::open() {
  const std::optional<TcpAddress> address = tcp_address(port_);
  if (!address) throw PortUnavailable("'" + port_ + "' " + trouble_of_tcp_port(port_));
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* list = nullptr;
  const int failure = getaddrinfo(address->host.c_str(), address->number.c_str(), &wanted, &list);
  if (failure != 0) {
    throw PortUnavailable("'" + port_ + "': there is no host '" + address->host + "' (" +
                          gai_strerror(failure) + "). Write its address in numbers");
  }
  const std::unique_ptr<addrinfo, FreeAddresses> all(list);
  int error = EHOSTUNREACH;
  for (const addrinfo* at = all.get(); at != nullptr; at = at->ai_next) {
    const int descriptor =
        ::socket(at->ai_family, at->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, at->ai_protocol);
    if (descriptor < 0) {
      error = errno;
      continue;
    }
    error = connected(descriptor, *at);
    if (error == 0) {
      configure(descriptor);
      descriptor_ = descriptor;
      return;
    }
    ::close(descriptor);
  }
  throw PortUnavailable("'" + port_ + "': " + why_not_connected(error));
}

void TcpLine::close() {
  // Answers that nobody has read would make the system drop what was written last, such as a stop.
  std::array<char, 4096> unread{};
  while (descriptor_ >= 0 && ::recv(descriptor_, unread.data(), unread.size(), MSG_DONTWAIT) > 0) {
  }
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

bool TcpLine::reopen() {
  close();
  try {
    open();
  } catch (const RigError&) {
    return false;
  }
  return true;
}

Chunk TcpLine::read_available() {
  Chunk chunk{clock_.now_s(), {}};
  std::array<char, 16384> buffer{};
  const ssize_t n = ::recv(descriptor_, buffer.data(), buffer.size(), 0);
  if (n > 0) {
    chunk.bytes.assign(buffer.data(), static_cast<std::size_t>(n));
    return chunk;
  }
  if (n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) return chunk;
  throw PortHungUp("'" + port_ + "' is gone: " +
                   (n == 0 ? "the instrument closed the connection" : std::strerror(errno)) +
                   ". Check it with: viscard rig check");
}

void TcpLine::write(std::string_view bytes, double timeout_s) {
  const double deadline_s = monotonic_s() + timeout_s;
  while (!bytes.empty()) {
    const ssize_t n = ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (n > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(n));
      continue;
    }
    if (n < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) {
      throw PortHungUp("'" + port_ + "' took no more bytes (" + std::strerror(errno) +
                       "): the cable was pulled or the instrument switched off");
    }
    const double left_s = deadline_s - monotonic_s();
    if (left_s <= 0.0) {
      throw RigError("'" + port_ + "' did not take " + std::to_string(bytes.size()) +
                     " bytes in time: the instrument stopped reading. Switch it off and on");
    }
    pollfd entry{descriptor_, POLLOUT, 0};
    poll(&entry, 1, static_cast<int>(std::ceil(std::min(left_s, 3600.0) * 1e3)));
  }
}

std::unique_ptr<Transport> open_line(const std::string& port, int baud, const RigClock& clock,
                                     const std::string& framing) {
  if (is_tcp_port(port)) return std::make_unique<TcpLine>(port, clock);
  if (is_usbtmc_port(port)) return std::make_unique<UsbtmcLine>(port, clock);
  return std::make_unique<SerialLine>(port, baud, clock, framing);
}

}  // namespace viscard
