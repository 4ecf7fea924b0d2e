#include "io/basics/atomic_file.h"
#include "io/basics/words.h"
#include "io/cli/fit/fit_command.h"
#include "io/cli/fit/predict_output.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/output_paths.h"
#include "io/flow/predict_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <ostream>

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
  syntax.choices["test"] = names_of_predicted_tests();
  return syntax;
}

std::optional<PredictedTest> test_from(const po::variables_map& values) {
  const auto word = given(values, "test");
  if (!word) return std::nullopt;
  const std::vector<std::string>& names = names_of_predicted_tests();
  const auto found = std::find(names.begin(), names.end(), *word);
  if (found != names.end()) return static_cast<PredictedTest>(found - names.begin());
  throw UsageError("--test " + *word + " is not known" + did_you_mean(*word, names) + " Use " +
                   listed(names));
}

// A quantity that has to be positive if it is given.
std::optional<double> positive(const po::variables_map& values, const char* name,
                               const char* unit) {
  const auto value = given_quantity(values, name, unit);
  if (value && !(*value > 0.0)) {
    throw UsageError(std::string("--") + name + " must be positive, such as \"1 " + unit + "\"");
  }
  return value;
}

PredictionRequest prediction_words(const po::variables_map& values, bool is_sweep) {
  PredictionRequest words;
  words.strain = given_quantity(values, "strain", "1");
  words.stress_Pa = given_quantity(values, "stress", "Pa");
  if (words.strain && words.stress_Pa) {
    throw UsageError("--strain and --stress exclude each other: one of them is the input");
  }
  words.ramp_s = positive(values, "ramp", "s").value_or(0.0);
  words.hold_s = positive(values, "hold", "s");
  words.recovery_s = positive(values, "recovery", "s");
  words.period_s = *positive(values, "period", "s");
  words.n_cycles = values["cycles"].as<int>();
  words.from = positive(values, "from", is_sweep ? "Hz" : "s");
  words.to = positive(values, "to", is_sweep ? "Hz" : "s");
  words.points = values["points"].as<int>();
  if (words.n_cycles < 1 || words.n_cycles > 10000) {
    throw UsageError("--cycles must lie between 1 and 10000");
  }
  if (words.points < 2 || words.points > 100000) {
    throw UsageError("--points must lie between 2 and 100000");
  }
  return words;
}

// Options that contradict the test.
void check_test(const PredictFileRequest& request) {
  if (!request.test) return;
  const PredictedTest test = *request.test;
  const std::string& name = names_of_predicted_tests()[static_cast<std::size_t>(test)];
  const bool is_creep = test == PredictedTest::kCreep || test == PredictedTest::kRecovery;
  if (request.prediction.strain && is_creep) {
    throw UsageError("--strain does not belong to --test " + name +
                     ", which holds a stress; give --stress");
  }
  if (request.prediction.stress_Pa && test == PredictedTest::kRelaxation) {
    throw UsageError(
        "--stress does not belong to --test relaxation, which holds a strain; give "
        "--strain, or --test creep");
  }
  if (test == PredictedTest::kHistory && request.history.empty() && request.against.empty()) {
    throw UsageError("--test history needs --history TABLE");
  }
  if (test != PredictedTest::kHistory && !request.history.empty()) {
    throw UsageError("--history is a test of its own; omit --test " + name);
  }
}

PredictFileRequest predict_words(const po::variables_map& values, const CommandSyntax& syntax) {
  PredictFileRequest request;
  request.material = required(values, "material", syntax);
  request.test = test_from(values);
  request.history = given(values, "history").value_or("");
  request.against = given(values, "against").value_or("");
  const std::string driver = given(values, "driven-by").value_or("strain");
  if (driver != "strain" && driver != "stress") {
    throw UsageError("--driven-by " + driver + " is not known; use strain or stress");
  }
  request.is_driven_by_stress = driver == "stress";
  try {
    request.columns = column_map_from_words(given<Words>(values, "column").value_or(Words{}));
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  request.time_zero_s = *given_quantity(values, "time-zero", "s");
  request.temperature_C = given_quantity(values, "temperature", "degC");
  request.prediction = prediction_words(values, request.test == PredictedTest::kOscillation);
  check_test(request);
  return request;
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
  const PredictFileRequest request = predict_words(*values, syntax);
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
  if (!print_json(*values, {"viscard-predict/1", inputs}, json_from_prediction(predicted),
                  streams)) {
    print_prediction(predicted, FittedText(streams));
  }
  return report_trust(predicted, values->count("accept-flags") > 0, streams.err);
}

}  // namespace viscard
