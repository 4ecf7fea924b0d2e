#pragma once

#include "models/maths/interval.h"
#include "models/uncertainty/uncertain_input.h"

#include <cstdint>
#include <vector>

namespace viscard {

struct SamplingOptions {
  std::size_t n_answers = 10000;  // at most; there are at least 64 per input
  std::uint64_t seed = 20;
};

// Part of the variance that one input causes.
struct VarianceShare {
  double alone = 0.0;           // first-order Sobol' index
  double with_others = 0.0;     // total index: alone, and jointly with other inputs
  double standard_error = 0.0;  // of `alone`, from the scatter between replicates
};

struct SampledResult {
  double mean = 0.0, deviation = 0.0;  // of the samples that have an answer
  // Samples without an answer count as beyond either end. Infinite if they are more than the 2.5 % that
  // may lie there.
  Interval interval_95;
  double failed_share = 0.0;          // of the samples of the interval
  double end_error = 0.0;             // standard error of the ends of the interval
  std::vector<VarianceShare> shares;  // one for each input
};

struct SampledAnswer {
  std::vector<SampledResult> results;
  std::size_t n_answers = 0;
  std::size_t n_failed = 0;  // points without an answer; means and shares leave them out
};

// Variance shares and intervals from a Sobol' sequence, in 8 replicates with shifts of their own. First
// order indices as Saltelli et al., Comput. Phys. Commun. 181 (2010) 259, table 2 (b), and total ones as
// Jansen, Comput. Phys. Commun. 117 (1999) 35, take them, with a polynomial of degree 2 fitted to the
// samples, whose indices are known, as control variate: only what it lacks is sampled. Throws
// std::runtime_error if more than half of the points have no answer.
SampledAnswer sampled_answer(const BatchFunction& function,
                             const std::vector<UncertainInput>& inputs,
                             const SamplingOptions& options);

}  // namespace viscard
