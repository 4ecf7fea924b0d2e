#include "io/flow/optimise/design_spec.h"

#include "io/basics/atomic_file.h"
#include "io/basics/words.h"
#include "io/config/config_fields.h"
#include "io/config/toml_text.h"
#include "io/flow/design/requirement_kinds.h"

#include <toml++/toml.h>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace viscard {
namespace {

[[noreturn]] void refuse_spec(const DesignSpec& spec, const std::string& why) {
  throw std::runtime_error(spec.path.string() + ": " + why);
}

void show_spec(FieldVisitor& v, DesignSpec& spec, std::string& scene) {
  v.text({"scene", "pillar_sensor.toml", true}, scene);
  v.quantity({.key = "probability", .range = Range::kFraction}, spec.probability);
  v.integer("seed", 0, 1'000'000'000, spec.seed);
  v.integer("front", 3, 99, spec.front_points);
  v.section("require", [&](FieldVisitor& r) { show_requirements(r, spec.requirements); });
  v.list(
      "range", spec.ranges.size(), [&](std::size_t n) { spec.ranges.resize(n); },
      [&](FieldVisitor& r, std::size_t i) {
        r.text({"key", "geometry.diameter", true}, spec.ranges[i].key);
        r.text({"from", "20 um", true}, spec.ranges[i].from);
        r.text({"to", "80 um", true}, spec.ranges[i].to);
        r.text({"spacing", "log"}, spec.ranges[i].spacing);
      });
  v.list(
      "choice", spec.choices.size(), [&](std::size_t n) { spec.choices.resize(n); },
      [&](FieldVisitor& c, std::size_t i) {
        c.text({"key", "geometry.electrode.kind", true}, spec.choices[i].key);
        c.texts({"values", "sampled", true}, spec.choices[i].values);
      });
  v.list(
      "objective", spec.objectives.size(), [&](std::size_t n) { spec.objectives.resize(n); },
      [&](FieldVisitor& o, std::size_t i) {
        o.text({"quantity", "voltage_per_pressure", true}, spec.objectives[i].quantity);
        o.text({"goal", "largest", true}, spec.objectives[i].goal);
      });
}

std::vector<std::string> objective_words(const DesignSpec& spec) {
  std::vector<std::string> words;
  for (const RequirementKind& kind : requirement_kinds()) words.emplace_back(kind.key);
  for (const DesignRange& range : spec.ranges) words.push_back(range.key);
  return words;
}

// Keys with a choice join those with a range.
void check_choices(const DesignSpec& spec, std::set<std::string>& keys) {
  for (const DesignChoice& choice : spec.choices) {
    if (!keys.insert(choice.key).second) {
      refuse_spec(spec, "'" + choice.key + "' has a choice, and a range or another choice");
    }
    const std::set<std::string> different(choice.values.begin(), choice.values.end());
    if (different.empty() || different.size() != choice.values.size()) {
      refuse_spec(spec, "the choice of '" + choice.key + "' needs values that differ");
    }
  }
  if (count_combinations(spec) > kMostCombinations) {
    refuse_spec(spec, "the choices have " + std::to_string(count_combinations(spec)) +
                          " combinations, more than " + std::to_string(kMostCombinations) +
                          "; each is a search of its own. Leave some values out");
  }
}

void check_spec(const DesignSpec& spec) {
  if (spec.ranges.empty() || spec.ranges.size() > 8) {
    refuse_spec(spec, "needs one to eight [[range]] with key, from and to");
  }
  std::set<std::string> keys;
  for (const DesignRange& range : spec.ranges) {
    if (!keys.insert(range.key).second)
      refuse_spec(spec, "the range of '" + range.key + "' is given twice");
    if (range.spacing != "log" && range.spacing != "linear") {
      refuse_spec(spec, "the range of '" + range.key +
                            "' has a spacing that is neither \"log\" nor \"linear\"");
    }
  }
  check_choices(spec, keys);
  if (spec.objectives.empty() || spec.objectives.size() > 2) {
    refuse_spec(
        spec, "needs one [[objective]] with quantity and goal, or two for the front between them");
  }
  const std::vector<std::string> known = objective_words(spec);
  for (const DesignObjective& one : spec.objectives) {
    if (std::find(known.begin(), known.end(), one.quantity) == known.end()) {
      refuse_spec(spec, "an objective cannot be '" + one.quantity + "'" +
                            did_you_mean(one.quantity, known) + " There are: " + listed(known));
    }
    if (one.goal != "largest" && one.goal != "smallest") {
      refuse_spec(spec,
                  "the goal of '" + one.quantity + "' is neither \"largest\" nor \"smallest\"");
    }
  }
  if (spec.probability != 0.0 && !(spec.probability >= 0.5 && spec.probability <= 0.9999)) {
    refuse_spec(spec, "probability must lie between 0.5 and 0.9999");
  }
  try {
    validate(spec.requirements);
  } catch (const std::invalid_argument& error) {
    refuse_spec(spec, error.what());
  }
}

}  // namespace

std::size_t count_combinations(const DesignSpec& spec) {
  std::size_t n = 1;
  for (const DesignChoice& choice : spec.choices) n *= choice.values.size();
  return n;
}

bool is_design_spec(const std::string& text) {
  try {
    const toml::table table = parsed_toml(text);
    return !table.contains("geometry") && (table.contains("scene") || table.contains("range"));
  } catch (const std::runtime_error&) {  // toml::parse_error is one
    return false;
  }
}

DesignSpec read_design_spec(const std::filesystem::path& path) {
  DesignSpec spec{.path = path};
  std::string scene;
  const std::string text = read_file(path);
  read_as(FileKind::kDesignTask, text, path.string(), [&] {
    read_toml_fields(text, path.string(), [&](FieldVisitor& v) { show_spec(v, spec, scene); });
  });
  spec.scene_path = path_at_key(text, path, "scene", scene, FileKind::kScene);
  spec.scene_text = read_file(spec.scene_path);
  check_spec(spec);
  return spec;
}

}  // namespace viscard
