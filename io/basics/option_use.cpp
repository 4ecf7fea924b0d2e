#include "io/basics/option_use.h"

#include <algorithm>

namespace viscard {

std::string idle_option(const OptionUses& uses) {
  for (const OptionUse& use : uses) {
    if (use.is_given && !use.has_effect) return use.option + " is for " + use.of + "; omit it";
  }
  return "";
}

void add_uses(const OptionUses& more, OptionUses& all) {
  for (const OptionUse& use : more) {
    const auto same = std::find_if(
        all.begin(), all.end(), [&](const OptionUse& other) { return other.option == use.option; });
    if (same == all.end()) {
      all.push_back(use);
      continue;
    }
    same->is_given |= use.is_given;
    same->has_effect |= use.has_effect;
  }
}

}  // namespace viscard
