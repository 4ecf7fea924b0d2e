#include "models/pillar/mesh/film_mesh.h"

#include "models/pillar/mesh/line_mesh.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

// Layers toward the film's rim that are left out per thickness between the load and the rim. Along a
// strip with a held and a free face a field decays as exp(-g x/t) with
//   (3 - 4 nu) sin^2 g = 4 (1 - nu)^2 - g^2,
// the thin limit of the equation of a clamped-free wedge; g is 0.74 at nu = 0.5 and 1.2 at nu = 0.
// A corner's share of the error is the square of the field there, and each layer takes ratio^(2
// lambda) off it, lambda = 0.7: g/(lambda ln(1/ratio)) layers. Source: Williams, J. Appl. Mech. 19
// (1952) 526.
constexpr double kSkippedPerThickness = 0.56;

bool is_same(double a, double b, const FilmGeometry& film) {
  return std::abs(a - b) <= 1e-9 * film.radius_m;
}

// Length of the layers toward a corner at x = from_m, on its inner (side -1) or outer side (1).
// They end at the next corner or on the axis. The field changes over the distance to the nearest
// corner on either side, so the layers extend at most one layer beyond this distance.
double reach_m(const FilmGeometry& film, double bond_radius_m, double ratio, double from_m,
               int side) {
  double nearest_m = film.radius_m;  // corner on either side
  double free_m = side < 0 ? from_m : film.radius_m - from_m;
  for (const double corner_m : {bond_radius_m, film.electrode_radius_m, film.radius_m}) {
    const double outward_m = corner_m - from_m;
    if (corner_m == 0.0 || is_same(corner_m, from_m, film)) continue;
    nearest_m = std::min(nearest_m, std::abs(outward_m));
    if (side * outward_m > 0.0) free_m = std::min(free_m, side * outward_m);
  }
  return std::min({free_m, bond_radius_m, nearest_m / ratio});
}

// Adds breaks at distances that shrink toward a corner, on one side of it. Existing breaks at about
// such a distance, for example layers toward another corner, are used instead of new ones.
void grade_side(double corner_m, int side, double length_m, int layers, double ratio,
                std::vector<double>& breaks) {
  for (int k = 1; k < layers; ++k) {
    const double distance_m = length_m * std::pow(ratio, k);
    const bool has_one = std::any_of(breaks.begin(), breaks.end(), [&](double b) {
      const double share = side * (b - corner_m) / distance_m;
      return share > 0.6 && share < 1.4;
    });
    if (!has_one) insert_break(breaks, corner_m + side * distance_m);
  }
}

// Toward the bottom: cuts the lowest interval into layers.
void grade_bottom(int layers, double ratio, std::vector<double>& z) {
  if (layers < 2) return;
  std::vector<double> graded = graded_breaks(z[0], z[1], layers, ratio, false);
  graded.insert(graded.end(), z.begin() + 2, z.end());
  z = std::move(graded);
}

}  // namespace

std::vector<double> film_radii(const FilmGeometry& film, double bond_radius_m,
                               const Discretisation& d) {
  std::vector<double> breaks;
  const double graded_m = std::min(2.0 * bond_radius_m, film.radius_m);
  if (graded_m > bond_radius_m * (1.0 + 1e-9)) {
    append_breaks(breaks, graded_breaks(bond_radius_m, graded_m, d.layers, d.ratio, false));
  }
  if (film.radius_m > graded_m * (1.0 + 1e-9)) {
    append_breaks(breaks, graded_breaks(graded_m, film.radius_m, d.film_elements, 1.0, true));
  }
  return breaks;
}

std::vector<double> film_heights(const FilmGeometry& film, double bond_radius_m,
                                 const Discretisation& d) {
  const double graded_m = std::min(film.thickness_m, bond_radius_m);
  std::vector<double> breaks = graded_breaks(-graded_m, 0.0, d.layers, d.ratio, true);
  // Below the bond, the field changes over the distance from the pillar.
  constexpr double kGrowth = 3.0;
  double depth_m = kGrowth * graded_m;
  for (; depth_m * std::sqrt(kGrowth) < film.thickness_m; depth_m *= kGrowth) {
    breaks.insert(breaks.begin(), -depth_m);
  }
  if (film.thickness_m > graded_m * (1.0 + 1e-9)) breaks.insert(breaks.begin(), -film.thickness_m);
  return breaks;
}

int layers_not_felt(double from_load_m, double thickness_m) {
  const double skipped = kSkippedPerThickness * from_load_m / thickness_m;
  return static_cast<int>(std::lround(std::min(skipped, 100.0)));
}

int film_rim_layers(const FilmGeometry& film, double bond_radius_m, const Discretisation& d) {
  const double loaded_m = std::max(bond_radius_m, film.electrode_radius_m);
  return std::max(1, d.layers - layers_not_felt(film.radius_m - loaded_m, film.thickness_m));
}

void grade_film(const FilmGeometry& film, double bond_radius_m, const Discretisation& d,
                std::vector<double>& x, std::vector<double>& z) {
  const double edge_m = film.electrode_radius_m;
  const bool has_edge = edge_m > 0.0 && !is_same(edge_m, film.radius_m, film);
  if (edge_m > 0.0) insert_break(x, edge_m);
  if (has_edge && !is_same(edge_m, bond_radius_m, film)) {
    for (const int side : {-1, 1}) {
      const double length_m = reach_m(film, bond_radius_m, d.ratio, edge_m, side);
      grade_side(edge_m, side, length_m, d.layers, d.ratio, x);
    }
  }
  const int rim_layers = film_rim_layers(film, bond_radius_m, d);
  if (!is_same(film.radius_m, bond_radius_m, film)) {
    const double length_m = reach_m(film, bond_radius_m, d.ratio, film.radius_m, -1);
    grade_side(film.radius_m, -1, std::min(length_m, film.thickness_m / d.ratio), rim_layers,
               d.ratio, x);
  }
  grade_bottom(film.electrode_is_below && edge_m > 0.0 ? d.layers : rim_layers, d.ratio, z);
}

}  // namespace viscard
