#pragma once

#include "io/flow/scenes/compared_answers.h"
#include "io/flow/scenes/scene_uncertainty.h"
#include "io/scenes/scene_file.h"
#include "models/answer/scene_answer.h"
#include "models/array/plane/row_shapes.h"

#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace viscard {

class ResultVisitor;

// How the answer of any scene is printed and stored.

// A value that a publication prints, and ours.
struct PrintedComparison {
  std::string name;
  double printed = 0.0;
  double ours = 0.0;
  std::string unit;  // SI
  double difference_percent =
      0.0;           // of the magnitudes, printed relative to ours; signs are conventions
  std::string note;  // why they differ
  std::optional<double> difference_points;  // printed minus ours, for values in per cent
};
void show_keys(ResultVisitor& v, const PrintedComparison& row);

// All that viscard simulate shows of a scene.
struct ShownAnswer {
  std::string scene;  // its file
  SceneAnswer answer;
  double wall_s = 0.0;
  std::vector<PrintedComparison> printed;
  std::optional<ComparedAnswers> compared;
  std::optional<SceneUncertainty> uncertainty;
  double tolerance = 0.0;            // of the scene
  std::string command;               // of results.json
  bool accepts_implausible = false;  // of values
};
void show_keys(ResultVisitor& v, const ShownAnswer& shown);

void print_answer(const SceneAnswer& answer, double wall_s, std::ostream& out);

// Writes pictures, name and SVG each.
void write_pictures(const std::vector<std::pair<std::string, std::string>>& pictures,
                    const std::string& folder, bool overwrite);

// results.json, results.csv and modes.csv, a CSV table and a picture of every curve, the maps of an array
// in the plane (map_output.h). Throws
// std::runtime_error if a file exists and may not be overwritten.
void write_files(const ShownAnswer& shown, const std::string& folder, bool overwrite);

// The motion of every pillar in every mode of a row: a table with one line for each pair of them.
std::string csv_of_shapes(const RowShapes& shapes, const std::vector<SceneMode>& modes,
                          const std::string& command);

// Compares the [[printed]] entries of a scene with its answer. The name of an entry is that of a
// result, or the family and number of a mode: "lateral 2". Throws std::runtime_error naming the
// entry if the answer has no such value.
std::vector<PrintedComparison> compare_printed(const std::vector<PrintedValue>& printed,
                                               const SceneAnswer& answer);

void print_comparison(const std::vector<PrintedComparison>& rows, std::ostream& out);

// The other scene of --compare beside this one.
void print_compared(const ComparedAnswers& compared, std::ostream& out);
std::string csv_of_compared(const ComparedAnswers& compared, const std::string& command);

}  // namespace viscard
