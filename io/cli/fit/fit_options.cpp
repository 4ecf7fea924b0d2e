#include "io/cli/fit/fit_options.h"

#include "fit/assembly/constraints.h"
#include "io/basics/atomic_file.h"
#include "io/basics/timestamp.h"
#include "io/basics/units.h"
#include "io/basics/words.h"
#include "io/cli/words/command_line.h"
#include "io/config/config_file.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <utility>

namespace po = boost::program_options;

namespace viscard {
namespace {

using Words = std::vector<std::string>;

// Reads a quantity from the command line. Throws UsageError if the text is not one.
double quantity(const po::variables_map& values, const char* option, const char* si_unit) {
  try {
    return si_from_text(values[option].as<std::string>(), si_unit);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--") + option + ": " + error.what());
  }
}

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

// The constraints from --fix, --bound and the lines of the --constraints file.
std::vector<ParameterConstraint> constraints_from(const po::variables_map& values) {
  Words texts;
  for (const char* option : {"fix", "bound"}) {
    if (values.count(option) == 0) continue;
    const auto words = values[option].as<Words>();
    texts.insert(texts.end(), words.begin(), words.end());
  }
  if (values.count("constraints") > 0) {
    std::istringstream lines(read_file(values["constraints"].as<std::string>()));
    for (std::string line; std::getline(lines, line);) {
      line.resize(std::min(line.find('#'), line.size()));
      std::erase_if(line, [](unsigned char c) { return std::isspace(c) != 0; });
      if (!line.empty()) texts.push_back(line);
    }
  }
  std::vector<ParameterConstraint> constraints;
  try {
    for (const std::string& text : texts) constraints.push_back(constraint_from_text(text));
    const int n_terms = values.count("terms") > 0 ? values["terms"].as<int>() : 1000;
    validate(constraints, n_terms, values.count("allow-negative") > 0);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  return constraints;
}

FitOptions options_from(const po::variables_map& values) {
  FitOptions options;
  constexpr int kMost = 100;
  options.max_terms = values["max-terms"].as<int>();
  if (values.count("terms") > 0) options.n_terms = values["terms"].as<int>();
  const int wanted = options.n_terms.value_or(options.max_terms);
  if (wanted < 0 || wanted > kMost) {
    throw UsageError(std::string(options.n_terms ? "--terms " : "--max-terms ") +
                     std::to_string(wanted) + " is outside 0 to " + std::to_string(kMost));
  }
  options.is_liquid = values.count("liquid") > 0;
  options.allow_negative = values.count("allow-negative") > 0;
  options.full_data = values.count("full-data") > 0;
  options.with_profiles = values.count("profiles") > 0;
  if (values.count("bootstrap") > 0) {
    options.n_bootstrap = values["bootstrap"].as<int>();
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
  options.constraints = constraints_from(values);
  if (!options.constraints.empty() && !options.n_terms) {
    throw UsageError("--fix and --bound name terms by number, so they need --terms N");
  }
  if (options.is_liquid && options.n_terms == 0) {
    throw UsageError("--liquid needs at least one term, but --terms is 0; give at least 1");
  }
  return options;
}

std::optional<Specimen> specimen_from(const po::variables_map& values) {
  std::optional<Specimen> specimen;
  if (values.count("specimen") > 0) specimen = read_specimen(values["specimen"].as<std::string>());
  if (values.count("punch-diameter") > 0) {
    if (!specimen) {
      specimen.emplace();
      specimen->contact.poisson_ratio = 0.495;
    }
    specimen->contact.punch_radius_m = 0.5 * quantity(values, "punch-diameter", "m");
  } else if (!specimen &&
             (values.count("layer-thickness") > 0 || values.count("poisson-ratio") > 0)) {
    throw UsageError("--layer-thickness and --poisson-ratio need --punch-diameter or --specimen");
  }
  if (!specimen) return specimen;
  if (values.count("layer-thickness") > 0) {
    specimen->contact.layer_thickness_m = quantity(values, "layer-thickness", "m");
  }
  if (values.count("poisson-ratio") > 0) {
    specimen->contact.poisson_ratio = values["poisson-ratio"].as<double>();
  }
  validate(specimen->contact);
  return specimen;
}

}  // namespace

FitRequest words_from(const po::variables_map& values) {
  FitRequest words;
  if (values.count("kind") > 0) words.kind = kind_from_word(values["kind"].as<std::string>());
  words.options = options_from(values);
  words.diagnose = values.count("diagnose") > 0;
  words.time_zero_s = quantity(values, "time-zero", "s");
  if (values.count("column") > 0) {
    try {
      words.columns = column_map_from_words(values["column"].as<Words>());
    } catch (const std::invalid_argument& error) {
      throw UsageError(error.what());
    }
  }
  if (values.count("segment") > 0) words.segments = values["segment"].as<Words>();
  if (values.count("frame-stiffness") > 0) {
    words.frame_stiffness_N_m = quantity(values, "frame-stiffness", "N/m");
    if (!(words.frame_stiffness_N_m > 0.0)) {
      throw UsageError("--frame-stiffness must be positive; omit it for a rigid frame");
    }
  }
  if (values.count("reference-temperature") > 0) {
    words.T_ref_C = quantity(values, "reference-temperature", "degC");
  }
  words.specimen = specimen_from(values);
  return words;
}

MaterialRequest material_words(const po::variables_map& values, const std::string& command) {
  MaterialRequest words{.command = command, .created_at = now_iso8601()};
  if (values.count("poisson-ratio") > 0) words.nu = values["poisson-ratio"].as<double>();
  if (values.count("density") > 0) {
    words.rho_kg_m3 = quantity(values, "density", "kg/m3");
    if (!(words.rho_kg_m3 > 0.0))
      throw UsageError("--density must be positive, such as \"965 kg/m3\"");
  }
  if (values.count("ratio") > 0) {
    for (const double ratio : values["ratio"].as<std::vector<double>>()) {
      if (!(ratio > 0.0))
        throw UsageError("--ratio must be positive; give parts of base to one of curing agent");
    }
  }
  return words;
}

}  // namespace viscard
