#pragma once

#include "io/cost/study_cost.h"
#include "io/plots/plot.h"

#include <ostream>
#include <string>

namespace viscard {

// A cost study as a table, a picture and text.
std::string csv_from_study(const CostStudy& study, const std::string& command);
Plot plot_from_study(const CostStudy& study, const std::string& scene);
void print_study(const CostStudy& study, const std::string& path, std::ostream& out);

}  // namespace viscard
