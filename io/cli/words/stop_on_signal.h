#pragma once

#include <signal.h>

#include <array>
#include <atomic>
#include <string>

namespace viscard {

// During its lifetime, Ctrl-C, a termination request and a closed terminal only set is_asked(), so
// that the program can stop the stage before it ends. Signals from a closed pipe, a file size limit
// or Ctrl-Z are ignored, so that they cannot end or suspend a program that moves a stage.
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

// During its lifetime, Ctrl-C and a termination request print "viscard: " and the words (how to go on, what is kept)
// before they end the program as they do otherwise. Within another, whose words follow.
class WordsOnSignal {
 public:
  explicit WordsOnSignal(const std::string& words);
  ~WordsOnSignal();
  WordsOnSignal(const WordsOnSignal&) = delete;
  WordsOnSignal& operator=(const WordsOnSignal&) = delete;

 private:
  static constexpr std::array<int, 2> kEnding{SIGINT, SIGTERM};
  std::string outer_;
  std::array<struct sigaction, kEnding.size()> before_{};
};

}  // namespace viscard
