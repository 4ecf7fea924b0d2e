#pragma once

#include "io/cli/scene/design_judge.h"

namespace viscard {

// viscard design SPEC.toml: the scene that meets the requirements and is best in an objective
// (io/flow/optimise). Returns kFailed if no design is feasible.
int run_design_optimise(const DesignWords& asked, const CommandSyntax& syntax, const Words& words,
                        Streams& streams);
// What it prints with --json.
DescribedResult result_of_front();

}  // namespace viscard
