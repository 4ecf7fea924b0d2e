#include "models/pillar/mesh/pillar_mesh.h"

#include <algorithm>
#include <cmath>

namespace viscard {

namespace {

struct DegreeAndLayers {
  int degree, layers;
};

std::vector<Discretisation> meshes_of(const PillarGeometry& geometry,
                                      const std::vector<DegreeAndLayers>& all) {
  // Elements of the shaft and of the outer film are at most a few radii long, so that the same
  // degrees resolve long pillars and wide films.
  const double R_m = 0.5 * geometry.diameter_m;
  const double shaft = (geometry.length_m - 2.0 * R_m) / (4.0 * R_m);
  const int shaft_elements = std::clamp(static_cast<int>(std::lround(shaft)), 1, 40);
  int film_elements = 1;
  if (geometry.film) {
    const double scale_m = std::min(2.0 * R_m, 2.0 * geometry.film->thickness_m);
    const double outside_m = geometry.film->radius_m - 2.0 * R_m;
    film_elements = std::clamp(static_cast<int>(std::ceil(outside_m / scale_m)), 1, 40);
  }
  std::vector<Discretisation> meshes;
  for (const auto& [degree, layers] : all) {
    meshes.push_back({.degree = degree,
                      .layers = layers,
                      .shaft_elements = shaft_elements,
                      .film_elements = film_elements});
  }
  return meshes;
}

}  // namespace

std::vector<Discretisation> mesh_sequence(const PillarGeometry& geometry) {
  return meshes_of(geometry, {{3, 1}, {4, 2}, {5, 2}, {6, 3}, {7, 3}, {8, 4}, {9, 4}, {10, 5}});
}

std::vector<Discretisation> stressed_mesh_sequence(const PillarGeometry& geometry) {
  return meshes_of(geometry, {{5, 1}, {5, 2}, {5, 3}, {6, 4}, {7, 5}, {8, 6}, {9, 7}});
}

std::vector<Discretisation> large_mesh_sequence(const PillarGeometry& geometry) {
  return meshes_of(geometry, {{3, 1}, {4, 2}, {5, 2}, {6, 3}, {7, 3}, {8, 3}});
}

std::vector<Discretisation> finer_and(const Discretisation& named, const PillarGeometry& geometry) {
  constexpr int kHighest = 12;
  Discretisation finer = named;
  if (named.uniform_m > 0.0) {
    finer = mesh_sequence(geometry)[5];
  } else {
    finer.degree = std::max(named.degree, std::min(named.degree + 2, kHighest));
    ++finer.layers;
  }
  return {finer, named};
}

}  // namespace viscard
