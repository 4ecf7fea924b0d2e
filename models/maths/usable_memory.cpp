#include "models/maths/text_of_number.h"
#include "models/maths/usable_machine.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>

namespace viscard {

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
  throw std::runtime_error("the next mesh has " + text_of(unknowns, 3) +
                           " unknowns, which need about " + text_of(1e-9 * needed_B, 2) +
                           " GB of memory; " + text_of(1e-9 * usable_B, 2) +
                           " GB can be used. Ask for a larger tolerance or fewer results, or use a "
                           "machine with more memory");
}

}  // namespace viscard
