#pragma once

#include "io/config/config_fields.h"

#include <functional>

namespace viscard {

// Reads the fields that `show` shows from an open scene file.
using FieldReader = std::function<void(const std::function<void(FieldVisitor&)>& show)>;

}  // namespace viscard
