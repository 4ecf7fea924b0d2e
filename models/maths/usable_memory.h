#pragma once

namespace viscard {

// Memory that this process may use, B: that of the machine, or its limit (ulimit -v) if that is less.
double usable_memory_B();

// Throws std::runtime_error with the numbers if a system of so many unknowns needs more than that.
void require_memory(double unknowns, double needed_B);

}  // namespace viscard
