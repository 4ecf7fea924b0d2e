#pragma once

#include "io/cli/words/command_syntax.h"
#include "io/cli/words/streams.h"
#include "io/results/result_schema.h"

#include <optional>
#include <string>

namespace viscard {

// The options of viscard design that belong to a scene or a specification.
struct DesignWords {
  std::optional<std::string> scene, require, out;
  std::optional<double> tolerance;
  double search_s = 60.0;
  bool overwrite = false;
  Plausible judged = Plausible::kMeasured;
};

// What it prints with --json.
DescribedResult result_of_judgement();
// viscard design SCENE.toml --require FILE: judges a scene (io/flow/design), prints and stores.
// Returns kFailed unless every requirement passes.
int run_design_judge(const DesignWords& asked, const CommandSyntax& syntax, const Words& words,
                     Streams& streams);

}  // namespace viscard
