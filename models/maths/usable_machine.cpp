#include "models/maths/usable_machine.h"

#include "models/maths/text_of_number.h"

#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>
#include <thread>

namespace viscard {

std::size_t usable_cores() {
  cpu_set_t cores;
  if (sched_getaffinity(0, sizeof cores, &cores) == 0) {
    return static_cast<std::size_t>(std::max(1, CPU_COUNT(&cores)));
  }
  return std::max(1U, std::thread::hardware_concurrency());  // more than 1024 cores
}

double usable_memory_B() {
  double memory_B =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
    memory_B = std::min(memory_B, static_cast<double>(limit.rlim_cur));
  }
  return memory_B;
}

void require_memory(double unknowns, double needed_B) {
  const double usable_B = usable_memory_B();
  if (needed_B <= usable_B) return;
  throw NotEnoughMemory("the next mesh has " + text_of(unknowns, 3) +
                        " unknowns, which need about " + text_of(1e-9 * needed_B, 2) +
                        " GB of memory; " + text_of(1e-9 * usable_B, 2) +
                        " GB can be used. Ask for a larger tolerance or fewer results, or use a "
                        "machine with more memory");
}

}  // namespace viscard
