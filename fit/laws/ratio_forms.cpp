#include "fit/laws/ratio_forms.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

void check_shared(const std::vector<std::string>& names, int n_terms) {
  for (const std::string& name : names) {
    bool is_known = false;
    for (int i = 1; i <= n_terms; ++i) {
      is_known |= name == "g_" + std::to_string(i) || name == "tau_" + std::to_string(i);
    }
    if (is_known) continue;
    throw std::invalid_argument("'" + name + "' cannot be shared: there are E0, g, tau, and g_i " +
                                "and tau_i of " +
                                counted(static_cast<std::size_t>(n_terms), "term"));
  }
}

// With numbers of terms of their own, only the modulus can follow a law: no term of one ratio
// corresponds to a term of another.
std::vector<RatioForm> forms_of_modulus(int highest, const MixingOptions& options) {
  std::vector<RatioForm> forms{{RatioVariable::kLogRatio, kPerRatio, kPerRatio, kPerRatio}};
  for (const RatioVariable variable : options.variables) {
    for (int degree = 0; degree <= highest; ++degree) {
      forms.push_back({variable, degree, kPerRatio, kPerRatio});
    }
  }
  return forms;
}

std::vector<RatioForm> forms_of_terms(int highest, int n_terms, const MixingOptions& options) {
  constexpr auto kAny = RatioVariable::kLogRatio;
  std::vector<RatioForm> forms{{kAny, kPerRatio, 0, 0},
                               {kAny, kPerRatio, kPerRatio, 0},
                               {kAny, kPerRatio, kPerRatio, kPerRatio}};
  for (const RatioVariable variable : options.variables) {
    for (int E0 = 0; E0 <= highest; ++E0) {
      for (int g = 0; g <= (n_terms > 0 ? 1 : 0); ++g) {
        for (int tau = 0; tau <= (n_terms > 0 ? 1 : 0); ++tau) {
          forms.push_back({variable, E0, g, tau});
        }
      }
    }
  }
  return forms;
}

}  // namespace

void check_forms(const MixingOptions& options, int n_terms) {
  check_shared(options.shared, n_terms);
  if (!options.own_terms || (!options.share_g && !options.share_times && options.shared.empty())) {
    return;
  }
  throw std::invalid_argument(
      "with numbers of terms of their own, the ratios cannot share g or tau; share E0 only, or fit "
      "all with the same number of terms");
}

std::vector<RatioForm> forms_to_try(const RatioModel& shape, const MixingOptions& options) {
  const int highest =
      shape.ratios.size() >= 4 ? options.max_degree : std::min(options.max_degree, 1);
  std::vector<RatioForm> forms = shape.own_terms.empty()
                                     ? forms_of_terms(highest, shape.n_terms, options)
                                     : forms_of_modulus(highest, options);
  std::erase_if(forms, [&](const RatioForm& form) {
    return (options.share_E0 && form.E0_degree != 0) || (options.share_g && form.g_degree != 0) ||
           (options.share_times && form.tau_degree != 0);
  });
  std::vector<RatioForm> once;
  for (RatioForm& form : forms) {
    form.same = options.shared;
    if (shape.n_terms == 0 && form.g_degree == kPerRatio && shape.own_terms.empty()) continue;
    if (std::find(once.begin(), once.end(), form) == once.end()) once.push_back(form);
  }
  return once;
}

bool reaches_all_ratios(const RatioModel& shape, const RatioForm& form) {
  return shape.own_terms.empty() ? is_law(form) : form.E0_degree != kPerRatio;
}

}  // namespace viscard
