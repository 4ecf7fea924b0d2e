#include "io/flow/design/judge_scene.h"

#include "io/basics/parallel.h"
#include "io/flow/scenes/answer_scene.h"
#include "io/flow/sweep/study.h"
#include "io/scenes/scene_file.h"
#include "models/maths/failure_text.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <ctime>
#include <stdexcept>

namespace viscard {
namespace {

double processor_time_s() {
  return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

// Searches for single dimensions that make one failing requirement pass.
class LineRemedies {
 public:
  LineRemedies(const std::string& text, const std::filesystem::path& path,
               const Requirements& requirements, double tolerance)
      : text_(text),
        path_(path),
        requirements_(requirements),
        tolerance_(tolerance),
        dimensions_(dimensions_of(text, path)) {}

  // Fills the remedies of a line within a limit of processor time. A dimension whose search is cut
  // off gets none.
  void add(JudgedLine& line, double search_s) const {
    const double end_s = processor_time_s() + search_s;
    std::atomic<bool> is_complete = true;
    std::vector<std::optional<Remedy>> found(dimensions_.size());
    for_each_in_parallel(dimensions_.size(), [&](std::size_t i) {
      const SceneDimension& dimension = dimensions_[i];
      const QuantityAt quantity_at = [&](double value_m) -> RequiredValue {
        if (processor_time_s() < end_s) return with_value(*line.kind, dimension.key, value_m);
        is_complete = false;
        return {.how = "the time for the search is over"};
      };
      found[i] = seek_remedy(dimension.value_m, line.limit, line.kind->is_upper, quantity_at);
      if (found[i]) found[i]->key = dimension.key;
    });
    for (auto& one : found) {
      if (one) line.remedies.push_back(std::move(*one));
    }
    std::sort(line.remedies.begin(), line.remedies.end(), [](const Remedy& a, const Remedy& b) {
      return std::abs(std::log(a.to_m / a.from_m)) < std::abs(std::log(b.to_m / b.from_m));
    });
    line.is_search_complete = is_complete;
  }

 private:
  RequiredValue with_value(const RequirementKind& kind, const std::string& key,
                           double value_m) const {
    try {
      Scene scene =
          scene_from_toml(scene_text_with(text_, path_, {{key, text_of(value_m, 9)}}), path_).scene;
      common(scene).tolerance = tolerance_;
      return computed(kind, scene, requirements_);
    } catch (const std::exception& error) {
      // What takes too much memory is no remedy; what was judged stands.
      if (dynamic_cast<const StopsWork*>(&error) != nullptr) throw;
      return {.how = error.what()};
    }
  }

  const std::string& text_;
  const std::filesystem::path& path_;
  const Requirements& requirements_;
  double tolerance_;
  std::vector<SceneDimension> dimensions_;
};

JudgedLine judged(const RequirementKind& kind, const Scene& scene,
                  const Requirements& requirements) {
  JudgedLine line;
  line.kind = &kind;
  line.limit = requirements.*kind.limit;
  line.found = computed(kind, scene, requirements);
  line.verdict = verdict_of(line.found, line.limit, kind.is_upper);
  if (line.found.is_answered) {
    line.margin = kind.is_upper ? line.limit / line.found.value : line.found.value / line.limit;
  }
  return line;
}

}  // namespace

bool Judgement::passes() const {
  return std::all_of(lines.begin(), lines.end(),
                     [](const JudgedLine& line) { return line.verdict == Verdict::kPass; });
}

RequiredValue computed(const RequirementKind& kind, const Scene& scene,
                       const Requirements& requirements, const SceneSolver& solve) {
  try {
    return kind.compute(scene, requirements, solve);
  } catch (const std::exception& error) {
    if (!is_refusal(error)) throw;
    return {.how = error.what()};
  }
}

Judgement judge_scene(const std::string& text, const std::filesystem::path& path,
                      const Requirements& requirements, const JudgeOptions& options) {
  SceneFile file = scene_from_toml(text, path);
  if (!file.sweep.is_empty()) {
    throw std::runtime_error(path.string() +
                             ": a scene with a [sweep] cannot be judged; leave the sweep out");
  }
  if (options.tolerance) set_tolerance(*options.tolerance, file.scene);
  const LineRemedies remedies(text, path, requirements, common(file.scene).tolerance);
  std::vector<const RequirementKind*> asked;
  for (const RequirementKind& kind : requirement_kinds()) {
    if (!std::isnan(requirements.*kind.limit)) asked.push_back(&kind);
  }
  Judgement judgement;
  judgement.name = requirements.name;
  // Half of the progress for the lines, half for the search.
  const auto report = [&](std::size_t begun, std::size_t all, const std::string& what) {
    const double share = static_cast<double>(begun) / static_cast<double>(2 * all);
    if (options.progress) options.progress(share, what);
  };
  std::vector<JudgedLine*> failing;
  judgement.lines.reserve(asked.size());
  for (std::size_t i = 0; i < asked.size(); ++i) {
    report(i, asked.size(), asked[i]->key);
    judgement.lines.push_back(judged(*asked[i], file.scene, requirements));
    if (judgement.lines.back().verdict == Verdict::kFail)
      failing.push_back(&judgement.lines.back());
  }
  const double end_s = processor_time_s() + options.search_s;
  for (std::size_t i = 0; i < failing.size(); ++i) {
    report(failing.size() + i, failing.size(),
           std::string(failing[i]->kind->key) + ": dimensions that would pass");
    // Time that a line does not use is left to those after it.
    const double left_s = end_s - processor_time_s();
    remedies.add(*failing[i], left_s / static_cast<double>(failing.size() - i));
  }
  return judgement;
}

}  // namespace viscard
