#pragma once

#include "fit/intervals/fit_result.h"

#include <string>

namespace viscard {

// One test of a material and its own fit, made with FitOptions::keep_rows.
struct MaterialTest {
  std::string name;  // for messages: "creep"
  FitResult own;
};

}  // namespace viscard
