#pragma once

#include <map>
#include <string>

namespace viscard {

// What a scene says about one effect; effects it does not name are kAuto: the plan decides.
enum class EffectChoice { kAuto, kOn, kOff };
using EffectChoices = std::map<std::string, EffectChoice>;  // by name, effects.h

}  // namespace viscard
