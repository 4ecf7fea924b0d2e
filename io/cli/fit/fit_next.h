#pragma once

#include "io/cli/words/streams.h"
#include "io/flow/fit_file.h"
#include "fit/planning/next_measurement.h"

#include <boost/program_options.hpp>

#include <optional>
#include <vector>

namespace viscard {

// viscard fit --want QUANTITY=TOLERANCE: what to measure next.
void add_next_option(boost::program_options::options_description& options);

// The words after --want; empty: none. Throws UsageError unless they can be read and a single capture
// is to be fitted.
Words next_words(const boost::program_options::variables_map& values, const Words& files);

// Nothing if nothing is wanted.
using NextMeasurements = std::optional<std::vector<NextMeasurement>>;
NextMeasurements next_of(const FileOutcome& outcome, const Words& want);

}  // namespace viscard
