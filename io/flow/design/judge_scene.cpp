#include "io/flow/design/judge_scene.h"

#include "io/basics/parallel.h"
#include "io/flow/scenes/answer_scene.h"
#include "io/flow/sweep/study.h"
#include "io/scenes/scene_file.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

// Seeks single dimensions that make one line pass.
class LineRemedies {
 public:
  LineRemedies(const std::string& text, const std::filesystem::path& path,
               const Requirements& requirements, double tolerance)
      : text_(text),
        path_(path),
        requirements_(requirements),
        tolerance_(tolerance),
        dimensions_(dimensions_of(text, path)) {}

  std::vector<Remedy> of(const JudgedLine& line) const {
    std::vector<std::optional<Remedy>> found(dimensions_.size());
    for_each_in_parallel(dimensions_.size(), [&](std::size_t i) {
      const SceneDimension& dimension = dimensions_[i];
      const QuantityAt quantity_at = [&](double value_m) {
        return with_value(*line.kind, dimension.key, value_m);
      };
      found[i] = seek_remedy(dimension.value_m, line.limit, line.kind->is_upper, quantity_at);
      if (found[i]) found[i]->key = dimension.key;
    });
    std::vector<Remedy> remedies;
    for (auto& one : found) {
      if (one) remedies.push_back(std::move(*one));
    }
    std::sort(remedies.begin(), remedies.end(), [](const Remedy& a, const Remedy& b) {
      return std::abs(std::log(a.to_m / a.from_m)) < std::abs(std::log(b.to_m / b.from_m));
    });
    return remedies;
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
                       const Requirements& requirements) {
  try {
    return kind.compute(scene, requirements);
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& error) {
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
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const auto report = [&](double part, const std::string& what) {
      if (!options.progress) return;
      options.progress((static_cast<double>(i) + part) / static_cast<double>(asked.size()), what);
    };
    report(0.0, asked[i]->key);
    JudgedLine line = judged(*asked[i], file.scene, requirements);
    if (line.verdict == Verdict::kFail && options.seeks_remedies) {
      report(0.3, std::string(asked[i]->key) + ": dimensions that would pass");
      line.remedies = remedies.of(line);
    }
    judgement.lines.push_back(std::move(line));
  }
  return judgement;
}

}  // namespace viscard
