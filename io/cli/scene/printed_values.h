#pragma once

#include "io/scenes/scene_file.h"
#include "models/scene/common/scene_answer.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace viscard {

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

// Compares the [[printed]] entries of a scene with its answer. The name of an entry is that of a
// result, or the family and number of a mode: "lateral 2". Throws std::runtime_error naming the
// entry if the answer has no such value.
std::vector<PrintedComparison> compare_printed(const std::vector<PrintedValue>& printed,
                                               const SceneAnswer& answer);

void print_comparison(const std::vector<PrintedComparison>& rows, std::ostream& out);
nlohmann::json json_from_comparison(const std::vector<PrintedComparison>& rows);

}  // namespace viscard
