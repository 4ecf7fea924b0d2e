#include "io/flow/words/fit_words.h"

#include "fit/assembly/constraints.h"
#include "fit/laws/law_values.h"
#include "io/basics/atomic_file.h"
#include "io/basics/option_quantity.h"
#include "io/basics/option_use.h"
#include "io/basics/timestamp.h"
#include "io/basics/words.h"
#include "io/config/config_file.h"
#include "models/hyperelastic/foam_law.h"
#include "models/hyperelastic/hyperelastic_law.h"
#include "models/hyperelastic/mullins_damage.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <utility>

namespace viscard {
namespace {

using Names = std::vector<std::string>;

// Throws OptionError for a word that is neither on nor off.
Plausible plausible_of(const FitWords& words) {
  try {
    return plausible_from_word(words.plausible.value_or("on"), Plausible::kMeasured);
  } catch (const std::invalid_argument& error) {
    throw OptionError(std::string("--") + error.what());
  }
}

// In SI of a number or a text with its unit. Throws OptionError naming the option.
std::optional<double> quantity(const FitWords& words, FitWords::Text FitWords::*text,
                               const char* name, const QuantityOrUnit& unit) {
  try {
    return option_quantity(std::string("--") + name, words.*text, unit, plausible_of(words));
  } catch (const std::invalid_argument& error) {
    throw OptionError(error.what());
  }
}

FitKind kind_from_word(const std::string& word) {
  static const std::vector<std::pair<std::string, FitKind>> kKinds{
      {"indentation", FitKind::kIndentation},
      {"relaxation", FitKind::kRelaxation},
      {"creep", FitKind::kCreep},
      {"dma", FitKind::kDma}};
  Names names;
  for (const auto& [name, kind] : kKinds) {
    if (word == name) return kind;
    names.push_back(name);
  }
  throw OptionError("--kind " + word + " is not known" + did_you_mean(word, names) +
                    " Use indentation, relaxation, creep or dma");
}

VerticalShift vertical_shift_from_word(const std::string& word) {
  if (word == "auto") return VerticalShift::kAuto;
  if (word == "on") return VerticalShift::kOn;
  if (word == "off") return VerticalShift::kOff;
  throw OptionError("--vertical-shift " + word + " is not known; use auto, on or off");
}

// "40=-1.2" or "313 K=-1.2". Throws OptionError.
std::vector<StartShift> start_shifts_from(const FitWords& words) {
  std::vector<StartShift> shifts;
  try {
    for (const std::string& text : words.start_shift) {
      const std::size_t equals = text.find('=');
      const std::string temperature = text.substr(0, equals);
      const auto decades =
          equals == std::string::npos ? std::nullopt : number_from_text(text.substr(equals + 1));
      if (!decades || trimmed(temperature).empty()) {
        throw OptionError("--start-shift " + text +
                          ": write TEMPERATURE=DECADES, log10 a_T of the isotherm at this "
                          "temperature, such as 40=-1.2 or \"313 K=-1.2\"");
      }
      shifts.push_back({option_quantity("--start-shift " + text, temperature,
                                        quantities::kTemperature, plausible_of(words)),
                        *decades});
    }
    validate(shifts);
  } catch (const std::invalid_argument& error) {
    throw OptionError(error.what());
  }
  return shifts;
}

// The constraints from --fix, --bound and the lines of the --constraints file.
std::vector<ParameterConstraint> constraints_from(const FitWords& words) {
  Names texts = words.fix;
  texts.insert(texts.end(), words.bound.begin(), words.bound.end());
  if (words.constraints) {
    std::istringstream lines(read_file(*words.constraints));
    for (std::string line; std::getline(lines, line);) {
      line.resize(std::min(line.find('#'), line.size()));
      std::erase_if(line, [](unsigned char c) { return std::isspace(c) != 0; });
      if (!line.empty()) texts.push_back(line);
    }
  }
  std::vector<ParameterConstraint> constraints;
  try {
    for (const std::string& text : texts) constraints.push_back(constraint_from_text(text));
    validate(constraints, words.terms.value_or(1000), words.allow_negative);
  } catch (const std::invalid_argument& error) {
    throw OptionError(error.what());
  }
  return constraints;
}

FitOptions options_from(const FitWords& words) {
  FitOptions options;
  constexpr int kMost = 100;
  options.max_terms = words.max_terms.value_or(options.max_terms);
  options.n_terms = words.terms;
  refuse_idle<OptionError>({{"--max-terms", words.max_terms.has_value(), !words.terms,
                             "the choice of a number of terms, and --terms states the number"}});
  const int wanted = options.n_terms.value_or(options.max_terms);
  if (wanted < 0 || wanted > kMost) {
    throw OptionError(std::string(options.n_terms ? "--terms " : "--max-terms ") +
                      std::to_string(wanted) + " is outside 0 to " + std::to_string(kMost));
  }
  options.is_liquid = words.liquid;
  options.is_solid = words.solid;
  options.allow_negative = words.allow_negative;
  options.full_data = words.full_data;
  if (words.drift && words.no_drift) {
    throw OptionError("--drift and --no-drift exclude each other; give one of them");
  }
  if (words.drift) options.drift = TableDrift::kFitted;
  if (words.no_drift) options.drift = TableDrift::kNone;
  options.with_profiles = words.profiles;
  options.with_spectrum = words.spectrum;
  if (words.bootstrap) {
    options.n_bootstrap = *words.bootstrap;
    constexpr int kFewest = 20;  // fewer give no 95 % percentiles
    constexpr int kMostResamples = 100000;
    if (options.n_bootstrap < kFewest || options.n_bootstrap > kMostResamples) {
      throw OptionError("--bootstrap " + std::to_string(options.n_bootstrap) +
                        " is outside 20 to 100000");
    }
  }
  const std::string noise = words.noise.value_or("auto");
  if (noise != "auto" && noise != "white") {
    throw OptionError("--noise " + noise + " is not known; use auto or white");
  }
  options.white_noise = noise == "white";
  options.vertical_shift = vertical_shift_from_word(words.vertical_shift.value_or("auto"));
  options.constraints = constraints_from(words);
  if (words.model && !options.constraints.empty()) {
    throw OptionError(
        "--fix and --bound are for the terms of a series, and --model fits a law without terms; "
        "omit them, or omit --model and give --terms");
  }
  if (words.model && options.n_bootstrap > 0) {
    throw OptionError(
        "--bootstrap is for the terms of a series; the intervals of a law (--model) follow from "
        "its covariance. Omit it");
  }
  if (!options.constraints.empty() && !options.n_terms) {
    throw OptionError("--fix and --bound name terms by number, so they need --terms N");
  }
  if (options.is_liquid && options.is_solid) {
    throw OptionError("--liquid and --solid exclude each other; without both, the data decide");
  }
  if (options.is_liquid && options.n_terms == 0) {
    throw OptionError("--liquid needs at least one term, but --terms is 0; give at least 1");
  }
  return options;
}

void refuse_implausible_number(const std::string& name, double value, const Quantity& quantity,
                               const FitWords& words) {
  try {
    refuse_implausible_option(name, value, quantity, plausible_of(words));
  } catch (const std::invalid_argument& error) {
    throw OptionError(error.what());
  }
}

std::optional<Specimen> specimen_from(const FitWords& words) {
  std::optional<Specimen> specimen;
  const auto layer_m =
      quantity(words, &FitWords::layer_thickness, "layer-thickness", quantities::kThickness);
  const std::optional<double> nu = words.poisson_ratio;
  if (nu) refuse_implausible_number("--poisson-ratio", *nu, quantities::kPoissonRatio, words);
  if (words.specimen) specimen = read_specimen(*words.specimen, plausible_of(words));
  if (const auto diameter_m =
          quantity(words, &FitWords::punch_diameter, "punch-diameter", quantities::kTipSize)) {
    if (!specimen) {
      specimen.emplace();
      specimen->contact.poisson_ratio = 0.495;
    }
    specimen->contact.punch_radius_m = 0.5 * *diameter_m;
  } else if (!specimen && layer_m) {
    throw OptionError("--layer-thickness needs --punch-diameter or --specimen");
  }
  if (!specimen) return specimen;
  if (layer_m) specimen->contact.layer_thickness_m = *layer_m;
  if (nu) specimen->contact.poisson_ratio = *nu;
  validate(specimen->contact);
  return specimen;
}

// A time in s. The refusal of a frequency, which is meant for a table of them, names what the option is for.
std::optional<double> time_of(const FitWords& words, FitWords::Text FitWords::*text,
                              const char* name) {
  const FitWords::Text& typed = words.*text;
  if (typed && typed->ends_with("Hz")) {
    throw OptionError("--" + std::string(name) + " is for records in time, and " + *typed +
                      " is a frequency; omit it");
  }
  return quantity(words, text, name, "s");
}

// The options that choose rows, and the depth of a record of force.
void add_chosen_part(const FitWords& words, FitRequest& request) {
  request.from_s = time_of(words, &FitWords::from, "from");
  request.to_s = time_of(words, &FitWords::to, "to");
  if (request.from_s && request.to_s && !(*request.from_s < *request.to_s)) {
    throw OptionError("--from must be before --to");
  }
  if (words.hold) {
    request.hold = *words.hold;
    if (request.hold < 1) throw OptionError("--hold counts from 1");
  }
  if (words.crop) {
    if (*words.crop != "auto")
      throw OptionError("--crop " + *words.crop + " is not known; use auto");
    request.crop = true;
    if (request.hold > 0) throw OptionError("--hold and --crop choose two parts; give one of them");
  }
  request.depth_m = quantity(words, &FitWords::depth, "depth", quantities::kDepth);
  if (request.depth_m && !(*request.depth_m > 0.0)) {
    throw OptionError("--depth must be positive, such as \"0.1 mm\"");
  }
}

}  // namespace

std::vector<std::string> all_model_names() {
  std::vector<std::string> names = law_names();
  for (const auto& name : hyperelastic_names()) names.emplace_back(name);
  names.emplace_back(kMullinsName);
  names.emplace_back(kFoamName);
  for (Eigen::Index n = 1; n <= kMostFoamTerms; ++n) names.push_back(foam_name(n));
  return names;
}

TableChoice table_choice(const FitWords& words) {
  TableChoice choice{words.sheet.value_or("")};
  if (words.table.value_or(1) < 1) throw OptionError("--table counts from 1");
  if (words.skip.value_or(0) < 0) throw OptionError("--skip is a number of lines, from 0");
  choice.table = static_cast<std::size_t>(words.table.value_or(0));
  choice.skip = static_cast<std::size_t>(words.skip.value_or(0));
  return choice;
}

SpecimenSize specimen_size(const FitWords& words) {
  SpecimenSize size;
  size.gauge_length_m =
      quantity(words, &FitWords::gauge_length, "gauge-length", quantities::kThickness)
          .value_or(0.0);
  size.area_m2 = quantity(words, &FitWords::area, "area", "m2").value_or(0.0);
  if (words.gauge_length && !(size.gauge_length_m > 0.0)) {
    throw OptionError("--gauge-length must be positive, such as \"25 mm\"");
  }
  if (words.area && !(size.area_m2 > 0.0)) {
    throw OptionError("--area must be positive, such as \"12 mm2\"");
  }
  return size;
}

FitRequest fit_request(const FitWords& words) {
  FitRequest request;
  request.plausible = plausible_of(words);
  if (words.kind) request.kind = kind_from_word(*words.kind);
  request.options = options_from(words);
  request.diagnose = words.diagnose;
  if (words.model) {
    const std::vector<std::string>& names = law_names();
    const std::vector<std::string> all = all_model_names();
    const bool is_known = std::find(all.begin(), all.end(), *words.model) != all.end();
    const bool is_here = std::find(names.begin(), names.end(), *words.model) != names.end();
    if (is_known && !is_here) {
      throw OptionError("--model " + *words.model +
                        " is a law of large strain; name the tests as such: uniaxial=FILE, "
                        "compression=FILE, planar=FILE or equibiaxial=FILE");
    }
    if (!is_here) {
      throw OptionError("--model " + *words.model + " is not known" +
                        did_you_mean(*words.model, all) + " Use " + listed(names) +
                        "; at large strain (uniaxial=FILE ...): " + listed(hyperelastic_names()));
    }
    request.model = *words.model;
    if (words.terms) {
      throw OptionError("--terms does not belong to --model, because a law has no terms; omit it");
    }
  }
  request.time_zero_s = quantity(words, &FitWords::time_zero, "time-zero", "s");
  try {
    request.columns = column_map_from_words(words.column);
  } catch (const std::invalid_argument& error) {
    throw OptionError(error.what());
  }
  request.table = table_choice(words);
  request.size = specimen_size(words);
  request.size.E0_Pa =
      quantity(words, &FitWords::youngs_modulus, "youngs-modulus", quantities::kModulus)
          .value_or(0.0);
  request.segments = words.segment;
  if (const auto stiffness_N_m =
          quantity(words, &FitWords::frame_stiffness, "frame-stiffness", quantities::kStiffness)) {
    request.frame_stiffness_N_m = *stiffness_N_m;
    if (!(*stiffness_N_m > 0.0)) {
      throw OptionError("--frame-stiffness must be positive; omit it for a rigid frame");
    }
  }
  add_chosen_part(words, request);
  request.T_ref_C =
      quantity(words, &FitWords::reference_temperature, "reference-temperature", "degC");
  request.start_shifts = start_shifts_from(words);
  request.specimen = specimen_from(words);
  request.nu = words.poisson_ratio;
  if (words.modulus_kind) {
    try {
      request.modulus_kind = modulus_kind_from_word(*words.modulus_kind);
    } catch (const std::invalid_argument& error) {
      throw OptionError(std::string("--modulus-kind: ") + error.what());
    }
  }
  request.accepts_unverified = words.unverified;
  return request;
}

MaterialRequest material_request(const FitWords& words, const std::string& command) {
  MaterialRequest request{
      .nu = words.poisson_ratio, .command = command, .created_at = now_iso8601()};
  request.rho_kg_m3 = quantity(words, &FitWords::density, "density", "kg/m3");
  if (request.rho_kg_m3 && !(*request.rho_kg_m3 > 0.0)) {
    throw OptionError("--density must be positive, such as \"965 kg/m3\"");
  }
  for (const double ratio : words.ratio) {
    if (ratio > 0.0) continue;
    throw OptionError("--ratio must be positive; give parts of base to one of curing agent");
  }
  return request;
}

}  // namespace viscard
