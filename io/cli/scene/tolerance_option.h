#pragma once

#include "models/scene/scene.h"

#include <boost/program_options.hpp>

namespace viscard {

// --tol: the relative error allowed, instead of the scene's.
void add_tolerance_option(boost::program_options::options_description& options);

// Sets the scene's tolerance if --tol is given. Throws UsageError outside the limits of its kind.
void apply_tolerance(const boost::program_options::variables_map& values, Scene& scene);

}  // namespace viscard
