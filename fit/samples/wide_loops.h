#pragma once

// Loops over samples are compiled twice, for any processor and for one with registers of four
// doubles and fused multiply-add; the program takes the one that fits the processor when it starts.
// Sums may differ in their last digit between the two.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define VISCARD_WIDE_LOOP __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define VISCARD_WIDE_LOOP
#endif
