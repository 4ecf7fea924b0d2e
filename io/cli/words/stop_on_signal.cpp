#include "io/cli/words/stop_on_signal.h"

#include <unistd.h>

namespace viscard {
namespace {

std::atomic<bool> stop_asked{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

extern "C" void ask_to_stop(int) {
  stop_asked = true;
}

// What a handler prints; it may allocate nothing.
std::string words_of_signal;

extern "C" void print_and_end(int number) {
  const ssize_t ignored = ::write(STDERR_FILENO, words_of_signal.data(), words_of_signal.size());
  static_cast<void>(ignored);
  signal(number, SIG_DFL);
  raise(number);
}

}  // namespace

WordsOnSignal::WordsOnSignal(const std::string& words) : outer_(words_of_signal) {
  words_of_signal = "\nviscard: " + words + (outer_.empty() ? "\n" : outer_);
  struct sigaction action {};
  action.sa_handler = print_and_end;
  std::size_t n = 0;
  for (const int number : kEnding) sigaction(number, &action, &before_[n++]);
}

WordsOnSignal::~WordsOnSignal() {
  std::size_t n = 0;
  for (const int number : kEnding) sigaction(number, &before_[n++], nullptr);
  words_of_signal = outer_;
}

StopOnSignal::StopOnSignal() {
  stop_asked = false;
  struct sigaction action {};
  std::size_t n = 0;
  action.sa_handler = ask_to_stop;
  for (const int number : kAsking) sigaction(number, &action, &before_[n++]);
  action.sa_handler = SIG_IGN;
  for (const int number : kIgnored) sigaction(number, &action, &before_[n++]);
}

StopOnSignal::~StopOnSignal() {
  std::size_t n = 0;
  for (const int number : kAsking) sigaction(number, &before_[n++], nullptr);
  for (const int number : kIgnored) sigaction(number, &before_[n++], nullptr);
}

const std::atomic<bool>& StopOnSignal::is_asked() {
  return stop_asked;
}

}  // namespace viscard
