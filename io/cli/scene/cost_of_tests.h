#pragma once

#include "io/cli/words/command_line.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// The options of viscard cost --rig.
struct CostOfTestsWords {
  std::optional<std::string> rig, specimen, guess, test, scene;
  std::vector<std::string> want;
  double longest_s = 3600.0;
};
void add_test_options(OptionList& options, CostOfTestsWords& words);

// Where the results of a study go.
struct StudyFiles {
  std::optional<std::string> folder;
  bool overwrite = false;
};

// viscard cost --rig: error against time at the rig, over tests of a specimen.
int run_cost_of_tests(const CostOfTestsWords& words, const StudyFiles& files,
                      const CommandSyntax& syntax, const std::string& command, Streams& streams);

// What it prints with --json.
DescribedResult result_of_test_study();

}  // namespace viscard
