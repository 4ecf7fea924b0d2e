#pragma once

#include "io/cli/words/streams.h"
#include "io/results/result_schema.h"

#include <boost/program_options/variables_map.hpp>

namespace viscard {

// viscard design SPEC.toml: the scene that meets the requirements and is best in an objective
// (io/flow/optimise). Returns kFailed if no design is feasible.
int run_design_optimise(const boost::program_options::variables_map& values, const Words& words,
                        Streams& streams);
// What it prints with --json.
DescribedResult result_of_front();

}  // namespace viscard
