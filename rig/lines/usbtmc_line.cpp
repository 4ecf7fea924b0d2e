#include "rig/lines/usbtmc_line.h"

#include "rig/lines/port_probe.h"
#include "rig/lines/rig_error.h"

#include <fcntl.h>
#include <linux/usb/tmc.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <utility>

namespace viscard {
namespace {

constexpr std::uint32_t kAnswer_ms = 3000;  // a multimeter at 100 cycles of the mains takes 2 s
constexpr unsigned char kMessageAvailable = 0x10;  // MAV of IEEE 488.2
constexpr std::size_t kMostWaiting = 16;           // messages that the instrument has not taken

bool is_question(const std::string& message) {
  return message.find('?') != std::string::npos;
}

bool is_timeout(int error) {
  return error == ETIMEDOUT || error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
}

}  // namespace

UsbtmcLine::UsbtmcLine(const std::string& path, const RigClock& clock)
    : path_(path), clock_(clock) {
  open();
}

UsbtmcLine::UsbtmcLine(int device, const std::string& name, const RigClock& clock)
    : path_(name), clock_(clock) {
  begin(device);
}

UsbtmcLine::~UsbtmcLine() {
  end();
}

void UsbtmcLine::open() {
  const int device = open_message_device(path_);
  std::uint32_t timeout_ms = kAnswer_ms;
  ioctl(device, USBTMC_IOCTL_SET_TIMEOUT, &timeout_ms);  // kernels before 4.20: 5 s
  begin(device);
}

void UsbtmcLine::begin(int device) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK) != 0) {
    const int error = errno;
    ::close(device);
    throw PortUnavailable("'" + path_ + "' cannot be opened: " + std::strerror(error));
  }
  device_ = device;
  answers_ = ends[0];
  hand_on_ = ends[1];
  unsigned char status = 0;
  has_status_ = ioctl(device_, USBTMC488_IOCTL_READ_STB, &status) == 0;
  has_seen_mav_ = false;
  is_ending_ = false;
  outbox_.clear();
  trouble_.clear();
  thread_ = std::thread([this] { work(); });
}

// What was written before still goes out, such as the command that returns the instrument to its
// front panel; an answer that is being waited for is waited for.
void UsbtmcLine::end() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_ending_ = true;
  }
  wake_.notify_one();
  if (thread_.joinable()) thread_.join();
  for (int* one : {&device_, &answers_, &hand_on_}) {
    if (*one >= 0) ::close(*one);
    *one = -1;
  }
}

bool UsbtmcLine::reopen() {
  end();
  try {
    open();
  } catch (const RigError&) {
    return false;
  }
  return true;
}

// The next message for the instrument; false at the end.
bool UsbtmcLine::take_next(std::string& message) {
  std::unique_lock<std::mutex> lock(mutex_);
  wake_.wait(lock, [this] { return is_ending_ || !outbox_.empty(); });
  if (outbox_.empty()) return false;
  message = std::move(outbox_.front());
  outbox_.pop_front();
  return true;
}

void UsbtmcLine::work() {
  std::string message;
  while (take_next(message)) {
    const ssize_t n = ::write(device_, message.data(), message.size());
    if (n < 0 && is_timeout(errno)) {
      recover();
      continue;
    }
    if (n < 0) return hang_up(std::strerror(errno));
    if (!is_question(message)) continue;
    if (await_answer()) {
      read_answer();
    } else {
      recover();
    }
    if (hand_on_ < 0) return;
  }
}

// False if the instrument announces no answer within the deadline. One that has never announced any
// may not know how, and is read all the same.
bool UsbtmcLine::await_answer() {
  if (!has_status_) return true;
  using Clock = std::chrono::steady_clock;
  const auto until = Clock::now() + std::chrono::milliseconds(kAnswer_ms);
  do {
    unsigned char status = 0;
    if (ioctl(device_, USBTMC488_IOCTL_READ_STB, &status) != 0) return true;
    if ((status & kMessageAvailable) != 0) return has_seen_mav_ = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  } while (Clock::now() < until);
  return !has_seen_mav_;
}

// A read ends with the message; a longer one goes on with the next read.
void UsbtmcLine::read_answer() {
  std::array<char, 4096> buffer{};
  std::string answer;
  ssize_t n = 0;
  do {
    n = ::read(device_, buffer.data(), buffer.size());
    if (n < 0 && is_timeout(errno)) return recover();
    if (n < 0) return hang_up(std::strerror(errno));
    answer.append(buffer.data(), static_cast<std::size_t>(n));
  } while (n == static_cast<ssize_t>(buffer.size()) && answer.back() != '\n');
  if (answer.empty()) return;
  if (answer.back() != '\n') answer += '\n';
  // Readings are far shorter than the pipe; what a program does not fetch is dropped.
  [[maybe_unused]] const ssize_t written = ::write(hand_on_, answer.data(), answer.size());
}

// After a message that was not taken or not answered; without it all later ones may fail, too.
void UsbtmcLine::recover() const {
  ioctl(device_, USBTMC_IOCTL_ABORT_BULK_IN);
  ioctl(device_, USBTMC_IOCTL_CLEAR);
}

void UsbtmcLine::hang_up(const std::string& why) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    trouble_ = why;
  }
  ::close(std::exchange(hand_on_, -1));  // the reader of the pipe notices it
}

Chunk UsbtmcLine::read_available() {
  Chunk chunk{clock_.now_s(), {}};
  std::array<char, 16384> buffer{};
  const ssize_t n = ::read(answers_, buffer.data(), buffer.size());
  if (n > 0) {
    chunk.bytes.assign(buffer.data(), static_cast<std::size_t>(n));
    return chunk;
  }
  if (n < 0) return chunk;
  const std::lock_guard<std::mutex> lock(mutex_);
  throw PortHungUp("'" + path_ + "' is gone (" + trouble_ +
                   "): the cable was pulled or the instrument switched off. Plug it in again and "
                   "check it with: viscard rig check");
}

void UsbtmcLine::write(std::string_view bytes, double /*timeout_s*/) {
  std::string message(bytes);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!trouble_.empty()) {
      throw PortHungUp("'" + path_ + "' took no more messages (" + trouble_ +
                       "): the cable was pulled or the instrument switched off");
    }
    if (!outbox_.empty() && is_question(outbox_.back()) && is_question(message)) {
      outbox_.pop_back();
    }
    if (outbox_.size() >= kMostWaiting) {
      throw RigError("'" + path_ +
                     "' did not take the last messages: the instrument stopped reading. Switch it "
                     "off and on");
    }
    outbox_.push_back(std::move(message));
  }
  wake_.notify_one();
}

}  // namespace viscard
