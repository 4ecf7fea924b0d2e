#include "io/flow/large_strain/large_strain_words.h"

#include "io/basics/option_quantity.h"
#include "io/basics/option_use.h"
#include "io/basics/units.h"
#include "io/basics/words.h"
#include "models/hyperelastic/mullins_damage.h"
#include "models/maths/interval.h"
#include "models/maths/text_of_number.h"

#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

// "yeoh", "yeoh+mullins-or" (with damage) or "mullins-or" (every law with it).
void take_model(const LargeStrainWords& words, LargeStrainOptions& options) {
  if (!words.model) return;
  const std::string damage = kMullinsName, behind = "+" + damage;
  std::string law = *words.model;
  if (law == kFoamName) options.foam_terms = {1, 2, 3};
  if (const auto n_terms = foam_terms_of(law)) options.foam_terms = {*n_terms};
  if (!options.foam_terms.empty()) return;
  options.with_damage = law == damage || law.ends_with(behind);
  if (law == damage) return;
  if (options.with_damage) law.resize(law.size() - behind.size());
  for (const HyperelasticForm form : hyperelastic_forms()) {
    if (law == name_of(form)) {
      options.forms = {form};
      return;
    }
  }
  throw OptionError(
      "--model " + *words.model + " is no law of rubber" + did_you_mean(law, hyperelastic_names()) +
      " Use " + listed(hyperelastic_names()) + "; LAW" + behind +
      " adds the damage of the first loading, " + damage + " alone adds it to all; " + kFoamName +
      " and " + foam_name(1) + " to " + foam_name(kMostFoamTerms) + " are foams");
}

// What belongs to foams alone, and what does not belong to them.
void check_foam(const LargeStrainWords& words, const LargeStrainRequest& request) {
  if (request.options.foam_terms.empty()) {
    if (words.poisson_ratio) {
      throw OptionError(
          "--poisson-ratio is for foams at large strain; rubber keeps its volume. Omit it, or add "
          "--model hyperfoam");
    }
    for (const LargeStrainFile& file : request.files) {
      if (!file.is_foam_only) continue;
      throw OptionError(name_of(file.foam_test) + "=" + file.path +
                        " is a test of a foam, whose volume changes; add --model hyperfoam");
    }
    return;
  }
  const auto refuse = [](bool is_given, const char* option, const char* why) {
    if (!is_given) return;
    throw OptionError(std::string(option) + " does not belong to foams: " + why + "; omit it");
  };
  refuse(words.terms.value_or(0) > 0 || words.max_terms.value_or(0) > 0, "--terms",
         "they have no relaxation here");
  refuse(words.youngs_modulus.has_value(), "--youngs-modulus", "it follows from all constants");
  refuse(request.options.weight == StressWeight::kRelative, "--weight relative",
         "stresses count by the largest one of their test");
  if (!words.poisson_ratio) return;
  if (*words.poisson_ratio > -0.45 && *words.poisson_ratio < 0.495) return;
  throw OptionError("--poisson-ratio " + text_of(*words.poisson_ratio) +
                    " of a foam must be between -0.45 and 0.495");
}

// Damage is a matter of whole records, and never stands beside terms.
void check_damage(const LargeStrainRequest& request) {
  const LargeStrainOptions& options = request.options;
  if (!options.with_damage) return;
  if (request.cycle.value_or(0) != 0) {
    throw OptionError("--cycle " + std::to_string(*request.cycle) + " keeps one loading, and " +
                      kMullinsName + " needs the whole record; omit one of the two");
  }
  if (options.n_terms.value_or(options.max_terms.value_or(0)) > 0) {
    throw OptionError(std::string("terms of relaxation do not stand beside ") + kMullinsName +
                      ": solvers let the damage act on different parts of such a law; omit "
                      "--terms and --max-terms, or " +
                      kMullinsName);
  }
}

StressWeight weight_from(const LargeStrainWords& words) {
  const std::string word = words.weight.value_or("equal");
  if (word == "equal") return StressWeight::kEqual;
  if (word == "relative") return StressWeight::kRelative;
  throw OptionError("--weight " + word + " is not known; use equal or relative");
}

// A number from 1, or "all".
std::optional<int> cycle_from(const LargeStrainWords& words) {
  const auto& word = words.cycle;
  if (!word) return std::nullopt;
  if (*word == "all") return 0;
  const auto number = integer_from_text(*word);
  if (number && *number >= 1 && *number <= 1000000) return static_cast<int>(*number);
  throw OptionError("--cycle " + *word + " must be a number from 1, or all");
}

// Terms of relaxation.
std::optional<int> terms_from(const std::optional<int>& number, const char* option) {
  constexpr int kMost = 20;
  if (!number || (*number >= 0 && *number <= kMost)) return number;
  throw OptionError(std::string(option) + " " + std::to_string(*number) + " is outside 0 to " +
                    std::to_string(kMost) + " for tests at large strain");
}

// "1.8 MPa" or "1.8 MPa +- 0.1 MPa", of E0, or behind "E_inf=" of what is left after all relaxation.
std::optional<KnownModulus> modulus_from(const LargeStrainWords& words, Plausible judged) {
  const auto& text = words.youngs_modulus;
  if (!text) return std::nullopt;
  try {
    const std::size_t sign = text->find("+-"), equals = text->find('=');
    const std::string which =
        equals == std::string::npos ? "E0" : std::string(trimmed(text->substr(0, equals)));
    if (which != "E0" && which != "E_inf") {
      throw std::invalid_argument("'" + which + "' is neither E0 nor E_inf");
    }
    const std::size_t from = equals == std::string::npos ? 0 : equals + 1;
    KnownModulus known{si_from_text(trimmed(text->substr(from, sign - from)), "Pa"), 0.0,
                       which == "E_inf"};
    if (sign != std::string::npos) {
      const double half = si_from_text(trimmed(std::string_view(*text).substr(sign + 2)), "Pa");
      if (!(half > 0.0)) throw std::invalid_argument("the error must be positive");
      known.se_Pa = half / kNormal95;
    }
    if (!(known.value_Pa > 0.0)) throw std::invalid_argument("a modulus must be positive");
    if (const auto doubt = doubt_about(quantities::kModulus, known.value_Pa, judged)) {
      throw std::invalid_argument(doubt->with_remedy(
          "write \"" + (equals == std::string::npos ? "" : which + "=") + doubt->meant + "\"",
          "add --plausible off"));
    }
    return known;
  } catch (const std::invalid_argument& error) {
    throw OptionError("--youngs-modulus " + *text + ": " + error.what());
  }
}

}  // namespace

void add_large_strain_options(OptionList& list, LargeStrainWords& words) {
  list.group("Large strain");
  list.add("weight", &words.weight,
           "equal (default; every stress counts alike) or relative (by its own size)")
      .among({"equal", "relative"});
  list.add("cycle", &words.cycle,
           "fit the loading of this cycle of records with unloading (default: the last), or all "
           "rows")
      .of("1");
}

LargeStrainWords with_shared_options(LargeStrainWords words, const FitWords& fit) {
  words.model = fit.model;
  words.table = table_choice(fit);
  words.plausible = fit.plausible;
  words.unverified = fit.unverified;
  words.youngs_modulus = fit.youngs_modulus;
  words.size = specimen_size(fit);
  words.column = fit.column;
  words.terms = fit.terms;
  words.max_terms = fit.max_terms;
  words.poisson_ratio = fit.poisson_ratio;
  return words;
}

LargeStrainRequest large_strain_request(const LargeStrainWords& words,
                                        std::vector<LargeStrainFile> files) {
  LargeStrainRequest request;
  request.files = std::move(files);
  try {
    request.columns = column_map_from_words(words.column);
  } catch (const std::invalid_argument& error) {
    throw OptionError(error.what());
  }
  request.table = words.table;
  request.size = words.size;
  request.accepts_unverified = words.unverified;
  take_model(words, request.options);
  request.options.weight = weight_from(words);
  try {
    request.plausible = plausible_from_word(words.plausible.value_or("on"), Plausible::kMeasured);
  } catch (const std::invalid_argument& error) {
    throw OptionError(std::string("--") + error.what());
  }
  request.options.modulus = modulus_from(words, request.plausible);
  request.options.n_terms = terms_from(words.terms, "--terms");
  request.options.max_terms = terms_from(words.max_terms, "--max-terms");
  refuse_idle<OptionError>({{"--max-terms", words.max_terms.has_value(), !words.terms,
                             "the choice of a number of terms, and --terms states the number"}});
  request.cycle = cycle_from(words);
  check_damage(request);
  check_foam(words, request);
  request.options.poisson_ratio = words.poisson_ratio;
  return request;
}

}  // namespace viscard
