#pragma once

#include "io/cli/fit/fit_input.h"
#include "io/cli/fit/fit_material.h"

#include <boost/program_options.hpp>

#include <string>

namespace viscard {

// Convert the options of viscard fit. Both throw UsageError for values that are not allowed.
FitWords words_from(const boost::program_options::variables_map& values);

// command: the whole command line, for the provenance of the material.
FittedMaterialWords material_words(const boost::program_options::variables_map& values,
                                   const std::string& command);

}  // namespace viscard
