#include "io/basics/atomic_file.h"
#include "io/cli/fit/fit_command.h"
#include "io/cli/fit/predict_output.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/output_paths.h"
#include "io/flow/predict_file.h"
#include "io/flow/words/predict_words.h"

#include <ostream>
#include <utility>

namespace viscard {
namespace {

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
  std::string path;
  PredictWords test;
  std::optional<std::string> csv, svg;
  bool accepts_flags = false, overwrite = false;
  CommandSyntax syntax{
      "viscard predict MATERIAL.json [OPTIONS]",
      "Predicts what a fitted material does in a test, with the 95 % band that follows from the "
      "covariance of the fit, and marks what lies outside the window of the fit. Measured values "
      "given with --against are compared with the prediction.",
      "viscard predict data/materials/pdms_1to10_seed.json --against "
      "data/demo/example_relaxation.csv"};
  syntax.results = {described<PredictedFile>("predict", "viscard predict")};
  syntax.positional.add("material", &path, "material file");
  syntax.options = options_of(test);
  syntax.options.group("Output");
  syntax.options.add("csv", &csv, "write the curve with its band here").only_typed();
  syntax.options.add("svg", &svg, "draw the curve here").only_typed();
  syntax.options
      .add("accept-flags", &accepts_flags,
           "exit with 0 also if the fit of the material is not to be trusted")
      .only_typed();
  syntax.options.add("force", &overwrite, "overwrite existing files")
      .only_typed()
      .only_with({"csv", "svg"});
  if (!parse_words(syntax, words, streams)) return kDone;
  const PredictFileRequest request = with_usage_errors([&] { return predict_request(test, path); });
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
  const Words inputs = given_words(syntax, {"material", "history", "against"});
  const auto show = [&](ResultVisitor& v) { show_keys(v, predicted); };
  if (!print_result(syntax, {"viscard-predict/1", inputs}, show, streams)) {
    print_prediction(predicted, FittedText(streams));
  }
  return report_trust(predicted, accepts_flags, streams.err);
}

}  // namespace viscard
