#pragma once

#include "io/basics/printed_value.h"
#include "models/scene/common/scene_answer.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace viscard {

// A value that some publication prints, beside ours.
struct PrintedComparison {
  std::string name;
  double printed = 0.0;
  double ours = 0.0;
  std::string unit;                 // SI
  double difference_percent = 0.0;  // of the printed size against ours; signs are conventions
  std::string note;                 // why they differ
  std::optional<double> difference_points;  // of per cents: printed less ours
};

// The scene's [[printed]] entries against its answer. A name is that of a result, or a family and a
// number: "lateral 2". Throws std::runtime_error naming the entry that the answer does not have.
std::vector<PrintedComparison> compare_printed(const std::vector<PrintedValue>& printed,
                                               const SceneAnswer& answer);

void print_comparison(const std::vector<PrintedComparison>& rows, std::ostream& out);
nlohmann::json json_from_comparison(const std::vector<PrintedComparison>& rows);

}  // namespace viscard
