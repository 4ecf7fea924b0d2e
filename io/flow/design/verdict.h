#pragma once

#include "io/flow/design/requirements.h"

namespace viscard {

// The verdict on a requirement. If the distance of a quantity to the limit is smaller than its
// error, it is undecided.
enum class Verdict { kPass, kFail, kUndecided, kNotAnswered };
// "pass", "fail", "undecided", "not answered".
const char* word_of(Verdict verdict);
// The verdict of a value with its error on a limit.
Verdict verdict_of(const RequiredValue& value, double limit, bool is_upper);

}  // namespace viscard
