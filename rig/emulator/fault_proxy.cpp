#include "rig/emulator/fault_proxy.h"

#include "rig/emulator/delayed_bytes.h"
#include "rig/emulator/pty_port.h"
#include "rig/lines/rig_clock.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <mutex>
#include <random>
#include <thread>
#include <utility>

namespace viscard {

// One direction of a disturbed line: takes bytes, applies faults at random and gives out what is
// due. Times are wall times.
class FaultProxy::Lane {
 public:
  Lane(const FaultRates& rates, double longest_delay_s, std::uint64_t seed)
      : rates_(rates), longest_delay_s_(longest_delay_s), random_(seed) {}

  void take(std::string bytes, double now_s, FaultCounts& counts);
  std::string due(double now_s) { return bytes_.take_due(now_s); }
  void clear() {
    bytes_.clear();
    busy_until_s_ = -1e300;
  }
  void heal() { rates_ = {}; }
  bool wants_hang_up() const { return wants_hang_up_; }
  void slow_to(double bytes_per_s) { bytes_per_s_ = bytes_per_s; }

 private:
  bool happens(double chance, FaultCounts& counts) {
    const bool does = std::bernoulli_distribution(chance)(random_);
    counts.faults += does ? 1 : 0;
    return does;
  }
  std::size_t below(std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_);
  }
  double upto(double most) { return std::uniform_real_distribution<double>(0.0, most)(random_); }
  void corrupt(std::string& bytes, FaultCounts& counts);
  void push(std::string bytes, double due_s) {
    due_s = std::max(due_s, bytes_.last_due_s());
    if (bytes_per_s_ > 0.0) {
      due_s = std::max(due_s, busy_until_s_) + static_cast<double>(bytes.size()) / bytes_per_s_;
      busy_until_s_ = due_s;
    }
    bytes_.add(due_s, std::move(bytes));
  }

  FaultRates rates_;
  double longest_delay_s_;
  std::mt19937_64 random_;
  DelayedBytes bytes_;
  double bytes_per_s_ = 0.0;
  double busy_until_s_ = -1e300;
  bool wants_hang_up_ = false;
};

void FaultProxy::Lane::corrupt(std::string& bytes, FaultCounts& counts) {
  if (happens(rates_.drop, counts)) {
    const std::size_t at = below(bytes.size());
    bytes.erase(at, 1 + below(8));
    ++counts.corrupted;
  }
  if (!bytes.empty() && happens(rates_.garble, counts)) {
    char& c = bytes[below(bytes.size())];
    const bool is_digit = c >= '0' && c <= '9';
    c = static_cast<char>(is_digit ? '0' + static_cast<char>(below(10)) : c ^ (1 << below(8)));
    ++counts.corrupted;
  }
  if (happens(rates_.insert, counts)) {
    std::string noise(1 + below(8), '\0');
    for (char& c : noise) c = static_cast<char>(below(256));
    bytes.insert(bytes.empty() ? 0 : below(bytes.size()), noise);
    ++counts.corrupted;
  }
}

void FaultProxy::Lane::take(std::string bytes, double now_s, FaultCounts& counts) {
  constexpr double kLongestSplit_s = 0.02;
  ++counts.pieces;
  if (happens(rates_.hang_up, counts)) wants_hang_up_ = true;
  corrupt(bytes, counts);
  if (bytes.empty()) return;
  if (happens(rates_.delay, counts)) now_s += upto(longest_delay_s_);
  if (happens(rates_.split, counts) && bytes.size() > 1) {
    const std::size_t at = 1 + below(bytes.size() - 1);
    push(bytes.substr(0, at), now_s);
    push(bytes.substr(at), now_s + upto(kLongestSplit_s));
  } else {
    push(bytes, now_s);
  }
  if (happens(rates_.duplicate, counts)) push(bytes, now_s);
}

class FaultProxy::Impl {
 public:
  Impl(std::string device_path, const FaultPlan& plan)
      : to_host_B_s_(plan.to_host_B_s),
        device_path_(std::move(device_path)),
        to_host_(plan.to_host, plan.longest_delay_s, 2 * plan.seed),
        to_device_(plan.to_device, plan.longest_delay_s, 2 * plan.seed + 1) {}

  void start() {
    thread_ = std::thread([this] { run(); });
  }

  void end() {
    is_ending_ = true;
    if (thread_.joinable()) thread_.join();
    host_.hang_up();
    close_device();
  }

  // True if bytes have gone to the host.
  bool serve(double now_s) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (is_ending_) return false;
    follow_host();
    const std::size_t n_before = host_.n_sent();
    if (device_ >= 0) pass(now_s);
    return host_.n_sent() > n_before;
  }

  FaultCounts counts() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return counts_;
  }

  std::atomic<bool> is_healed_{false};
  std::atomic<bool> is_cut_{false};
  std::atomic<double> to_host_B_s_;
  PtyPort host_;

 private:
  void run() {
    while (!is_ending_) {
      serve(monotonic_s());
      pollfd entries[2] = {{device_ >= 0 ? host_.descriptor() : -1, POLLIN, 0},
                           {device_, POLLIN, 0}};
      poll(entries, 2, /*timeout ms*/ 1);
    }
  }

  void follow_host() {
    const bool is_open = host_.is_open_by_host();
    if (is_open && device_ < 0 && !counts_.has_hung_up) {
      device_ = open(device_path_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    } else if (!is_open && device_ >= 0) {
      close_device();
      host_.discard();
      to_host_.clear();
      to_device_.clear();
    }
  }

  void pass(double now_s) {
    if (is_healed_) {
      to_host_.heal();
      to_device_.heal();
    }
    to_host_.slow_to(to_host_B_s_);
    if (std::string bytes = host_.read_available(); !bytes.empty()) {
      to_device_.take(std::move(bytes), now_s, counts_);
    }
    std::array<char, 16384> buffer{};
    std::size_t n_got = 0;
    ssize_t n = 0;
    do {
      n = read(device_, buffer.data() + n_got, buffer.size() - n_got);
      n_got += n > 0 ? static_cast<std::size_t>(n) : 0;
    } while (n > 0 && n_got < buffer.size());
    if (n_got > 0) to_host_.take(std::string(buffer.data(), n_got), now_s, counts_);
    const bool is_gone = n == 0 || (n < 0 && errno != EAGAIN && errno != EINTR);
    host_.write(to_host_.due(now_s));
    const std::string down = to_device_.due(now_s);
    if (!down.empty() && write(device_, down.data(), down.size()) < 0 && errno != EAGAIN) {
      counts_.has_hung_up = true;
    }
    if (is_gone || is_cut_ || to_host_.wants_hang_up() || to_device_.wants_hang_up()) {
      counts_.has_hung_up = true;
    }
    if (counts_.has_hung_up) {
      host_.hang_up();
      close_device();
    }
  }

  void close_device() {
    if (device_ >= 0) close(device_);
    device_ = -1;
  }

  std::string device_path_;
  int device_ = -1;
  Lane to_host_, to_device_;
  mutable std::mutex mutex_;  // of counts_
  FaultCounts counts_;
  std::atomic<bool> is_ending_{false};
  std::thread thread_;
};

FaultProxy::FaultProxy(EmulatedRig& rig, const std::string& device_path, const FaultPlan& plan)
    : impl_(std::make_shared<Impl>(device_path, plan)) {
  if (rig.waits()) {
    rig.serve_too([impl = impl_](double now_s) { return impl->serve(now_s); });
  } else {
    impl_->start();
  }
}

FaultProxy::~FaultProxy() {
  impl_->end();
}

std::string FaultProxy::path() const {
  return impl_->host_.path();
}

FaultCounts FaultProxy::counts() const {
  return impl_->counts();
}

void FaultProxy::heal() {
  impl_->is_healed_ = true;
}

void FaultProxy::slow_to(double bytes_per_s) {
  impl_->to_host_B_s_ = bytes_per_s;
}

void FaultProxy::hang_up() {
  impl_->is_cut_ = true;
}

}  // namespace viscard
