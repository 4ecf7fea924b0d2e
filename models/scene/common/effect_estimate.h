#pragma once

#include <string>

namespace viscard {

// What an effect is to a scene.
enum class EffectRole {
  kAbsent,    // the scene has nothing for it to act on: off, at no error
  kOptional,  // the estimate decides
  kNeeded,    // what is asked for does not exist without it
  kOutside    // no analysis can compute it; the estimate bounds what it would change, as a warning
};

// A-priori estimate of leaving an effect out, from the scene's numbers alone; nothing is solved.
// models/scene/README.md lists the formulas and their sources.
struct EffectEstimate {
  EffectRole role = EffectRole::kAbsent;
  double error = 0.0;  // largest relative error of what is asked for if the effect is left out
  std::string number;  // the number that decides, such as "E A/(k L)"
  double value = 0.0;  // of that number
  std::string reason;  // one clause
};

}  // namespace viscard
