#pragma once

#include "io/flow/design/requirements.h"

namespace viscard {

// What a requirement comes to. A quantity that is nearer to the limit than its error is undecided.
enum class Verdict { kPass, kFail, kUndecided, kNotAnswered };
// "pass", "fail", "undecided", "not answered".
const char* word_of(Verdict verdict);
// The verdict of a value with its error on a limit.
Verdict verdict_of(const RequiredValue& value, double limit, bool is_upper);

}  // namespace viscard
