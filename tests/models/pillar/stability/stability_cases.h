#pragma once

#include <functional>
#include <string>
#include <vector>

namespace viscard::test {

// An extreme the solver must survive: how large its relative error is there, and how large it may
// be. The table in models/pillar/README.md is made of these.
struct StabilityCase {
  std::string name;
  std::function<double()> error;
  double bound = 0.0;
};

std::vector<StabilityCase> elastic_stability_cases();
std::vector<StabilityCase> viscoelastic_stability_cases();
std::vector<StabilityCase> electric_and_unit_stability_cases();

}  // namespace viscard::test
