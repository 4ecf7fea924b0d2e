#pragma once

#include "io/basics/inputs.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace viscard {

// A parameter of a study: the values that a key of the scene takes.
struct StudyParameter {
  std::string key;                  // "geometry.diameter"
  std::vector<std::string> values;  // as they stand in a scene: "40 um", "0.33", "off"
  // Or a range, with the same unit at both ends.
  std::string from, to;
  std::int64_t count = 0;          // of a grid
  std::string spacing = "linear";  // or "log"
};

// What a study file says. Without n_points every combination of the values is a point, the first
// parameter slowest; with it Sobol' points in the ranges.
struct Study {
  std::filesystem::path path, scene_path;
  std::string scene_text;
  std::vector<StudyParameter> parameters;
  std::int64_t n_points = 0;               // of a Sobol' sequence; 0: a grid or rows
  bool is_rows = false;                    // the n-th values of all parameters are the n-th point
  std::vector<std::vector<double>> sobol;  // shares of the ranges, 0 to 1, by point
  // The study, its scene and every file that the scene names at any value of a parameter. Names are
  // relative to the folder of the study, so that they are the same on another machine.
  std::vector<InputFile> inputs;
  std::string besides;  // what else its answers depend on, such as an option of the command
};

// Studies are TOML:
//   scene = "pillar_sensor.toml"          # beside the study
//   points = 1000                         # leave it out for a grid
//   rows = true                           # the n-th values of all parameters are one point
//   [[parameter]]
//   key = "geometry.diameter"             # an entry of a list by its number: "shape.at.2"
//   values = ["30 um", "40 um"]           # or from, to and (in a grid) count; spacing = "log"
// Throws std::runtime_error with file, line and what is expected.
Study read_study(const std::filesystem::path& path);

// A scene with a [sweep] of its own as a study without parameters, which has the scene as its file.
Study study_of_scene(const std::filesystem::path& scene, const std::string& besides);

std::int64_t count_points(const Study& study);

// Keys and values of a point, counted from 0.
using StudyValues = std::vector<std::pair<std::string, std::string>>;
StudyValues values_at(const Study& study, std::int64_t point);

// The text of a scene with these values in the places of its own; messages show `path`. Throws
// std::runtime_error if the text is not TOML or a key lies in no section of it.
std::string scene_text_with(const std::string& scene, const std::filesystem::path& path,
                            const StudyValues& values);
// The same of the study's scene.
std::string scene_text_with(const Study& study, const StudyValues& values);

// Changes with study, scene, version of viscard and what is besides.
std::string fingerprint(const Study& study);
// One line that changes with everything that answers depend on: also with the files that the scene names.
std::string fingerprint_with_inputs(const Study& study);

// The name of a file in Study::inputs.
std::string input_name(const Study& study, const std::filesystem::path& file);

}  // namespace viscard
