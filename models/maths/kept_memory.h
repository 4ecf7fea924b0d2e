#pragma once

#include <malloc.h>

namespace viscard {

// For main(): freed memory stays with the process for the next matrix instead of going back to the
// system. Factorisations free and allocate the same megabytes again and again, and pages that are
// touched for the first time cost as much as the arithmetic on them: without this, eight modes of a
// material that relaxes (15 526 unknowns) take 1.3 times the processor time, at the same peak. Blocks of
// 32 MiB and more still go back, glibc's largest limit. Source: mallopt(3).
inline void keep_freed_memory() {
  constexpr int kLargestKept_B = 32 << 20;
  constexpr int kMostKept_B = 1 << 30;
  ::mallopt(M_MMAP_THRESHOLD, kLargestKept_B);
  ::mallopt(M_TRIM_THRESHOLD, kMostKept_B);
}

}  // namespace viscard
