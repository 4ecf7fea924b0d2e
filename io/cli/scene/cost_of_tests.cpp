// viscard cost --rig: choice of the test for the wanted quantities of a material.
#include "io/cli/scene/cost_of_tests.h"

#include "io/basics/atomic_file.h"
#include "io/basics/json_string.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/stop_on_signal.h"
#include "io/flow/planning/study_output.h"

#include <filesystem>
#include <stdexcept>

namespace viscard {

void add_test_options(OptionList& options, CostOfTestsWords& words) {
  options.add("rig", &words.rig,
              "rig.toml: instead of a scene, compare tests at this rig; its section [performance] "
              "must have the noise");
  options.add("specimen", &words.specimen, "specimen.toml").only_with({"rig"});
  options
      .add("want", &words.want,
           "a quantity and the relative half-width of its 95 % interval, such as E0=1% or "
           "g_2=5%; also E_inf, sum_g, E_i, tau_i; with a scene one of its results, or voltage "
           "(repeatable)")
      .only_with({"rig"});
  options
      .add("guess", &words.guess,
           "material file of a similar material; its covariance is the uncertainty of the "
           "guess. Default: modulus_guess and relaxation_guess of the specimen")
      .only_with({"rig"});
  options
      .add("test", &words.test, "test.toml to compare with; its approach and retraction are kept")
      .only_with({"rig"});
  options.add("at-most", &words.longest_s, "longest time at the rig")
      .of("s")
      .by_default("60min")
      .only_with({"rig"});
}

DescribedResult result_of_test_study() {
  return described<TestStudy>("cost-tests", "viscard cost --rig");
}

int run_cost_of_tests(const CostOfTestsWords& words, const StudyFiles& files,
                      const CommandSyntax& syntax, const std::string& command, Streams& streams) {
  if (!words.specimen) throw UsageError(std::string("no specimen given; usage: ") + syntax.usage);
  TestStudyRequest request{.rig = *words.rig};
  request.specimen = *words.specimen;
  request.want = words.want;
  if (request.want.empty()) throw UsageError("what is wanted? Add for instance --want E0=1%");
  request.test = words.test;
  request.guess = words.guess;
  request.scene = words.scene;
  request.longest_s = words.longest_s;
  if (!(request.longest_s > 0.0)) throw UsageError("--at-most must be positive, such as 10min");
  for (const std::string& text : request.want) {
    try {
      wanted_from_text(text);
    } catch (const std::invalid_argument& error) {
      throw UsageError(error.what());
    }
  }
  const WordsOnSignal words_on_signal(
      "the comparison of tests was stopped, and nothing is written; a shorter --at-most ends "
      "earlier");
  const TestStudy study = study_tests(request);
  const JsonHead head{"viscard-cost-tests/1",
                      given_words(syntax, {"rig", "specimen", "test", "guess", "scene"})};
  const auto show = [&](ResultVisitor& v) { show_keys(v, study); };
  if (files.folder) {
    const std::filesystem::path folder = *files.folder;
    const bool overwrite = files.overwrite;
    std::filesystem::create_directories(folder);
    write_file(folder / "cost.csv", csv_from_test_study(study, command), overwrite);
    write_file(folder / "cost.json", text_from_json(with_head(head, show), 2) + "\n", overwrite);
    write_file(folder / "cost.svg", svg_from_plot(plot_from_test_study(study), "cost"), overwrite);
    if (study.protocols.advised) {
      write_file(folder / "test.toml", toml_of_advice(study, command), overwrite);
    }
  }
  if (!print_result(syntax, head, show, streams)) print_test_study(study, FittedText(streams));
  return kDone;
}

}  // namespace viscard
