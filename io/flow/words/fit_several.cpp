#include "io/flow/words/fit_words.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <utility>

namespace viscard {
namespace {

struct Given {
  const char* option;
  bool is_given;
};

// Options that say how one test is fitted.
std::vector<Given> options_of_single_tests(const FitWords& words) {
  return {{"fix", !words.fix.empty()},
          {"bound", !words.bound.empty()},
          {"constraints", words.constraints.has_value()},
          {"profiles", words.profiles},
          {"spectrum", words.spectrum},
          {"bootstrap", words.bootstrap.has_value()},
          {"allow-negative", words.allow_negative},
          {"model", words.model.has_value()},
          {"diagnose", words.diagnose},
          {"reference-temperature", words.reference_temperature.has_value()},
          {"start-shift", !words.start_shift.empty()}};
}

void refuse_for_tests(const FitWords& words, const std::vector<TestFile>& tests) {
  for (const Given& one : {Given{"kind", words.kind.has_value()}, Given{"joint", words.joint}}) {
    if (!one.is_given) continue;
    throw OptionError(std::string("--") + one.option +
                      " does not belong to tests that state their kind (creep=FILE); omit it");
  }
  if (tests.size() == 1) return;
  for (const Given& one : options_of_single_tests(words)) {
    if (!one.is_given) continue;
    throw OptionError(std::string("--") + one.option + " is for single tests; omit it for several");
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
  if (!tests.empty()) refuse_for_tests(words, tests);
  const bool is_one_result = words.joint || tests.size() > 1 || n_files == 1;
  for (const Given& one :
       {Given{"share", !words.share.empty()}, Given{"specimen-id", !words.specimen_id.empty()},
        Given{"own-terms", words.own_terms}}) {
    if (!words.joint && one.is_given) {
      throw OptionError(std::string("--") + one.option + " needs --joint");
    }
  }
  if (!is_one_result && !words.ratio.empty()) {
    throw OptionError(
        "--ratio is for one input file; for several, give it once for each with --joint");
  }
  if (has_out && !is_one_result) {
    throw OptionError("--out writes the material of one input file, but there are " +
                      std::to_string(n_files) + "; fit them one by one, or with --joint");
  }
  if (words.joint && words.model) {
    throw OptionError("--model answers for single files; omit it with --joint");
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
  return {.files = files,
          .ratios = words.ratio,
          .specimen_ids = words.specimen_id,
          .fit = fit_request(words),
          .material = material_request(words, command),
          .options = mixing_options(words)};
}

}  // namespace viscard
