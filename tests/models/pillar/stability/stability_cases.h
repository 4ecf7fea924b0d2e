#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace viscard::test {

// A relative error, and the share of the claim that it is if the answer claims one.
struct Seen {
  double error = 0.0;
  std::optional<double> of_claim;

  Seen(double relative) : error(relative) {}  // NOLINT(google-explicit-constructor): most cases
  Seen(double relative, double share) : error(relative), of_claim(share) {}
};

// An extreme case for the solver: its relative error there and the largest allowed one, within five
// times what is seen. tests/golden/pillar_stability.csv lists these cases.
struct StabilityCase {
  std::string name;
  std::function<Seen()> error;
  double bound = 0.0;
};

std::vector<StabilityCase> elastic_stability_cases();
std::vector<StabilityCase> viscoelastic_stability_cases();
std::vector<StabilityCase> electric_and_unit_stability_cases();
std::vector<StabilityCase> answer_stability_cases();
std::vector<StabilityCase> touch_stability_cases();

}  // namespace viscard::test
