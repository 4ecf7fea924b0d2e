#pragma once

#include "io/cli/fit/fit_input.h"
#include "io/cli/words/streams.h"

#include <string>
#include <vector>

namespace viscard {

// Fits all files on all cores, with a progress bar. If some fail, rethrows the exception of the
// first of them in the order of the files.
std::vector<FittedFile> fit_files(const std::vector<std::string>& files, const FitWords& words,
                                  Streams& streams);

}  // namespace viscard
