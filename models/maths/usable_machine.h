#pragma once

#include <cstddef>
#include <stdexcept>

// What this process may use of the machine.
namespace viscard {

// Number of processor cores that this process may use, at least 1. Schedulers (mpirun, Slurm, containers,
// taskset) often give a process fewer than the machine has.
std::size_t usable_cores();

// Memory that this process may use, B: that of the machine, or its limit (ulimit -v) if that is less.
double usable_memory_B();

// This machine, now, has too little memory for the work; another one, or this one later, may have enough.
class NotEnoughMemory : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Throws NotEnoughMemory with the numbers if a system of so many unknowns needs more than that.
void require_memory(double unknowns, double needed_B);

}  // namespace viscard
