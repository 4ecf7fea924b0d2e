#pragma once

#include <functional>
#include <string>
#include <vector>

namespace viscard::test {

// An extreme case for the solver: its relative error there and the largest allowed one. The table
// in models/pillar/README.md lists these cases.
struct StabilityCase {
  std::string name;
  std::function<double()> error;
  double bound = 0.0;
};

std::vector<StabilityCase> elastic_stability_cases();
std::vector<StabilityCase> viscoelastic_stability_cases();
std::vector<StabilityCase> electric_and_unit_stability_cases();

}  // namespace viscard::test
