#include "io/basics/atomic_file.h"
#include "io/basics/json_string.h"
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
#include <nlohmann/json.hpp>

#include <filesystem>
#include <ostream>

namespace po = boost::program_options;

namespace viscard {
namespace {

CommandSyntax design_syntax(ClosedFormDesign& defaults) {
  CommandSyntax syntax{
      "viscard design [SCENE.toml --require FILE | SPEC.toml] [OPTIONS]",
      "With a scene: judges it by requirements, each against a computed quantity with its error; "
      "fails unless all pass. With a specification of ranges, requirements and objectives: the "
      "scene "
      "that is best in one objective, or the front between two, confirmed by the solver. Without "
      "both: closed-form limits of a pillar sensor: buckling, matting, "
      "ground collapse, flaw insensitivity, sensitivity, resolution, manufacture; the longest "
      "admissible pillar. Values are in SI or carry their unit.",
      "viscard design --diameter \"40 um\" --spacing \"60 um\" --length \"120 um\""};
  for (const DesignOption& option : options_of(defaults)) {
    const std::string what = fmt::format("{} ({:g}{}{})", option.what, *option.value,
                                         std::string(option.unit.si) == "1" ? "" : " ",
                                         std::string(option.unit.si) == "1" ? "" : option.unit.si);
    syntax.options.add_options()(option.name, po::value<std::string>(), what.c_str());
  }
  syntax.options.add_options()("lattice", po::value<std::string>(),
                               "square, hexagonal or plain (square)")(
      "out", po::value<std::string>(),
      "folder for design.json and pictures of the limits; of a scene, for judgement.json; of a "
      "specification, for the scenes, design.json, designs.csv and front.svg")(
      "force", "overwrite existing files");
  add_judge_options(syntax.options);
  syntax.may_exist = {"out"};
  syntax.positional = {"scene"};
  syntax.choices["lattice"] = {"square", "hexagonal", "plain"};
  return syntax;
}

// A scene has its own geometry and material.
void refuse_limit_options(const po::variables_map& values, ClosedFormDesign& defaults) {
  const auto refuse = [](const std::string& name) {
    throw UsageError("--" + name +
                     " belongs to the closed-form limits; a scene has its own values");
  };
  for (const DesignOption& option : options_of(defaults)) {
    if (values.count(option.name) > 0) refuse(option.name);
  }
  if (values.count("lattice") > 0) refuse("lattice");
}

// A specification names its scene; a scene has its geometry.
bool is_specification(const po::variables_map& values) {
  const auto path = given(values, "scene");
  return path && values.count("require") == 0 && is_design_spec(read_file(*path));
}

ClosedFormDesign design_from(const po::variables_map& values) {
  try {
    return closed_form_design(
        [&](const char* name, const QuantityOrUnit& unit) {
          return given_quantity(values, name, unit);
        },
        given(values, "lattice"));
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

}  // namespace

int run_design(const Words& words, Streams& streams) {
  ClosedFormDesign defaults;
  CommandSyntax syntax = design_syntax(defaults);
  const auto values = parse_words(syntax, words, streams);
  if (!values) return kDone;
  if (values->count("scene") + values->count("require") > 0) {
    refuse_limit_options(*values, defaults);
    return is_specification(*values) ? run_design_optimise(*values, words, streams)
                                     : run_design_judge(*values, words, streams);
  }
  if (values->count("tol") > 0) throw UsageError("--tol belongs to a scene; name its file");
  const ClosedFormDesign design = design_from(*values);
  const JsonHead head{"viscard-design/1", {}};
  const nlohmann::json object = with_head(head, json_from_design(design));
  if (const auto out = given(*values, "out")) {
    const std::filesystem::path folder = *out;
    const bool overwrite = values->count("force") > 0;
    std::filesystem::create_directories(folder);
    nlohmann::json stored = object;
    stored["command"] = quoted_command_line("design", words);
    stored["created_by"] = "viscard " VISCARD_VERSION;
    write_file(folder / "design.json", text_from_json(stored, 2) + "\n", overwrite);
    for (const auto& [name, plot] :
         design_pictures(design.geometry, design.material, design.requirements)) {
      write_file(folder / (name + ".svg"), svg_from_plot(plot, "design-" + name) + "\n", overwrite);
    }
  }
  if (!print_json(*values, head, object, streams)) {
    FittedText text(streams);
    static_cast<std::ostream&>(text) << text_from_design(design);
  }
  return kDone;
}

}  // namespace viscard
