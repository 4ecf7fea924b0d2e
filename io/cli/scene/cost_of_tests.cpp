// viscard cost --rig: choice of the test for the wanted quantities of a material.
#include "io/cli/scene/cost_of_tests.h"

#include "io/basics/atomic_file.h"
#include "io/basics/json_string.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/flow/planning/study_output.h"

#include <filesystem>
#include <stdexcept>

namespace po = boost::program_options;

namespace viscard {

void add_test_options(po::options_description& options) {
  auto add = options.add_options();
  add("rig", po::value<std::string>(),
      "rig.toml: instead of a scene, compare tests at this rig; its section [performance] must "
      "have "
      "the noise");
  add("specimen", po::value<std::string>(), "with --rig: specimen.toml");
  add("want", po::value<Words>()->composing(),
      "with --rig: a quantity and the relative half-width of its 95 % interval, such as E0=1% or "
      "g_2=5%; also E_inf, sum_g, E_i, tau_i; with a scene one of its results, or voltage "
      "(repeatable)");
  add("guess", po::value<std::string>(),
      "with --rig: material file of a similar material; its covariance is the uncertainty of the "
      "guess. "
      "Default: "
      "modulus_guess and relaxation_guess of the specimen");
  add("test", po::value<std::string>(),
      "with --rig: test.toml to compare with; its approach and retraction are kept");
  add("at-most", po::value<std::string>()->default_value("60min"),
      "with --rig: longest time at the rig");
}

DescribedResult result_of_test_study() {
  return described<TestStudy>("cost-tests", "viscard cost --rig");
}

int run_cost_of_tests(const po::variables_map& values, const CommandSyntax& syntax,
                      const std::string& command, Streams& streams) {
  TestStudyRequest request{.rig = required(values, "rig", syntax)};
  request.specimen = required(values, "specimen", syntax);
  request.want = given<Words>(values, "want").value_or(Words{});
  if (request.want.empty()) throw UsageError("what is wanted? Add for instance --want E0=1%");
  request.test = given(values, "test");
  request.guess = given(values, "guess");
  request.scene = given(values, "scene");
  request.longest_s = *given_quantity(values, "at-most", "s");
  for (const std::string& text : request.want) {
    try {
      wanted_from_text(text);
    } catch (const std::invalid_argument& error) {
      throw UsageError(error.what());
    }
  }
  const TestStudy study = study_tests(request);
  const JsonHead head{"viscard-cost-tests/1",
                      given_words(values, {"rig", "specimen", "test", "guess", "scene"})};
  const auto show = [&](ResultVisitor& v) { show_keys(v, study); };
  if (const auto out = given(values, "out")) {
    const std::filesystem::path folder = *out;
    const bool overwrite = values.count("force") > 0;
    std::filesystem::create_directories(folder);
    write_file(folder / "cost.csv", csv_from_test_study(study, command), overwrite);
    write_file(folder / "cost.json", text_from_json(with_head(head, show), 2) + "\n", overwrite);
    write_file(folder / "cost.svg", svg_from_plot(plot_from_test_study(study), "cost"), overwrite);
    if (study.protocols.advised) {
      write_file(folder / "test.toml", toml_of_advice(study, command), overwrite);
    }
  }
  if (!print_result(values, head, show, streams)) print_test_study(study, FittedText(streams));
  return kDone;
}

}  // namespace viscard
