#pragma once

#include <deque>
#include <optional>

namespace viscard {

// Looks for a force that changes, while the stage stands in contact, as no specimen can change it. A
// relaxing or recovering force changes fastest at the beginning of a hold, so its median over a few
// readings never moves much further than it did just before; after a press it does not rise either.
class HoldWatch {
 public:
  struct Limits {
    double from_s = 0.0;  // the stage stands from then on
    double jump_N = 0.0;  // smallest jump that counts
    // Smallest rise that counts; nothing after an unloading, which lets the force rise.
    std::optional<double> rise_N;
    double settles_s = 0.1;  // so much later than from_s the readings show it
  };
  struct Change {
    bool is_jump = false;  // otherwise a rise over a longer time
    double by_N = 0.0;
    double after_s = 0.0;  // since from_s
  };

  void begin(const Limits& limits);
  void end() { limits_.reset(); }
  // The first change of this hold, when it is found.
  std::optional<Change> take(double force_N, double made_at_s);

 private:
  double median_N(std::size_t ago) const;

  std::optional<Limits> limits_;
  std::deque<double> force_N_;      // the newest readings, newest last
  std::optional<double> lowest_N_;  // median of this hold so far
};

}  // namespace viscard
