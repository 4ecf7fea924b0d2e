#include "fit/assembly/constraints.h"
#include "fit/laws/law_values.h"
#include "io/basics/atomic_file.h"
#include "io/basics/timestamp.h"
#include "io/basics/words.h"
#include "io/cli/fit/fit_command.h"
#include "io/cli/words/command_line.h"
#include "io/config/config_file.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <utility>

namespace po = boost::program_options;

namespace viscard {
namespace {

using Numbers = std::vector<double>;

FitKind kind_from_word(const std::string& word) {
  static const std::vector<std::pair<std::string, FitKind>> kKinds{
      {"indentation", FitKind::kIndentation},
      {"relaxation", FitKind::kRelaxation},
      {"creep", FitKind::kCreep},
      {"dma", FitKind::kDma}};
  Words names;
  for (const auto& [name, kind] : kKinds) {
    if (word == name) return kind;
    names.push_back(name);
  }
  throw UsageError("--kind " + word + " is not known" + did_you_mean(word, names) +
                   " Use indentation, relaxation, creep or dma");
}

VerticalShift vertical_shift_from_word(const std::string& word) {
  if (word == "auto") return VerticalShift::kAuto;
  if (word == "on") return VerticalShift::kOn;
  if (word == "off") return VerticalShift::kOff;
  throw UsageError("--vertical-shift " + word + " is not known; use auto, on or off");
}

// The constraints from --fix, --bound and the lines of the --constraints file.
std::vector<ParameterConstraint> constraints_from(const po::variables_map& values) {
  Words texts;
  for (const char* option : {"fix", "bound"}) {
    const Words words = given<Words>(values, option).value_or(Words{});
    texts.insert(texts.end(), words.begin(), words.end());
  }
  if (const auto file = given(values, "constraints")) {
    std::istringstream lines(read_file(*file));
    for (std::string line; std::getline(lines, line);) {
      line.resize(std::min(line.find('#'), line.size()));
      std::erase_if(line, [](unsigned char c) { return std::isspace(c) != 0; });
      if (!line.empty()) texts.push_back(line);
    }
  }
  std::vector<ParameterConstraint> constraints;
  try {
    for (const std::string& text : texts) constraints.push_back(constraint_from_text(text));
    validate(constraints, given<int>(values, "terms").value_or(1000),
             values.count("allow-negative") > 0);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  return constraints;
}

FitOptions options_from(const po::variables_map& values) {
  FitOptions options;
  constexpr int kMost = 100;
  options.max_terms = values["max-terms"].as<int>();
  options.n_terms = given<int>(values, "terms");
  const int wanted = options.n_terms.value_or(options.max_terms);
  if (wanted < 0 || wanted > kMost) {
    throw UsageError(std::string(options.n_terms ? "--terms " : "--max-terms ") +
                     std::to_string(wanted) + " is outside 0 to " + std::to_string(kMost));
  }
  options.is_liquid = values.count("liquid") > 0;
  options.is_solid = values.count("solid") > 0;
  options.allow_negative = values.count("allow-negative") > 0;
  options.full_data = values.count("full-data") > 0;
  if (values.count("drift") > 0 && values.count("no-drift") > 0) {
    throw UsageError("--drift and --no-drift exclude each other; give one of them");
  }
  if (values.count("drift") > 0) options.drift = TableDrift::kFitted;
  if (values.count("no-drift") > 0) options.drift = TableDrift::kNone;
  options.with_profiles = values.count("profiles") > 0;
  if (const auto n_bootstrap = given<int>(values, "bootstrap")) {
    options.n_bootstrap = *n_bootstrap;
    constexpr int kFewest = 20;  // fewer give no 95 % percentiles
    constexpr int kMostResamples = 100000;
    if (options.n_bootstrap < kFewest || options.n_bootstrap > kMostResamples) {
      throw UsageError("--bootstrap " + std::to_string(options.n_bootstrap) +
                       " is outside 20 to 100000");
    }
  }
  const std::string noise = values["noise"].as<std::string>();
  if (noise != "auto" && noise != "white") {
    throw UsageError("--noise " + noise + " is not known; use auto or white");
  }
  options.white_noise = noise == "white";
  options.vertical_shift = vertical_shift_from_word(values["vertical-shift"].as<std::string>());
  options.constraints = constraints_from(values);
  if (!options.constraints.empty() && !options.n_terms) {
    throw UsageError("--fix and --bound name terms by number, so they need --terms N");
  }
  if (options.is_liquid && options.is_solid) {
    throw UsageError("--liquid and --solid exclude each other; without both, the data decide");
  }
  if (options.is_liquid && options.n_terms == 0) {
    throw UsageError("--liquid needs at least one term, but --terms is 0; give at least 1");
  }
  return options;
}

std::optional<Specimen> specimen_from(const po::variables_map& values) {
  std::optional<Specimen> specimen;
  const auto layer_m = given_quantity(values, "layer-thickness", "m");
  const auto nu = given<double>(values, "poisson-ratio");
  if (const auto file = given(values, "specimen")) specimen = read_specimen(*file);
  if (const auto diameter_m = given_quantity(values, "punch-diameter", "m")) {
    if (!specimen) {
      specimen.emplace();
      specimen->contact.poisson_ratio = 0.495;
    }
    specimen->contact.punch_radius_m = 0.5 * *diameter_m;
  } else if (!specimen && (layer_m || nu)) {
    throw UsageError("--layer-thickness and --poisson-ratio need --punch-diameter or --specimen");
  }
  if (!specimen) return specimen;
  if (layer_m) specimen->contact.layer_thickness_m = *layer_m;
  if (nu) specimen->contact.poisson_ratio = *nu;
  validate(specimen->contact);
  return specimen;
}

// The options that choose rows, and the depth of a record of force.
void add_chosen_part(const po::variables_map& values, FitRequest& request) {
  request.from_s = given_quantity(values, "from", "s");
  request.to_s = given_quantity(values, "to", "s");
  if (request.from_s && request.to_s && !(*request.from_s < *request.to_s)) {
    throw UsageError("--from must be before --to");
  }
  if (const auto hold = given<int>(values, "hold")) {
    request.hold = *hold;
    if (*hold < 1) throw UsageError("--hold counts from 1");
  }
  if (const auto crop = given(values, "crop")) {
    if (*crop != "auto") throw UsageError("--crop " + *crop + " is not known; use auto");
    request.crop = true;
    if (request.hold > 0) throw UsageError("--hold and --crop choose two parts; give one of them");
  }
  request.depth_m = given_quantity(values, "depth", "m");
  if (request.depth_m && !(*request.depth_m > 0.0)) {
    throw UsageError("--depth must be positive, such as \"0.1 mm\"");
  }
}

}  // namespace

FitRequest words_from(const po::variables_map& values) {
  FitRequest words;
  if (const auto kind = given(values, "kind")) words.kind = kind_from_word(*kind);
  words.options = options_from(values);
  words.diagnose = values.count("diagnose") > 0;
  if (const auto model = given(values, "model")) {
    const std::vector<std::string>& names = law_names();
    if (std::find(names.begin(), names.end(), *model) == names.end()) {
      throw UsageError("--model " + *model + " is not known" + did_you_mean(*model, names) +
                       " Use " + listed(names));
    }
    words.model = *model;
    if (words.options.n_terms) {
      throw UsageError("--terms does not belong to --model, because a law has no terms; omit it");
    }
  }
  words.time_zero_s = *given_quantity(values, "time-zero", "s");
  try {
    words.columns = column_map_from_words(given<Words>(values, "column").value_or(Words{}));
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  words.sheet = given(values, "sheet").value_or("");
  words.segments = given<Words>(values, "segment").value_or(Words{});
  if (const auto stiffness_N_m = given_quantity(values, "frame-stiffness", "N/m")) {
    words.frame_stiffness_N_m = *stiffness_N_m;
    if (!(words.frame_stiffness_N_m > 0.0)) {
      throw UsageError("--frame-stiffness must be positive; omit it for a rigid frame");
    }
  }
  add_chosen_part(values, words);
  words.T_ref_C = given_quantity(values, "reference-temperature", "degC");
  words.specimen = specimen_from(values);
  return words;
}

MaterialRequest material_words(const po::variables_map& values, const std::string& command) {
  MaterialRequest words{.command = command, .created_at = now_iso8601()};
  words.nu = given<double>(values, "poisson-ratio");
  words.rho_kg_m3 = given_quantity(values, "density", "kg/m3");
  if (words.rho_kg_m3 && !(*words.rho_kg_m3 > 0.0)) {
    throw UsageError("--density must be positive, such as \"965 kg/m3\"");
  }
  for (const double ratio : given<Numbers>(values, "ratio").value_or(Numbers{})) {
    if (ratio > 0.0) continue;
    throw UsageError("--ratio must be positive; give parts of base to one of curing agent");
  }
  return words;
}

}  // namespace viscard
