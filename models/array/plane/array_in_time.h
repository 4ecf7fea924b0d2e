#pragma once

#include "models/array/plane/array_scene.h"
#include "models/array/plane/array_transfer.h"

#include <string>
#include <vector>

namespace viscard {

// What harmonic and transient analyses of a row share. Outputs are those of ArrayTransfer: the
// tops, then the voltages.

// Number of modes of each pillar to take along. It rises with the mesh, so that the change from
// mesh to mesh contains what the left-out modes would add. For a sweep: about twice the modes of
// the rod and of the shear beam below its highest frequency; 0: no such frequency.
int modes_for(const ArrayScene& scene, const Discretisation& mesh, double highest_Hz);

// Relative error of letting the film follow at once: it lacks (f/f_film)^2 of its motion,
// f_film = c_s/(4 t) (eq. A2). Voltages come from the film alone; of a top's displacement the film
// has a share.
double film_error(const ArrayScene& scene, const ArrayTransfer& transfer, double frequency_Hz);

std::vector<int> loaded_of(const ArrayScene& scene);  // 0-based
std::string name_of(const ArrayScene& scene, Eigen::Index output);
bool is_wanted(const ArrayScene& scene, const std::string& name);

// The results that a row in time or frequency may be asked for.
std::vector<std::string> names_in_time(const ArrayScene& scene);

}  // namespace viscard
