#pragma once

#include "io/flow/planning/plan_tests.h"
#include "io/plots/plot.h"

#include <iosfwd>
#include <string>

namespace viscard {

class ResultVisitor;

// The keys of viscard cost --rig --json.
void show_keys(ResultVisitor& v, const TestStudy& study);
std::string csv_from_test_study(const TestStudy& study, const std::string& command);
Plot plot_from_test_study(const TestStudy& study);
void print_test_study(const TestStudy& study, std::ostream& out);

// The test file of the advised row, with its origin in a comment.
std::string toml_of_advice(const TestStudy& study, const std::string& command);

// Why quantities miss their tolerance in every test, and how to change that; one sentence each.
std::vector<std::string> limits_of(const TestStudy& study);
// The advised row in a sentence.
std::string advice_of(const TestStudy& study);

}  // namespace viscard
