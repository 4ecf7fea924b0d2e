#include "fit/intervals/positive_intervals.h"

#include <algorithm>

namespace viscard {

void keep_intervals_positive(const FitOptions& options, FitResult& result) {
  if (options.allow_negative) return;
  const auto keep = [](Interval& interval) {
    interval.low = std::max(0.0, interval.low);
    interval.high = std::max(0.0, interval.high);
  };
  keep(result.E0_interval_95);
  keep(result.E_inf_interval_95);
  keep(result.sum_g_95);
  for (FittedTerm& term : result.terms) {
    keep(term.modulus_Pa_95);
    keep(term.g_95);
  }
  if (result.first) keep(result.first->interval_95);
  if (result.highest) keep(result.highest->interval_95);
}

}  // namespace viscard
