#pragma once

#include "io/scenes/scene_file.h"
#include "models/answer/scene_answer.h"
#include "models/scene/scene.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

class ResultVisitor;

// Two answers beside each other, such as pillars on a film and a layer on it.

// A value that both have, in its unit.
struct ComparedValue {
  std::string name, unit;
  double value = 0.0, other = 0.0;
  double error = 0.0, other_error = 0.0;  // estimates of the computations
  std::optional<double> ratio;            // value over the other; nothing if that may be 0
  double ratio_error = 0.0;
};
void show_keys(ResultVisitor& v, const ComparedValue& value);

// Voltages of the electrodes along x: of a row, of the middle row of an array, or those at y = 0 of a layer.
struct VoltageProfile {
  std::string name;  // of the reading: "centre_voltage"
  std::vector<double> x_m, value_V, error_V;
};
std::vector<VoltageProfile> voltage_profiles(const Scene& scene, const SceneAnswer& answer);

// A profile that both scenes have, and how sharp it is.
struct ComparedProfile {
  VoltageProfile here, other;
  double pitch_m = 0.0;  // the smallest distance of electrodes here
  // The largest difference of two electrodes one pitch apart over the largest voltage; nothing without such
  // electrodes.
  std::optional<double> contrast, other_contrast;
};
void show_keys(ResultVisitor& v, const ComparedProfile& profile);

struct ComparedAnswers {
  std::string scene;  // the file of the other one
  std::vector<ComparedValue> values;
  std::vector<ComparedProfile> profiles;
};
void show_keys(ResultVisitor& v, const ComparedAnswers& compared);

// The scene beside one: `named`, or without it the one of its key compare.
struct OtherScene {
  std::string path;
  SceneFile file;
};
// path: of the first scene, whose folder its key refers to. The other one keeps its tolerance if none is given. Nothing
// if none is named. Throws std::invalid_argument if one of the two is a sweep.
std::optional<OtherScene> other_scene(const std::optional<std::string>& named,
                                      const SceneFile& file, const std::string& path,
                                      std::optional<double> tolerance, Plausible judged);

// A scene with its answer.
struct AnsweredScene {
  const Scene& scene;
  const SceneAnswer& answer;
};
// file: of the other scene. Throws std::runtime_error if the two have no value, curve or profile in common.
ComparedAnswers compare_answers(const AnsweredScene& here, const AnsweredScene& other,
                                const std::string& file);

}  // namespace viscard
