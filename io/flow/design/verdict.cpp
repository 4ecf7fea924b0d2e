#include "io/flow/design/verdict.h"

#include <cmath>

namespace viscard {

const char* word_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::kPass:
      return "pass";
    case Verdict::kFail:
      return "fail";
    case Verdict::kUndecided:
      return "undecided";
    case Verdict::kNotAnswered:
      return "not answered";
  }
  return "not answered";
}

Verdict verdict_of(const RequiredValue& found, double limit, bool is_upper) {
  if (!found.is_answered) return Verdict::kNotAnswered;
  // Tolerance for exact values that equal their limit; these pass.
  constexpr double kRounding = 1e-12;
  const double spare = (is_upper ? limit - found.value : found.value - limit) + kRounding * limit;
  if (std::abs(spare) < found.error_estimate) return Verdict::kUndecided;
  return spare >= 0.0 ? Verdict::kPass : Verdict::kFail;
}

}  // namespace viscard
