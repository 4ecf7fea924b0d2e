#pragma once

#include "io/cli/words/streams.h"
#include "io/flow/fit_file.h"
#include "io/flow/words/fit_words.h"

#include <boost/program_options/variables_map.hpp>

#include <string>

namespace viscard {

// viscard fit: fits a modulus and a Prony series to captures or tables; prints them, as text or
// JSON, and writes a material file.
int run_fit(const Words& words, Streams& streams);

// viscard predict: what a material does in a test, with its band, beside measured values.
int run_predict(const Words& words, Streams& streams);

// The options of viscard fit among the values.
FitWords fit_words(const boost::program_options::variables_map& values);

// Where the result of a joint fit goes.
struct FitOutput {
  std::string file;  // empty: none
  bool overwrite = false, json = false;
};

// Fits all captures and tables with the same number of terms, then the law in the mixing ratio.
int run_joint_fit(JointRequest request, const FitOutput& output, Streams& streams);

// Does the work; a mistake in the options becomes a UsageError.
template <typename Work>
auto with_usage_errors(const Work& work) {
  try {
    return work();
  } catch (const OptionError& error) {
    throw UsageError(error.what());
  }
}

}  // namespace viscard
