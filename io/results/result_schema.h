#pragma once

#include "io/results/result_json.h"

#include <string>
#include <vector>

namespace viscard {

// A result that a command prints with --json, by examples: for one key of each kind that it can have.
// Lists may be empty and optional values missing; the visitor shows default ones. Keys that not all
// examples have are not always there.
struct DescribedResult {
  std::string name;   // "fit", of viscard-fit/1
  std::string title;  // "viscard fit FILE"
  std::vector<ShowKeys> examples;
  bool has_inputs = true;  // the head names the files that were read
};

// By one example, whose values are those of the default constructor.
template <typename Result>
DescribedResult described(const char* name, const char* title) {
  return {name, title, {[](ResultVisitor& v) { show_keys(v, Result{}); }}};
}

// JSON Schema (draft 2020-12) of the object with its head.
nlohmann::ordered_json schema_of(const DescribedResult& result);

// The keys of all results as Markdown, one table for each.
std::string table_of_keys(const std::vector<DescribedResult>& results);

// One line for each key, "fit terms[].g: number or null", of whose loss a test warns.
std::string list_of_keys(const std::vector<DescribedResult>& results);

}  // namespace viscard
