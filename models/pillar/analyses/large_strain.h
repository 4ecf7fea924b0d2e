#pragma once

#include "models/answer/scene_answer.h"
#include "models/pillar/body/section_grid.h"
#include "models/pillar/scene/pillar_scene.h"

#include <string>
#include <vector>

namespace viscard {

// A pillar of rubber under a static load along its axis, at large strain (models/pillar/large).

// A clause that says why large strain is not computed for a scene, or nullptr.
const char* why_small_strain(const PillarScene& scene);
// The scene has a law, can be answered at large strain, and its plan wants that.
bool is_large(const PillarScene& scene);

// The answer on one mesh. On a film with electrodes the linear answer, in which the field acts back,
// is multiplied by what large strain changes one way: the pillar at large strain on the linear film
// without its field, over the same pillar at small strain.
void run_large(const PillarScene& scene, SceneAnswer& answer);
// Says that the relaxation of a scene does not count if the plan reduced it to large strain; otherwise empty.
std::string at_once_note(const PillarScene& scene, const PillarScene& reduced);
// The solution for pictures, at places of rest.
std::vector<SectionGrid> large_fields(const PillarScene& scene, const Discretisation& mesh);

// Largest relative change of a pillar's stiffness up to a strain (of a top that is pressed: below
// 0): the law's nominal stress in tension at 1 + strain against E_0 times the strain,
//   kLargeStrainMargin max |P(1 + e)/(E_0 e) - 1| + 2 strain c, c = 2 S^2/(1 + 2 S^2)           (E11)
// over strains e from 0 to the given one, the maximum at least the strain itself. A bonded disc of the shape factor
// S = d/(4 L) has the modulus E (1 + 2 S^2), and S changes by the strain (Gent & Lindley, Proc. Inst.
// Mech. Eng. 173 (1959) 111). 1 where the law ends before.
double large_strain_error(const PillarScene& scene, double strain);
// Clamped ends strain more than the mean; set against pillars of five laws (tests/models/pillar/large).
inline constexpr double kLargeStrainMargin = 1.5;

}  // namespace viscard
