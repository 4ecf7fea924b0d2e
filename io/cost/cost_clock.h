#pragma once

#include <exception>
#include <functional>
#include <string>

namespace viscard {

// The clocks of a cost study. Processor time belongs to this program alone, so that a busy machine
// does not change the ranking; the wall clock is what a budget is spent on. Tests set their own.
struct CostClock {
  std::function<double()> wall_s;
  std::function<double()> cpu_s;  // of all threads of this process
};
CostClock process_clock();

// Ends work for which there is no time left. No error of the work, so that nobody takes it for one.
class OutOfTime : public std::exception {
 public:
  const char* what() const noexcept override { return "the time for it is over"; }
};

// What a study ran on.
struct CostMachine {
  std::string processor;  // model name; empty: unknown
  int cores = 0;          // that this process may use
  double load = 0.0;      // processes that were running or ready, mean of the minute before
  double share = 0.0;     // processor time over wall time of the whole study
};
CostMachine this_machine();  // without the share

// Memory of this process in bytes; 0 if the system does not say.
double resident_B();
double peak_resident_B();
// Gives freed memory back and lets the peak start anew.
void forget_peak();

}  // namespace viscard
