#pragma once

#include <cstddef>

// What this process may use of the machine.
namespace viscard {

// Number of processor cores that this process may use, at least 1. Schedulers (mpirun, Slurm, containers,
// taskset) often give a process fewer than the machine has.
std::size_t usable_cores();

// Memory that this process may use, B: that of the machine, or its limit (ulimit -v) if that is less.
double usable_memory_B();

// Throws std::runtime_error with the numbers if a system of so many unknowns needs more than that.
void require_memory(double unknowns, double needed_B);

}  // namespace viscard
