#pragma once

#include <string>

namespace viscard {

// The current time in UTC, "2026-01-05T10:00:00Z".
std::string now_iso8601();
// "2026-01-05", UTC.
std::string today();

}  // namespace viscard
