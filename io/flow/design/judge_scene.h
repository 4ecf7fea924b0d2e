#pragma once

#include "io/flow/design/remedies.h"
#include "io/flow/design/requirement_kinds.h"
#include "io/flow/design/verdict.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// One requirement, judged.
struct JudgedLine {
  const RequirementKind* kind = nullptr;
  double limit = 0.0;
  RequiredValue found;
  Verdict verdict = Verdict::kNotAnswered;
  double margin = 0.0;  // limit over value, or its inverse for a lower limit: below 1 it fails
  std::vector<Remedy> remedies;    // of a line that fails: single dimensions, nearest first
  bool is_search_complete = true;  // the time was sufficient for all remedies
};

struct Judgement {
  std::string name;               // of the requirements
  std::vector<JudgedLine> lines;  // in the order of requirement_kinds()
  bool passes() const;            // every line
};

struct JudgeOptions {
  std::optional<double> tolerance;  // instead of the scene's
  // Processor time for the search of dimensions that would pass, shared between the failing lines;
  // 0: no search.
  double search_s = 60.0;
  // Called with the fraction done and what is done next; may be empty.
  std::function<void(double, const std::string&)> progress;
};

// Judges the scene `text` in the file `path` (messages show it, its folder holds the material files).
// Uncertain quantities have their values. Throws std::runtime_error if the scene cannot be read or holds
// a sweep, std::invalid_argument for a tolerance that its kind does not support.
Judgement judge_scene(const std::string& text, const std::filesystem::path& path,
                      const Requirements& requirements, const JudgeOptions& options);

// The quantity of a scene. If `solve` refuses, the value is "not answered", with the reason.
RequiredValue computed(const RequirementKind& kind, const Scene& scene,
                       const Requirements& requirements, const SceneSolver& solve = simulate);

}  // namespace viscard
