#pragma once

#include "io/cli/words/streams.h"
#include "io/flow/fit_file.h"
#include "io/flow/material_from_fitted.h"

#include <string>
#include <vector>

namespace viscard {

// The options of `viscard fit --joint`.
struct JointWords {
  std::vector<std::string> files;   // captures, tables, material files
  std::vector<double> ratios;       // --ratio, one for each file; empty: from the files
  std::vector<std::string> shared;  // --share: E0, g, tau
  FitRequest fit;
  MaterialRequest material;
  std::string out;
  bool overwrite = false, json = false;
};

// Fits all captures and tables with the same number of terms, then the law in the mixing ratio.
int run_joint_fit(const JointWords& words, Streams& streams);

}  // namespace viscard
