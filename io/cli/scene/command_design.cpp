#include "io/basics/atomic_file.h"
#include "io/basics/words.h"
#include "io/cli/scene/answer_pictures.h"
#include "io/cli/scene/design_judge.h"
#include "io/cli/scene/design_optimise.h"
#include "io/cli/scene/scene_commands.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/flow/optimise/design_spec.h"
#include "models/sensor/sensor_design.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <ostream>

namespace po = boost::program_options;

namespace viscard {
namespace {

// An option that takes a number in SI or a text with its unit.
struct DesignOption {
  const char* name;
  const char* unit;
  const char* what;
  double* value;
};

struct Design {
  SensorGeometry geometry;
  SensorMaterial material;
  SensorRequirements requirements;
};

std::vector<DesignOption> options_of(Design& d) {
  SensorMaterial& m = d.material;
  SensorRequirements& r = d.requirements;
  return {
      {"diameter", "m", "of a pillar", &d.geometry.diameter_m},
      {"spacing", "m", "between pillars, edge to edge", &d.geometry.spacing_m},
      {"length", "m", "of a pillar", &d.geometry.length_m},
      {"pressure", "Pa", "largest, mean over the sensor", &r.pressure_Pa},
      {"modulus", "Pa", "Young's modulus of the pillars", &m.young_modulus_Pa},
      {"poisson", "1", "Poisson ratio of the pillars", &m.poisson_ratio},
      {"surface-energy", "J/m2", "gamma of the pillars", &m.surface_energy_J_m2},
      {"work-of-adhesion", "J/m2", "w of the contact; twice gamma unless given",
       &m.work_of_adhesion_J_m2},
      {"strength", "Pa", "sigma_th, adhesion strength of the contact", &m.adhesion_strength_Pa},
      {"end-factor", "1", "K of Euler's formula: 0.5, 0.699, 1 or 2", &r.end_factor},
      {"film-thickness", "m", "of the piezoelectric film", &r.film_thickness_m},
      {"charge-constant", "C/N", "|d33| of the film", &m.charge_constant_C_N},
      {"permittivity", "1", "relative, of the film", &m.relative_permittivity},
      {"smallest-feature", "m", "narrowest pillar or gap that can be made", &r.smallest_feature_m},
      {"aspect-ratio", "1", "largest length over diameter that can be made",
       &r.largest_aspect_ratio},
      {"pitch", "m", "coarsest diameter plus spacing; 0: any", &r.coarsest_pitch_m},
      {"sensitivity", "1", "least one beside a film without pillars; 0: any",
       &r.least_relative_sensitivity}};
}

CommandSyntax design_syntax(Design& defaults) {
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
                                         std::string(option.unit) == "1" ? "" : " ",
                                         std::string(option.unit) == "1" ? "" : option.unit);
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
void refuse_limit_options(const po::variables_map& values, Design& defaults) {
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

Lattice lattice_of(const std::string& word) {
  if (word == "square") return Lattice::kSquare;
  if (word == "hexagonal") return Lattice::kHexagonal;
  if (word == "plain") return Lattice::kPlain;
  throw UsageError("--lattice cannot be '" + word + "'" +
                   did_you_mean(word, {"square", "hexagonal", "plain"}) +
                   " There are: square, hexagonal, plain");
}

Design design_from(const po::variables_map& values) {
  Design design;
  for (const DesignOption& option : options_of(design)) {
    const auto value = given_quantity(values, option.name, option.unit);
    if (value) *option.value = *value;
  }
  if (values.count("work-of-adhesion") == 0) {
    design.material.work_of_adhesion_J_m2 = 2.0 * design.material.surface_energy_J_m2;
  }
  if (const auto word = given(values, "lattice")) design.requirements.lattice = lattice_of(*word);
  try {
    validate(design.geometry, design.material, design.requirements);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  return design;
}

nlohmann::json json_from_design(const Design& d, const std::vector<DesignLimit>& limits,
                                const LongestPillar& longest) {
  nlohmann::json rows = nlohmann::json::array();
  for (const DesignLimit& l : limits) {
    rows.push_back({{"name", l.name},
                    {"value", l.value},
                    {"limit", l.limit},
                    {"unit", l.unit},
                    {"is_upper", l.is_upper},
                    {"met", l.is_met()},
                    {"margin", l.margin()}});
  }
  const SensorGeometry& g = d.geometry;
  return {
      {"admissible", is_admissible(limits)},
      {"limits", rows},
      {"longest_m", longest.length_m},
      {"limited_by", longest.limited_by},
      {"stress_concentration",
       stress_concentration(g.diameter_m, g.spacing_m, d.requirements.lattice)},
      {"sensitivity_V_Pa", sensitivity_V_Pa(g.diameter_m, g.spacing_m, d.material, d.requirements)},
      {"relative_sensitivity",
       stress_concentration(g.diameter_m, g.spacing_m, d.requirements.lattice)},
      {"pitch_m", g.diameter_m + g.spacing_m},
      {"pull_off_force_N", pull_off_force_N(g.diameter_m, d.material)}};
}

// Lengths in um, the rest as it is.
std::string shown(double value, const std::string& unit) {
  return unit == "m" ? fmt::format("{:.4g} um", value * 1e6) : fmt::format("{:.4g}", value);
}

void print_design(const Design& d, const std::vector<DesignLimit>& limits,
                  const LongestPillar& longest, std::ostream& out) {
  for (const DesignLimit& l : limits) {
    out << fmt::format("  {:<16} {:>12} {} {:<12} {}\n", l.name, shown(l.value, l.unit),
                       l.is_upper ? "<=" : ">=", shown(l.limit, l.unit),
                       l.is_met() ? "" : "NOT MET");
  }
  const SensorGeometry& g = d.geometry;
  out << fmt::format(
      "  sensitivity {:.4g} mV/kPa, {:.4g} times a film without pillars; pitch {:.4g} um\n",
      1e6 * sensitivity_V_Pa(g.diameter_m, g.spacing_m, d.material, d.requirements),
      stress_concentration(g.diameter_m, g.spacing_m, d.requirements.lattice),
      1e6 * (g.diameter_m + g.spacing_m));
  if (longest.length_m > 0.0) {
    out << fmt::format("  longest admissible pillar {:.4g} um, limited by {}\n",
                       longest.length_m * 1e6, longest.limited_by);
  } else {
    out << fmt::format("  no length is admissible: {} rules it out\n", longest.limited_by);
  }
  out << (is_admissible(limits) ? "  admissible\n" : "  not admissible\n");
}

}  // namespace

int run_design(const Words& words, Streams& streams) {
  Design defaults;
  CommandSyntax syntax = design_syntax(defaults);
  const auto values = parse_words(syntax, words, streams);
  if (!values) return kDone;
  if (values->count("scene") + values->count("require") > 0) {
    refuse_limit_options(*values, defaults);
    return is_specification(*values) ? run_design_optimise(*values, words, streams)
                                     : run_design_judge(*values, words, streams);
  }
  if (values->count("tol") > 0) throw UsageError("--tol belongs to a scene; name its file");
  const Design design = design_from(*values);
  const SensorGeometry& g = design.geometry;
  const std::vector<DesignLimit> limits = design_limits(g, design.material, design.requirements);
  const LongestPillar longest =
      longest_pillar(g.diameter_m, g.spacing_m, design.material, design.requirements);
  const JsonHead head{"viscard-design/1", {}};
  const nlohmann::json object = with_head(head, json_from_design(design, limits, longest));
  if (const auto out = given(*values, "out")) {
    const std::filesystem::path folder = *out;
    const bool overwrite = values->count("force") > 0;
    std::filesystem::create_directories(folder);
    nlohmann::json stored = object;
    stored["command"] = quoted_command_line("design", words);
    stored["created_by"] = "viscard " VISCARD_VERSION;
    write_file(folder / "design.json", stored.dump(2) + "\n", overwrite);
    for (const auto& [name, plot] : design_pictures(g, design.material, design.requirements)) {
      write_file(folder / (name + ".svg"), svg_from_plot(plot, "design-" + name) + "\n", overwrite);
    }
  }
  if (!print_json(*values, head, object, streams)) {
    print_design(design, limits, longest, FittedText(streams));
  }
  return kDone;
}

}  // namespace viscard
