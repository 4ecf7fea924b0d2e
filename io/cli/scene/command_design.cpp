#include "io/basics/atomic_file.h"
#include "io/basics/json_string.h"
#include "io/basics/option_use.h"
#include "io/cli/scene/answer_pictures.h"
#include "io/cli/scene/design_judge.h"
#include "io/cli/scene/design_optimise.h"
#include "io/cli/scene/scene_commands.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/flow/design/closed_form.h"
#include "io/flow/optimise/design_spec.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <ostream>

namespace viscard {
namespace {

std::vector<DescribedResult> results_of_design() {
  const auto show = [](ResultVisitor& v) {
    show_keys(v, ClosedFormDesign{});
    show_origin(v, "");
  };
  return {{"design", "viscard design; design.json has command and created_by besides", {show}},
          result_of_judgement(),
          result_of_front()};
}

// What was given of the closed-form limits, by name.
using LimitValues = std::map<std::string, std::optional<double>>;

CommandSyntax design_syntax(DesignWords& words, LimitValues& limits,
                            std::optional<std::string>& lattice) {
  CommandSyntax syntax{
      "viscard design [SCENE.toml --require FILE | SPEC.toml] [OPTIONS]",
      "With a scene: judges it by requirements, each against a computed quantity with its error; "
      "fails unless all pass. With a specification of ranges, requirements and objectives: the "
      "scene that is best in one objective, or the front between two, confirmed by the solver. "
      "Without both: closed-form limits of a pillar sensor: buckling, matting, ground collapse, "
      "flaw insensitivity, sensitivity, resolution, manufacture; the longest admissible pillar. "
      "Values are in SI or carry their unit.",
      "viscard design --diameter \"40 um\" --spacing \"60 um\" --length \"120 um\""};
  syntax.positional.add("scene", &words.scene, "scene file or specification");
  OptionList& options = syntax.options;
  options.group("Closed-form limits");
  ClosedFormDesign defaults;
  for (const DesignOption& option : options_of(defaults)) {
    const bool is_pure = std::string(option.unit.si) == "1";
    options
        .add(option.name, &limits[option.name],
             fmt::format("{} ({:g}{}{})", option.what, *option.value, is_pure ? "" : " ",
                         is_pure ? "" : option.unit.si))
        .of(option.unit);
  }
  options.add("lattice", &lattice, "arrangement of the pillars (square)")
      .among({"square", "hexagonal", "plain"});
  options.group("A scene or a specification");
  options.add("require", &words.require,
              "judge SCENE.toml: file with a table [require], such as "
              "data/requirements/human_hand.toml");
  options
      .add("search-time", &words.search_s,
           "with --require: processor time for the search of the dimensions that would pass, "
           "summed over all "
           "cores; the judgement itself comes first and is not limited; 0s: no search")
      .of("s")
      .by_default("60s");
  add_tolerance_option(options, words.tolerance);
  options.group("Output");
  options.add("out", &words.out,
              "folder for design.json and pictures of the limits; of a scene, for judgement.json; "
              "of a specification, for the scenes, design.json, designs.csv and front.svg");
  options.add("force", &words.overwrite, "overwrite existing files").only_with({"out"});
  syntax.may_exist = {"out"};
  syntax.results = results_of_design();
  return syntax;
}

// A scene has its own geometry and material.
void refuse_limit_options(const CommandSyntax& syntax) {
  for (const Option& option : syntax.options.all()) {
    if (option.group != "Closed-form limits" || !is_given(syntax, option.name)) continue;
    throw UsageError("--" + option.name +
                     " belongs to the closed-form limits; a scene has its own values");
  }
}

// A specification names its scene; a scene has its geometry.
bool is_specification(const DesignWords& words) {
  return words.scene && !words.require && is_design_spec(read_file(*words.scene));
}

ClosedFormDesign design_from(const CommandSyntax& syntax, const LimitValues& limits,
                             const std::optional<std::string>& lattice) {
  try {
    for (const auto& [name, value] : limits) {
      if (value) refuse_negative("--" + name, *value, given_words(syntax, {name.c_str()}).front());
    }
    return closed_form_design(
        [&](const char* name, const QuantityOrUnit&) { return limits.at(name); }, lattice);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

}  // namespace

int run_design(const Words& words, Streams& streams) {
  DesignWords asked;
  LimitValues limits;
  std::optional<std::string> lattice;
  CommandSyntax syntax = design_syntax(asked, limits, lattice);
  if (!parse_words(syntax, words, streams)) return kDone;
  asked.judged = given_plausible(syntax);
  if (asked.scene || asked.require) {
    refuse_limit_options(syntax);
    return is_specification(asked) ? run_design_optimise(asked, syntax, words, streams)
                                   : run_design_judge(asked, syntax, words, streams);
  }
  refuse_idle<UsageError>(
      {{"--tol", asked.tolerance.has_value(), false, "a scene, and none is named"},
       {"--search-time", is_given(syntax, "search-time"), false, "a scene, and none is named"}});
  const ClosedFormDesign design = design_from(syntax, limits, lattice);
  const JsonHead head{"viscard-design/1", {}};
  const auto show = [&](const std::string& command) {
    return [&design, command](ResultVisitor& v) {
      show_keys(v, design);
      show_origin(v, command);
    };
  };
  if (asked.out) {
    const std::filesystem::path folder = *asked.out;
    const bool overwrite = asked.overwrite;
    std::filesystem::create_directories(folder);
    const auto stored = with_head(head, show(quoted_command_line("design", words)));
    write_file(folder / "design.json", text_from_json(stored, 2) + "\n", overwrite);
    for (const auto& [name, plot] :
         design_pictures(design.geometry, design.material, design.requirements)) {
      write_file(folder / (name + ".svg"), svg_from_plot(plot, "design-" + name) + "\n", overwrite);
    }
  }
  if (!print_result(syntax, head, show(""), streams)) {
    FittedText text(streams);
    static_cast<std::ostream&>(text) << text_from_design(design);
  }
  return kDone;
}

}  // namespace viscard
