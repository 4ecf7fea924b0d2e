#pragma once

#include "io/cli/fit/fit_input.h"
#include "io/cli/fit/fit_material.h"
#include "io/cli/words/streams.h"

#include <string>
#include <vector>

namespace viscard {

// What `viscard fit --joint` was asked.
struct JointWords {
  std::vector<std::string> files;   // captures, tables, material files
  std::vector<double> ratios;       // --ratio, one for each file; empty: the files say it
  std::vector<std::string> shared;  // --share: E0, g, tau
  FitWords fit;
  FittedMaterialWords material;
  std::string out;
  bool overwrite = false, json = false;
};

// Fits what was measured with one number of terms for all, then the law in the mixing ratio.
int run_joint_fit(const JointWords& words, Streams& streams);

}  // namespace viscard
