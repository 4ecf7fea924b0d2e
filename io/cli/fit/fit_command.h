#pragma once

#include "io/cli/words/streams.h"
#include "io/flow/fit_file.h"
#include "io/flow/large_strain/large_strain_files.h"
#include "io/flow/words/option_fields.h"

#include <boost/program_options/options_description.hpp>
#include <boost/program_options/variables_map.hpp>

#include <string>
#include <vector>

namespace viscard {

// viscard fit: fits a modulus and a Prony series to captures or tables; prints them, as text or
// JSON, and writes a material file.
int run_fit(const Words& words, Streams& streams);

// viscard predict: predicts a material in a test, with its band, beside measured values.
int run_predict(const Words& words, Streams& streams);

// The options --weight, --youngs-modulus and --svg.
void add_large_strain_options(boost::program_options::options_description& options);

// The tests at large strain that the words name; empty: none. Throws UsageError for words that mix
// them with other files, and for their options without them.
std::vector<LargeStrainFile> large_strain_given(
    const Words& words, const boost::program_options::variables_map& values);

// viscard fit of tests at large strain (uniaxial=a.csv planar=b.csv): fits laws of rubber, prints them,
// and writes --out and --svg. Throws UsageError for options that do not belong to such tests.
int run_large_strain(const std::vector<LargeStrainFile>& files,
                     const boost::program_options::variables_map& values, Streams& streams);

// Fills options from the values.
void take_options(const boost::program_options::variables_map& values, const OptionFields& fields);

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
