#pragma once

#include "io/cli/words/streams.h"

#include <chrono>
#include <string>

namespace viscard {

// Draws a progress bar with the remaining time on one line of stderr, at most ten times a second.
// Draws nothing if stderr is not a terminal.
class Progress {
 public:
  Progress(Streams& streams, std::string title);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // fraction in [0, 1]; note is printed after the bar (a live reading, a file name).
  void show(double fraction, const std::string& note);
  // The same at once, for a note on what follows and may take long.
  void announce(double fraction, const std::string& note);
  // Clears the line; the destructor does it too.
  void clear();

 private:
  Streams& streams_;
  std::string title_;
  std::chrono::steady_clock::time_point started_;
  std::chrono::steady_clock::time_point last_drawn_;
  bool is_drawn_ = false;
};

}  // namespace viscard
