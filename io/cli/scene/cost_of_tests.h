#pragma once

#include "io/cli/words/command_line.h"

#include <string>

namespace viscard {

// viscard cost --rig: error against time at the rig, over tests of a specimen.
int run_cost_of_tests(const boost::program_options::variables_map& values,
                      const CommandSyntax& syntax, const std::string& command, Streams& streams);

// Its options, and what it prints with --json.
void add_test_options(boost::program_options::options_description& options);
DescribedResult result_of_test_study();

}  // namespace viscard
