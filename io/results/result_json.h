#pragma once

#include "models/maths/result_visitor.h"

#include <nlohmann/json.hpp>

#include <functional>

namespace viscard {

// Shows all keys of a result to a visitor.
using ShowKeys = std::function<void(ResultVisitor&)>;

// The object that --json prints, without its head.
nlohmann::ordered_json json_from_keys(const ShowKeys& show);

// The same for a struct that has show_keys().
template <typename Result>
nlohmann::ordered_json json_from_result(const Result& result) {
  return json_from_keys([&](ResultVisitor& v) { show_keys(v, result); });
}

}  // namespace viscard
