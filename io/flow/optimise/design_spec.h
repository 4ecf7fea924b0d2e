#pragma once

#include "io/flow/design/requirements.h"
#include "io/flow/sweep/study.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace viscard {

// A key of the scene that may vary, between two values with the same unit.
struct DesignRange {
  std::string key;              // "geometry.diameter", "materials.pillar.ratio"
  std::string from, to;         // "20 um", "80 um"; without a unit for a ratio
  std::string spacing = "log";  // of steps: "log" or "linear"
};

// A key of the scene that takes one of several values: the file of the film's material, its stock thicknesses, the kind
// of an electrode.
struct DesignChoice {
  std::string key;                  // "materials.pvdf.file"
  std::vector<std::string> values;  // as they stand in a scene
};

// An objective: a requirement's quantity or a key with a range that is to be as large or as small
// as possible.
struct DesignObjective {
  std::string quantity;  // "voltage_per_pressure", "geometry.length"
  std::string goal;      // "largest" or "smallest"
  bool is_largest() const { return goal == "largest"; }
};

// What a specification says (README.md): a scene, what is required, ranges, choices, one or two
// objectives.
struct DesignSpec {
  std::filesystem::path path, scene_path;
  std::string scene_text;
  Requirements requirements;
  std::vector<DesignRange> ranges;
  std::vector<DesignChoice> choices;
  StudyValues chosen;  // those values of choices that scene_text already has (design_choices.h)
  std::vector<DesignObjective> objectives;
  double probability =
      // Probability with which each requirement must hold under the scene's uncertainties; 0: not
      // required.
      0.0;
  std::int64_t seed = 1;          // of the search with the formulas
  std::int64_t front_points = 7;  // between two objectives, ends included
};

// Most combinations of choices, each of which is a search of its own.
inline constexpr std::size_t kMostCombinations = 64;
// How many combinations the choices have; 1 without any.
std::size_t count_combinations(const DesignSpec& spec);

// True for a text that names a scene or has ranges, as specifications do and scenes do not.
bool is_design_spec(const std::string& text);

// Throws std::runtime_error naming file, line, key and what is expected.
DesignSpec read_design_spec(const std::filesystem::path& path);

}  // namespace viscard
