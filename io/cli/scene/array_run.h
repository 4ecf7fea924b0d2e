#pragma once

#include "io/cli/words/streams.h"

#include <boost/program_options.hpp>

#include <string>
#include <vector>

namespace viscard {

// `viscard simulate` for a scene of a row of pillars, or a sweep over such scenes. With --out a
// sweep keeps every point it has in sweep.part.csv, so that one that was stopped goes on there.
int run_array_scene(const std::string& path, const boost::program_options::variables_map& values,
                    const std::vector<std::string>& words, Streams& streams);

}  // namespace viscard
