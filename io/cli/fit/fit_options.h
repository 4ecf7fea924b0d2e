#pragma once

#include "io/flow/fit_file.h"
#include "io/flow/material_from_fitted.h"

#include <boost/program_options.hpp>

#include <string>

namespace viscard {

// Convert the options of viscard fit. Both throw UsageError for values that are not allowed.
FitRequest words_from(const boost::program_options::variables_map& values);

// command: the whole command line, for the provenance of the material.
MaterialRequest material_words(const boost::program_options::variables_map& values,
                               const std::string& command);

}  // namespace viscard
