#include "io/flow/optimise/design_choices.h"

namespace viscard {

std::vector<DesignSpec> chosen_specs(const DesignSpec& spec) {
  if (spec.choices.empty()) return {spec};
  std::vector<DesignSpec> specs;
  for (std::size_t point = 0; point < count_combinations(spec); ++point) {
    DesignSpec one = spec;
    one.choices.clear();
    one.chosen.resize(spec.choices.size());
    std::size_t rest = point;
    for (std::size_t k = spec.choices.size(); k-- > 0;) {
      const DesignChoice& choice = spec.choices[k];
      one.chosen[k] = {choice.key, choice.values[rest % choice.values.size()]};
      rest /= choice.values.size();
    }
    one.scene_text = scene_text_with(spec.scene_text, spec.scene_path, one.chosen);
    specs.push_back(std::move(one));
  }
  return specs;
}

WrittenValues written_choices(const DesignSpec& spec) {
  std::vector<std::string> all;
  for (const DesignChoice& choice : spec.choices)
    all.insert(all.end(), choice.values.begin(), choice.values.end());
  return {all, spec.scene_path.parent_path()};
}

std::string text_of_chosen(const StudyValues& chosen, const WrittenValues& written) {
  std::string text;
  for (const auto& [key, value] : chosen)
    text += (text.empty() ? "" : ", ") + key + " = " + written(value);
  return text;
}

}  // namespace viscard
