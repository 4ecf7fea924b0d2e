#pragma once

#include "models/answer/scene_answer.h"
#include "models/pillar/body/directional_film.h"
#include "models/pillar/body/piezo_static.h"
#include "models/pillar/body/section_grid.h"
#include "models/pillar/scene/pillar_scene.h"

#include <vector>

namespace viscard {

// The load on the top of a static scene: a given pressure (sideways: shear), or the one that moves
// the top by a given displacement. Along the axis a rigid plate without friction
// moves it, so that u_z is one unknown for the whole top (ModelOptions::rigid_top); sideways its
// mean is given, whose multiplier is a uniform shear. All answers are linear in either, so the
// pressure that belongs to a displacement u is that of 1 Pa scaled,
//   p = (u - a V - u_0)/s,
// s: displacement per Pa; a V: the displacement of a free top by a voltage on the electrode; u_0: by weight and heat.

// Mean pressure or shear on the top, Pa.
double top_pressure_Pa(const PillarScene& scene, double displacement_per_Pa_m,
                       double moved_unloaded_m = 0.0);
// The same from piezo_static() or piezo_one_way() at 1 Pa: with the electrode open, or at the
// drive's voltage if there is one. `unloaded`: what weight and heat do without a load on the top.
double top_pressure_Pa(const PillarScene& scene, const PiezoAnswer& per_Pa,
                       const PiezoAnswer& unloaded);

// Whether weight or heat move the pillar without a load (models/answer/surroundings.h); they add to every answer at
// rest along the axis.
bool moves_unloaded(const PillarScene& scene);
// Their forces, and the state under them with a top that bears nothing and an open electrode.
Eigen::VectorXd unloaded_force(const PillarScene& scene, const PillarModel& model);
PillarState unloaded_state(const PillarScene& scene, const PillarModel& model);
// The same of a film with an electrode, whose answer to 1 Pa is given, or with a charge-free face.
PiezoAnswer unloaded_answer(const PillarScene& scene, const PillarModel& coupled,
                            const PiezoAnswer& per_Pa);

// Top displacement per Pa with the electrode shorted.
double shorted_displacement_m(const PiezoAnswer& answer);

// Force on the top along +z (sideways: +x), and force over displacement; of a strip per metre.
void add_top_force(const PillarScene& scene, double force_N, double stiffness_N_m,
                   SceneAnswer& answer);

// A static load along the axis of a pillar whose film has an electrode or a charge-free face: adds
// voltage, charge, capacitance and motion to the answer (eq. 19 to 25).
void run_static_piezo(const PillarScene& scene, SceneAnswer& answer);
// Answer of the film to 1 Pa, on one mesh and averaged in its plane.
FilmAnswer film_answer(const PillarScene& scene, SceneAnswer& answer);
// Results computed from the answer of the film at 1 Pa, and from that without a load.
void add_film_results(const PillarScene& scene, const FilmAnswer& per_Pa, SceneAnswer& answer);

// Effect of the averaging over the directions in the film's plane (film_direction.cpp): corrects
// the results of axial statics for the real directions, and adds an error estimate to the results
// of all other analyses with electrodes. Reports both in the notes.
void add_film_direction(const PillarScene& scene, SceneAnswer& answer);

// A shear on the top along x, and a voltage on the opposite halves of quadrants.

// For loads at rest: checks, results, and the solution for pictures.
void check_sideways(const PillarScene& scene);
void run_sideways(const PillarScene& scene, SceneAnswer& answer);
std::vector<SectionGrid> sideways_fields(const PillarScene& scene, const Discretisation& mesh);

// For loads in time or frequency: checks.
void check_sideways_in_time(const PillarScene& scene);

}  // namespace viscard
