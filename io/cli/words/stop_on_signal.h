#pragma once

#include <signal.h>

#include <array>
#include <atomic>

namespace viscard {

// While it lives, Ctrl-C, termination and a closed terminal ask for a stop instead of ending the
// program, so that the stage is stopped first; and nothing else that a terminal, a full disk quota
// or a closed pipe sends can end or suspend a program that moves a stage.
class StopOnSignal {
 public:
  StopOnSignal();
  ~StopOnSignal();
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;

  static const std::atomic<bool>& is_asked();

 private:
  static constexpr std::array<int, 3> kAsking{SIGINT, SIGTERM, SIGHUP};
  static constexpr std::array<int, 4> kIgnored{SIGPIPE, SIGXFSZ, SIGTSTP, SIGTTOU};
  std::array<struct sigaction, kAsking.size() + kIgnored.size()> before_{};
};

}  // namespace viscard
