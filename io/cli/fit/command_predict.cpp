#include "io/basics/atomic_file.h"
#include "io/cli/fit/fit_command.h"
#include "io/cli/fit/predict_output.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/output_paths.h"
#include "io/flow/predict_file.h"

#include <ostream>
#include <utility>

namespace po = boost::program_options;

namespace viscard {
namespace {

CommandSyntax predict_syntax() {
  CommandSyntax syntax;
  syntax.usage = "viscard predict MATERIAL.json [OPTIONS]";
  syntax.description =
      "Predicts what a fitted material does in a test, with the 95 % band that follows from the "
      "covariance of the fit, and marks what lies outside the window of the fit. Measured values "
      "given with --against are compared with the prediction.";
  syntax.example =
      "viscard predict data/materials/pdms_1to10_seed.json --against "
      "data/demo/example_relaxation.csv";
  auto add = syntax.options.add_options();
  add("test", po::value<std::string>(),
      "relaxation, creep, recovery, cycles, oscillation or history; by default the columns of "
      "--history or --against decide, or else relaxation");
  add("strain", po::value<std::string>(),
      "size of the strain, such as 0.01 or \"1 %\"; relaxation without it is E(t) after an ideal "
      "step, cycles have 0.01");
  add("stress", po::value<std::string>(),
      "size of the stress, such as \"10 kPa\"; creep without it is J(t) after an ideal step, "
      "recovery has 1 kPa");
  add("ramp", po::value<std::string>(), "duration of loading and of unloading; default: a jump");
  add("hold", po::value<std::string>(),
      "time under load, such as \"60 s\"; default: to the end of the window");
  add("recovery", po::value<std::string>(), "time after unloading; default: that of the hold");
  add("period", po::value<std::string>()->default_value("1 s"), "of one cycle, up and down again");
  add("cycles", po::value<int>()->default_value(5), "number of cycles");
  add("from", po::value<std::string>(),
      "first time of the curve, or lowest frequency of --test oscillation; default: the window");
  add("to", po::value<std::string>(), "last time, or highest frequency");
  add("points", po::value<int>()->default_value(200), "of the curve, or of each motion");
  add("history", po::value<std::string>(),
      "table with time_s and any strain or stress_Pa, linear between rows; with both columns, the "
      "strain is the input and the stress is compared");
  add("driven-by", po::value<std::string>(), "strain or stress: the input of such a table");
  add("against", po::value<std::string>(),
      "table of measured values: rms, worst, and the share inside the band");
  add("column", po::value<Words>()->composing(),
      "NAME=HEADER or NAME=2: the column of a quantity in these tables, as in viscard fit");
  add("time-zero", po::value<std::string>()->default_value("0"), "time in the tables where t = 0");
  add("temperature", po::value<std::string>(),
      "predict at this temperature, such as \"40 degC\", by the material's temperature shift");
  add("csv", po::value<std::string>(), "write the curve with its band here");
  add("svg", po::value<std::string>(), "draw the curve here");
  add("accept-flags", "exit with 0 also if the fit of the material is not to be trusted");
  add("force", "overwrite existing files");
  syntax.positional = {"material"};
  syntax.results = {described<PredictedFile>("predict", "viscard predict")};
  syntax.choices["test"] = names_of_predicted_tests();
  return syntax;
}

PredictWords predict_words(const po::variables_map& values) {
  PredictWords words;
  take_options(values, option_fields(words));
  return words;
}

// Prints one line if the material is not to be trusted and returns the exit status.
int report_trust(const PredictedFile& predicted, bool accepts_flags, std::ostream& err) {
  if (predicted.is_trustworthy || accepts_flags) return kDone;
  std::string reasons;
  for (const MaterialFlag& flag : predicted.flags) {
    if (is_defect(flag.name)) {
      reasons += (reasons.empty() ? "" : "; ") + flag.name + ": " + flag.text;
    }
  }
  err << "viscard: " << predicted.path << ": the material is not to be trusted: " << reasons
      << "; pass --accept-flags to use it anyway, or repeat the measurement\n";
  return kFailed;
}

}  // namespace

int run_predict(const Words& words, Streams& streams) {
  CommandSyntax syntax = predict_syntax();
  const auto values = parse_words(syntax, words, streams);
  if (!values) return kDone;
  const std::string path = required(*values, "material", syntax);
  const PredictFileRequest request =
      with_usage_errors([&] { return predict_request(predict_words(*values), path); });
  const bool overwrite = values->count("force") > 0;
  const auto csv = given(*values, "csv"), svg = given(*values, "svg");
  for (const auto& output : {csv, svg}) {
    if (output) refuse_existing(*output, overwrite);
  }
  const PredictedFile predicted = predict_file(request);
  if (csv) {
    write_file(*csv, csv_from_prediction(predicted, quoted_command_line("predict", words)),
               overwrite);
  }
  if (svg) {
    write_file(*svg, svg_from_plot(plot_of_prediction(predicted), "prediction"), overwrite);
  }
  const Words inputs = given_words(*values, {"material", "history", "against"});
  const auto show = [&](ResultVisitor& v) { show_keys(v, predicted); };
  if (!print_result(*values, {"viscard-predict/1", inputs}, show, streams)) {
    print_prediction(predicted, FittedText(streams));
  }
  return report_trust(predicted, values->count("accept-flags") > 0, streams.err);
}

}  // namespace viscard
