#include "rig/lines/serial_line.h"

#include "rig/lines/port_probe.h"
#include "rig/lines/rig_error.h"

#include <libserial/SerialPort.h>
#include <poll.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <thread>
#include <utility>

namespace viscard {
namespace {

LibSerial::BaudRate baud_constant(const std::string& path, int baud) {
  using LibSerial::BaudRate;
  static constexpr std::array<std::pair<int, BaudRate>, 14> kTable{
      {{1200, BaudRate::BAUD_1200},
       {2400, BaudRate::BAUD_2400},
       {4800, BaudRate::BAUD_4800},
       {9600, BaudRate::BAUD_9600},
       {19200, BaudRate::BAUD_19200},
       {38400, BaudRate::BAUD_38400},
       {57600, BaudRate::BAUD_57600},
       {115200, BaudRate::BAUD_115200},
       {230400, BaudRate::BAUD_230400},
       {460800, BaudRate::BAUD_460800},
       {500000, BaudRate::BAUD_500000},
       {921600, BaudRate::BAUD_921600},
       {1000000, BaudRate::BAUD_1000000},
       {2000000, BaudRate::BAUD_2000000}}};
  for (const auto& [number, constant] : kTable) {
    if (number == baud) return constant;
  }
  throw RigError("'" + path + "' cannot run at " + std::to_string(baud) +
                 " baud. Set baud to 9600, 19200, 38400, 57600, 115200, 230400, 460800, 500000, "
                 "921600, 1000000 or 2000000, whichever the device uses");
}

void set_framing(LibSerial::SerialPort& port, const std::string& framing) {
  using namespace LibSerial;
  port.SetCharacterSize(framing[0] == '7' ? CharacterSize::CHAR_SIZE_7
                                          : CharacterSize::CHAR_SIZE_8);
  port.SetParity(framing[1] == 'E'   ? Parity::PARITY_EVEN
                 : framing[1] == 'O' ? Parity::PARITY_ODD
                                     : Parity::PARITY_NONE);
  port.SetStopBits(framing[2] == '2' ? StopBits::STOP_BITS_2 : StopBits::STOP_BITS_1);
}

void check_framing(const std::string& framing) {
  const bool is_known = framing.size() == 3 && std::strchr("78", framing[0]) != nullptr &&
                        std::strchr("NEO", framing[1]) != nullptr &&
                        std::strchr("12", framing[2]) != nullptr;
  if (is_known) return;
  throw RigError(
      "framing '" + framing +
      "' in the rig file is unknown. Set data bits, parity and stop bits, such as 8N1 or "
      "7E2");
}

// Closing must not drop DTR: many boards reset when it rises again at the next opening.
void keep_dtr_on_close(int descriptor) {
  termios settings{};
  if (tcgetattr(descriptor, &settings) != 0) return;
  settings.c_cflag &= ~static_cast<tcflag_t>(HUPCL);
  tcsetattr(descriptor, TCSANOW, &settings);
}

// A last word, such as a stop, must not be thrown away with the port. Returns whether the line has taken all.
bool drain(int descriptor) noexcept {
  constexpr int kTries = 60;
  constexpr std::chrono::milliseconds kBetween(5);
  for (int tries = 0, n_left = 0; tries < kTries; ++tries) {
    if (ioctl(descriptor, TIOCOUTQ, &n_left) != 0 || n_left == 0) return true;
    std::this_thread::sleep_for(kBetween);
  }
  return false;
}

// Milliseconds for poll(), rounded up so that a short wait does not become a busy loop.
int poll_ms(double seconds) {
  if (!(seconds > 0.0)) return 0;
  return static_cast<int>(std::ceil(std::min(seconds, 3600.0) * 1e3));
}

}  // namespace

void SerialLine::SafeClose::operator()(LibSerial::SerialPort* port) const noexcept {
  int descriptor = -1;
  try {
    if (port->IsOpen()) {
      descriptor = port->GetFileDescriptor();
      ioctl(descriptor, TIOCNXCL);  // libserial 1.0.0 never releases its exclusive use
      // Closing waits until a device that reads no more has read all, unless that is thrown away.
      tcflush(descriptor, drain(descriptor) ? TCIFLUSH : TCIOFLUSH);
      port->Close();
    }
    delete port;
    return;
  } catch (...) {
    // After a hang-up Close() throws and leaves the port open. It gets another terminal to close.
  }
  int master = -1;
  int slave = -1;
  if (descriptor >= 0 && openpty(&master, &slave, nullptr, nullptr, nullptr) == 0) {
    const bool is_replaced = dup2(slave, descriptor) >= 0;
    ::close(slave);
    try {
      if (is_replaced) {
        port->Close();
        ::close(master);
        delete port;
        return;
      }
    } catch (...) {
    }
    ::close(master);
  }
  // Leaking one object is better than the abort in its destructor.
  if (descriptor >= 0) ::close(descriptor);
}

SerialLine::SerialLine(const std::string& path, int baud, const RigClock& clock,
                       const std::string& framing)
    : path_(path), baud_(baud), framing_(framing), clock_(clock) {
  open();
}

void SerialLine::open() {
  check_framing(framing_);
  const LibSerial::BaudRate rate = baud_constant(path_, baud_);
  lock_descriptor_ = open_exclusively(path_);
  try {
    port_.reset(new LibSerial::SerialPort());
    port_->Open(path_);
    port_->SetBaudRate(rate);
    set_framing(*port_, framing_);
    port_->SetFlowControl(LibSerial::FlowControl::FLOW_CONTROL_NONE);
    descriptor_ = port_->GetFileDescriptor();
    keep_dtr_on_close(descriptor_);
  } catch (const std::exception& error) {
    close();
    throw RigError("'" + path_ + "' opened, but could not be configured: " + error.what() +
                   ". Unplug the device, plug it in again, and retry");
  }
}

SerialLine::~SerialLine() {
  close();
}

void SerialLine::close() {
  port_.reset();
  descriptor_ = -1;
  if (lock_descriptor_ >= 0) ::close(lock_descriptor_);
  lock_descriptor_ = -1;
}

bool SerialLine::reopen() {
  close();
  n_empty_reads_ = 0;
  try {
    open();
  } catch (const RigError&) {
    return false;
  }
  return true;
}

// The bytes of a rig that waits have all been sent at this moment, so all of them are read: how the
// kernel hands them over must not show in the record.
Chunk SerialLine::read_available() {
  Chunk chunk = read_once();
  while (clock_.waits() && !chunk.bytes.empty()) {
    const std::string more = read_once().bytes;
    if (more.empty()) break;
    chunk.bytes += more;
  }
  return chunk;
}

Chunk SerialLine::read_once() {
  pollfd entry{descriptor_, POLLIN, 0};
  const int ready = poll(&entry, 1, 0);
  Chunk chunk{clock_.now_s(), {}};
  if (ready <= 0) return chunk;
  std::array<char, 16384> buffer{};
  const ssize_t n = ::read(descriptor_, buffer.data(), buffer.size());
  if (n > 0) {
    n_empty_reads_ = 0;
    chunk.bytes.assign(buffer.data(), static_cast<std::size_t>(n));
    return chunk;
  }
  if (n < 0 && (errno == EAGAIN || errno == EINTR)) return chunk;
  // "Readable" without bytes means a hang-up; without POLLHUP only if it happens three times.
  const bool is_hung_up = n < 0 || (entry.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0;
  if (is_hung_up || ++n_empty_reads_ >= 3) {
    throw PortHungUp("'" + path_ +
                     "' is gone: the cable was pulled or the device switched off. Plug it in "
                     "again and check it with: viscard rig check");
  }
  return chunk;
}

void SerialLine::write(std::string_view bytes, double timeout_s) {
  const double deadline_s = monotonic_s() + timeout_s;
  while (!bytes.empty()) {
    const ssize_t n = ::write(descriptor_, bytes.data(), bytes.size());
    if (n > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(n));
      continue;
    }
    if (n < 0 && errno != EAGAIN && errno != EINTR) {
      throw PortHungUp("'" + path_ + "' took no more bytes (" + std::strerror(errno) +
                       "): the cable was pulled or the device switched off");
    }
    const double left_s = deadline_s - monotonic_s();
    if (left_s <= 0.0) {
      throw RigError("'" + path_ + "' did not take " + std::to_string(bytes.size()) +
                     " bytes in time: the device stopped reading. Switch it off and on");
    }
    pollfd entry{descriptor_, POLLOUT, 0};
    poll(&entry, 1, poll_ms(left_s));
  }
}

}  // namespace viscard
