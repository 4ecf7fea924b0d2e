#pragma once

#include <cstddef>

namespace viscard {

// Number of processor cores that this process may use, at least 1. Schedulers (mpirun, Slurm, containers,
// taskset) often give a process fewer than the machine has.
std::size_t usable_cores();

}  // namespace viscard
