#pragma once

#include "io/cli/fit/fit_input.h"
#include "io/cli/fit/fit_material.h"

#include <boost/program_options.hpp>

#include <string>

namespace viscard {

// What the options of viscard fit say. Both throw UsageError for words that cannot be meant.
FitWords words_from(const boost::program_options::variables_map& values);

// command: the whole line, for the provenance of the material.
FittedMaterialWords material_words(const boost::program_options::variables_map& values,
                                   const std::string& command);

}  // namespace viscard
