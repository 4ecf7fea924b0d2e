#pragma once

#include "io/cli/fit/fit_input.h"
#include "io/cli/words/streams.h"

#include <string>
#include <vector>

namespace viscard {

// Fits all files on all cores, with a progress bar; the first failure in the order of the files is
// thrown.
std::vector<FittedFile> fit_files(const std::vector<std::string>& files, const FitWords& words,
                                  Streams& streams);

}  // namespace viscard
