#pragma once

#include <boost/program_options/variables_map.hpp>

namespace viscard {

// Looks at every option that names a file to write (--out, --csv, --creep-csv, --svg, --vtk) before
// any work is done. Throws UsageError when it is also an input of the same command (--force would
// destroy it) or another output, and std::runtime_error when its folder is missing or cannot be
// written to.
void check_output_paths(const boost::program_options::variables_map& values);

}  // namespace viscard
