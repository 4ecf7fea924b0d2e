#include "rig/emulator/fault_proxy.h"

#include "rig/emulator/faulty_lane.h"
#include "rig/emulator/pty_port.h"
#include "rig/lines/rig_clock.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <mutex>
#include <thread>
#include <utility>

namespace viscard {
namespace {

constexpr int kNap_ms = 1;

}  // namespace

class FaultProxy::Impl {
 public:
  Impl(std::string device_path, const FaultPlan& plan)
      : device_path_(std::move(device_path)),
        to_host_(plan.to_host, plan.longest_delay_s, 2 * plan.seed),
        to_device_(plan.to_device, plan.longest_delay_s, 2 * plan.seed + 1),
        thread_([this] { run(); }) {}

  ~Impl() {
    is_ending_ = true;
    thread_.join();
    close_device();
  }

  FaultCounts counts() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return counts_;
  }

  std::atomic<bool> is_healed_{false};
  std::atomic<bool> is_cut_{false};
  PtyPort host_;

 private:
  void run() {
    while (!is_ending_) {
      follow_host();
      pollfd entries[2] = {{device_ >= 0 ? host_.descriptor() : -1, POLLIN, 0},
                           {device_, POLLIN, 0}};
      poll(entries, 2, kNap_ms);
      if (device_ < 0) continue;
      const std::lock_guard<std::mutex> lock(mutex_);
      pass();
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

  void pass() {
    if (is_healed_) {
      to_host_.heal();
      to_device_.heal();
    }
    const double now_s = monotonic_s();
    if (std::string bytes = host_.read_available(); !bytes.empty()) {
      to_device_.take(std::move(bytes), now_s, counts_);
    }
    std::array<char, 4096> buffer{};
    const ssize_t n = read(device_, buffer.data(), buffer.size());
    if (n > 0) {
      to_host_.take(std::string(buffer.data(), static_cast<std::size_t>(n)), now_s, counts_);
    }
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
  FaultyLane to_host_, to_device_;
  mutable std::mutex mutex_;  // of counts_
  FaultCounts counts_;
  std::atomic<bool> is_ending_{false};
  std::thread thread_;
};

FaultProxy::FaultProxy(const std::string& device_path, const FaultPlan& plan)
    : impl_(std::make_unique<Impl>(device_path, plan)) {}

FaultProxy::~FaultProxy() = default;

std::string FaultProxy::path() const {
  return impl_->host_.path();
}

FaultCounts FaultProxy::counts() const {
  return impl_->counts();
}

void FaultProxy::heal() {
  impl_->is_healed_ = true;
}

void FaultProxy::hang_up() {
  impl_->is_cut_ = true;
}

}  // namespace viscard
