#pragma once

#include "fit/laws/fit_mixing_ratio.h"
#include "io/flow/fit_file.h"
#include "io/flow/material_from_fitted.h"

#include <functional>
#include <string>
#include <vector>

namespace viscard {

// Specimens of one material at several mixing ratios.
struct JointRequest {
  std::vector<std::string> files;  // captures, tables, material files
  std::vector<double> ratios;      // one for each file; empty: the files state them
  FitRequest fit;
  MaterialRequest material;
  MixingOptions options;
  FlowProgress progress;
  std::function<void(const std::string&)> note;  // called for each specimen that is fitted again
};

// Fits the measured specimens with one common number of terms, then the law in the mixing ratio.
// Throws what fit_file(), read_material() and fit_mixing_ratio() throw.
RatioFit fit_jointly(const JointRequest& request);

}  // namespace viscard
