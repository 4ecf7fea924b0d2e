#pragma once

#include "models/pillar/mesh/pillar_geometry.h"

#include <vector>

namespace viscard {

// Breaks along x of the film outside the pillar, graded toward the rim of the bond.
std::vector<double> film_radii(const FilmGeometry& film, double bond_radius_m,
                               const Discretisation& d);

// Breaks along z, graded toward the rim of the bond.
std::vector<double> film_heights(const FilmGeometry& film, double bond_radius_m,
                                 const Discretisation& d);

// Number of layers toward the held corner at the film's end that can be left out, because the
// corner is far from the loads.
int layers_not_felt(double from_load_m, double thickness_m);

// Layers of a graded mesh toward the film's own rim, where its held bottom ends: at least 1, which
// means none. Fewer than at the rim of the bond if the film is wide, because what happens under the
// pillar and its electrode decays toward the rim.
int film_rim_layers(const FilmGeometry& film, double bond_radius_m, const Discretisation& d);

// Adds layers toward the edge of the film's electrode and toward the film's rim to breaks that
// are graded toward the rim of the bond.
void grade_film(const FilmGeometry& film, double bond_radius_m, const Discretisation& d,
                std::vector<double>& x, std::vector<double>& z);

}  // namespace viscard
