#pragma once

#include "models/pillar/body/piezo_static.h"
#include "models/pillar/scene/pillar_scene.h"
#include "models/scene/common/scene_answer.h"

namespace viscard {

// What acts on the top of a static scene: a given pressure (sideways: shear), or as much as it
// takes to move the top by a given displacement. Along the axis a rigid plate without friction
// moves it, so that u_z is one unknown for the whole top (ModelOptions::rigid_top); sideways its
// mean is given, whose multiplier is a uniform shear. All answers are linear in either, so the
// pressure that belongs to a displacement u is that of 1 Pa scaled,
//   p = (u - a V)/s,
// s: displacement per Pa; a V: what a voltage on the electrode does to a free top.

bool moves_top(const PillarScene& scene);

// Mean pressure or shear on the top, Pa.
double top_pressure_Pa(const PillarScene& scene, double displacement_per_Pa_m,
                       double moved_by_voltage_m = 0.0);
// The same from piezo_static() or piezo_one_way() at 1 Pa: electrode open, or at the drive's
// voltage if there is one.
double top_pressure_Pa(const PillarScene& scene, const PiezoAnswer& per_Pa);

// Top displacement per Pa with the electrode shorted.
double shorted_displacement_m(const PiezoAnswer& answer);

// Force on the top along +z (sideways: +x), and force over displacement; of a strip per metre.
void add_top_force(const PillarScene& scene, double force_N, double stiffness_N_m,
                   SceneAnswer& answer);

// A pillar on a film with an electrode, its top moved: voltage and force with the electrode open
// (or driven), the charge that flows onto it shorted, and its capacitance with the top held.
void add_moved_piezoelectric(const PillarScene& scene, const PillarModel& model,
                             const PiezoAnswer& per_Pa, SceneAnswer& answer);

}  // namespace viscard
