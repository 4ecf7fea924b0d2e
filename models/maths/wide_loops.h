#pragma once

#include <cstddef>

// Loops over samples are compiled twice: for any processor, and for one with registers of four
// doubles and fused multiply-add. The program selects the version for its processor when it starts.
// The last digit of a sum may differ between the two.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define VISCARD_WIDE_LOOP __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define VISCARD_WIDE_LOOP
#endif

namespace viscard {

// Sums in four lanes, added at the end, so that an addition does not wait for the previous one.
constexpr std::size_t kLanes = 4;
using Lanes = double __attribute__((vector_size(kLanes * sizeof(double))));

// Four numbers of an array, at any address: clang takes a vector that is aligned by its type for one at a multiple
// of its size.
struct __attribute__((packed, may_alias)) LanesInMemory {
  Lanes lanes;
};

inline const LanesInMemory* lanes_at(const double* values) {
  return reinterpret_cast<const LanesInMemory*>(values);
}

inline LanesInMemory* lanes_at(double* values) {
  return reinterpret_cast<LanesInMemory*>(values);
}

inline double total(const Lanes& lanes) {
  return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}

}  // namespace viscard
