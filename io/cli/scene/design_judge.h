#pragma once

#include "io/cli/words/streams.h"
#include "io/results/result_schema.h"

#include <boost/program_options/options_description.hpp>
#include <boost/program_options/variables_map.hpp>

namespace viscard {

// viscard design SCENE.toml --require FILE: judges a scene (io/flow/design).

// The options that this adds to viscard design: --require and --tol.
void add_judge_options(boost::program_options::options_description& options);
// What it prints with --json.
DescribedResult result_of_judgement();
// Judges, prints and stores. Returns kFailed unless every requirement passes.
int run_design_judge(const boost::program_options::variables_map& values, const Words& words,
                     Streams& streams);

}  // namespace viscard
