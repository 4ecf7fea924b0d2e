#pragma once

#include <string>

namespace viscard::test {

// Compares a text with the file of that name in tests/golden: words exactly, numbers within
// relative * |expected| + absolute. Returns "" when they agree, else the first line that differs,
// so that
//   CHECK(golden_difference("export.csv", text) == "");
// shows it. With VISCARD_UPDATE_GOLDEN=1 in the environment the file is written instead; review the
// diff before committing it.
std::string golden_difference(const std::string& name, const std::string& text,
                              double relative = 0.0, double absolute = 0.0);

}  // namespace viscard::test
