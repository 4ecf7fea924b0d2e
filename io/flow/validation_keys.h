#pragma once

#include <string>

namespace viscard {

class ResultVisitor;
struct ValidationResult;

// The keys of `viscard validate --json`, of a material of this name.
void show_keys(ResultVisitor& v, const ValidationResult& result, const std::string& name);

}  // namespace viscard
