#pragma once

// Loops over samples are compiled twice: for any processor, and for one with registers of four
// doubles and fused multiply-add. The program selects the version for its processor when it starts.
// The last digit of a sum may differ between the two.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define VISCARD_WIDE_LOOP __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define VISCARD_WIDE_LOOP
#endif
