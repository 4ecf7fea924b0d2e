#pragma once

#include "io/cli/words/command_syntax.h"
#include "io/cli/words/streams.h"
#include "io/flow/fit_file.h"
#include "io/flow/large_strain/large_strain_files.h"
#include "io/flow/large_strain/large_strain_words.h"
#include "io/flow/planning/next_test.h"
#include "io/flow/words/fit_words.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// viscard fit: fits a modulus and a Prony series to captures or tables; prints them, as text or
// JSON, and writes a material file.
int run_fit(const Words& words, Streams& streams);

// viscard predict: predicts a material in a test, with its band, beside measured values.
int run_predict(const Words& words, Streams& streams);

// The options of viscard fit; `fit` serves all kinds of test, `large` has what only tests at large strain
// have.
struct FitCommand {
  std::vector<std::string> files;
  FitWords fit;
  LargeStrainWords large;
  std::vector<std::string> want;
  std::optional<std::string> out, svg, csv;
  bool overwrite = false, curves = false, show_table = false;
};

// The tests at large strain that the words name; empty: none. Throws UsageError for words that mix
// them with other files, and for their options without them.
std::vector<LargeStrainFile> large_strain_given(const FitCommand& command,
                                                const CommandSyntax& syntax);

// viscard fit of tests at large strain (uniaxial=a.csv planar=b.csv): fits laws of rubber, prints them,
// and writes --out and --svg. Throws UsageError for options that do not belong to such tests.
int run_large_strain(const std::vector<LargeStrainFile>& files, const FitCommand& command,
                     const CommandSyntax& syntax, Streams& streams);

// viscard fit --show-table: prints how the tables are read, and fits nothing. Throws what view_table() throws.
int show_tables(const std::vector<std::string>& files, const FitRequest& request, bool as_json,
                Streams& streams);
DescribedResult result_of_table();

// viscard fit --want: what to measure next; nothing if nothing is wanted.
using NextMeasurements = std::optional<std::vector<NextMeasurement>>;
// Throws UsageError unless --want belongs to a single capture and names quantities.
void check_want(const FitCommand& command);
NextMeasurements next_of(const FileOutcome& outcome, const Words& want);

// Where the result of a joint fit goes.
struct FitOutput {
  std::string file;  // empty: none
  bool overwrite = false, json = false;
};

// Fits all captures and tables with the same number of terms, then the law in the mixing ratio.
int run_joint_fit(JointRequest request, const FitOutput& output, Streams& streams);

}  // namespace viscard
