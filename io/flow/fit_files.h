#pragma once

#include "io/flow/fit_file.h"
#include "io/flow/flow_progress.h"

#include <string>
#include <vector>

namespace viscard {

// Fits all files on all cores. If some fail, rethrows the exception of the first of them in the
// order of the files.
std::vector<FittedFile> fit_files(const std::vector<std::string>& files, const FitRequest& request,
                                  const FlowProgress& progress);

}  // namespace viscard
