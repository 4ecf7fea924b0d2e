#pragma once

#include "io/cli/words/streams.h"

#include <chrono>
#include <string>

namespace viscard {

// A bar on one line of the terminal, with the time left; silent when stderr is not a terminal.
// Draws at most ten times a second.
class Progress {
 public:
  Progress(Streams& streams, std::string title);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // fraction in [0, 1]; note stands behind the bar (a live reading, a file name).
  void show(double fraction, const std::string& note);
  // Wipes the line; the destructor does so too.
  void clear();

 private:
  Streams& streams_;
  std::string title_;
  std::chrono::steady_clock::time_point started_;
  std::chrono::steady_clock::time_point last_drawn_;
  bool is_drawn_ = false;
};

}  // namespace viscard
