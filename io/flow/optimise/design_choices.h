#pragma once

#include "io/basics/written_path.h"
#include "io/flow/optimise/design_spec.h"

#include <string>
#include <vector>

namespace viscard {

// One specification for each combination, the first choice slowest: its scene has the chosen values, `chosen` names
// them, and it has no choices. Throws std::runtime_error if a key lies in no section of the scene.
std::vector<DesignSpec> chosen_specs(const DesignSpec& spec);

// The values of the choices as they are written.
WrittenValues written_choices(const DesignSpec& spec);

// "geometry.electrode.kind = sampled, ..."; empty if nothing was chosen.
std::string text_of_chosen(const StudyValues& chosen, const WrittenValues& written);

}  // namespace viscard
