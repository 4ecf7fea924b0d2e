#pragma once

#include "models/answer/scene_answer.h"
#include "models/array/space/space_contact.h"

#include <string>
#include <vector>

namespace viscard {

// Names of the maps and of the single results of a scene with a shape:
//   pillar_force           N, down
//   contact_share_percent  of the area of a top
//   moment_x, moment_y     N m, int p x dA and int p y dA
//   shear_force_x, _y      N, on tops that stick
//   contact_force          N, of the whole array; contacts; depth, m; largest_pressure, Pa, on one top
std::vector<std::string> contact_maps(const SpaceScene& scene);
std::vector<std::string> contact_results();

// Adds the maps and results that the scene wants to an answer that already has its array. Errors
// are the changes from grid to grid.
void add_contact(const SpaceScene& scene, const SpaceContact& contact, SceneAnswer& answer);

// The largest error of forces and moments of the tops, relative to the reference values of the
// tolerance.
double contact_error(const SpaceContact& contact);

// Effects that a linear answer without friction does not include: buckling, large strains and
// slopes, tops that touch their neighbours.
std::vector<std::string> contact_notes(const SpaceScene& scene, const SpaceContact& contact);

}  // namespace viscard
