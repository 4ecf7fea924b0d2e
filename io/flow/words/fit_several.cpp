#include "io/basics/option_use.h"
#include "io/flow/input_files.h"
#include "io/flow/words/fit_words.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace viscard {
namespace {

// Options that state how one test is fitted; a joint fit takes series and their covariances alone,
// on which the first ones have no effect.
OptionUses options_of_single_tests(const FitWords& words) {
  const char* const kWhat = "single tests, and these are fitted together";
  const bool in_joint = words.joint;
  return {{"--profiles", words.profiles, false, kWhat},
          {"--spectrum", words.spectrum, false, kWhat},
          {"--bootstrap", words.bootstrap.has_value(), false, kWhat},
          {"--model", words.model.has_value(), false, kWhat},
          {"--diagnose", words.diagnose, false, kWhat},
          {"--fix", !words.fix.empty(), in_joint, kWhat},
          {"--bound", !words.bound.empty(), in_joint, kWhat},
          {"--constraints", words.constraints.has_value(), in_joint, kWhat},
          {"--allow-negative", words.allow_negative, in_joint, kWhat},
          {"--reference-temperature", words.reference_temperature.has_value(), in_joint, kWhat},
          {"--start-shift", !words.start_shift.empty(), in_joint, kWhat}};
}

void refuse_for_tests(const FitWords& words) {
  const char* const kWhat = "files that do not state their kind of test (creep=FILE does)";
  refuse_idle<OptionError>(
      {{"--kind", words.kind.has_value(), false, kWhat}, {"--joint", words.joint, false, kWhat}});
}

// Material files are fitted already. Density and Poisson ratio would go into a material.
void refuse_for_materials(const FitWords& words) {
  FitWords given = words;
  const OptionList list = options_of(given);
  for (const Option& option : list.all()) {
    const bool is_of_joint = option.group == "Several specimens" || option.name == "plausible";
    const bool is_of_material = option.name == "density" || option.name == "poisson-ratio";
    if (is_of_joint || is_of_material || option.name == "unverified") continue;
    refuse_idle<OptionError>(
        {{"--" + option.name, is_set(option), false, "records, and material files have none"}});
  }
}

MixingOptions mixing_options(const FitWords& words) {
  MixingOptions options{.own_terms = words.own_terms};
  for (const std::string& name : words.share) {
    if (name == "E0") {
      options.share_E0 = true;
    } else if (name == "g") {
      options.share_g = true;
    } else if (name == "tau") {
      options.share_times = true;
    } else if (name.rfind("g_", 0) == 0 || name.rfind("tau_", 0) == 0) {
      options.shared.push_back(name);
    } else {
      throw OptionError("--share " + name +
                        " is not known; use E0, g, tau, or g_i and tau_i of single terms");
    }
  }
  return options;
}

}  // namespace

void refuse_contradictions(const FitWords& words, const std::vector<TestFile>& tests,
                           std::size_t n_files, bool has_out) {
  if (!tests.empty()) refuse_for_tests(words);
  if (words.joint || tests.size() > 1) refuse_idle<OptionError>(options_of_single_tests(words));
  const bool is_one_result = words.joint || tests.size() > 1 || n_files == 1;
  for (const auto& [option, is_given] : {std::pair{"--share", !words.share.empty()},
                                         std::pair{"--specimen-id", !words.specimen_id.empty()},
                                         std::pair{"--own-terms", words.own_terms}}) {
    if (!words.joint && is_given) throw OptionError(std::string(option) + " needs --joint");
  }
  if (!is_one_result && !words.ratio.empty()) {
    throw OptionError(
        "--ratio is for one input file; for several, give it once for each with --joint");
  }
  if (has_out && !is_one_result) {
    throw OptionError("--out writes the material of one input file, but there are " +
                      std::to_string(n_files) + "; fit them one by one, or with --joint");
  }
}

JointRequest joint_request(const FitWords& words, const std::vector<std::string>& files,
                           const std::string& command) {
  for (const auto& [option, count] : {std::pair{"ratio", words.ratio.size()},
                                      std::pair{"specimen-id", words.specimen_id.size()}}) {
    if (count == 0 || count == files.size()) continue;
    throw OptionError(
        fmt::format("there are {} and {} --{}; give one for each file, in their order",
                    counted(files.size(), "file"), count, option));
  }
  if (words.own_terms && words.terms) {
    throw OptionError("--terms gives all ratios the same number of terms; omit it or --own-terms");
  }
  if (std::all_of(files.begin(), files.end(), is_material_file)) refuse_for_materials(words);
  return {.files = files,
          .ratios = words.ratio,
          .specimen_ids = words.specimen_id,
          .fit = fit_request(words),
          .material = material_request(words, command),
          .options = mixing_options(words)};
}

}  // namespace viscard
