#include "io/cost/study_trials.h"
#include "models/array/layer/simulate_layer.h"
#include "models/array/plane/array_geometry.h"
#include "models/array/plane/simulate_array.h"
#include "models/array/space/simulate_space.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/large_strain.h"
#include "models/pillar/body/pillar_model.h"
#include "models/pillar/mesh/pillar_mesh.h"

#include <algorithm>

namespace viscard {
namespace {

// Far below the tolerance, but not finer than the steps can show.
double step_tolerance_of(const PillarScene& scene) {
  const Analysis& analysis = analysis_of(scene);
  const bool moves = analysis.has_inertia && analysis.relaxes;
  return moves ? 0.05 * scene.tolerance : std::min(1e-6, scene.tolerance);
}

CostMeshes meshes_of(const PillarScene& scene) {
  return {.diameter_m = scene.geometry.diameter_m,
          .graded = {{2, 1}, {3, 1}, {4, 2}, {5, 2}, {6, 3}, {7, 3}},
          .highest_uniform = 8,
          .uniform_layers = 1,
          .reference_layers = is_large(scene) ? 3 : 4,  // as large_mesh_sequence()
          .step_tolerance = step_tolerance_of(scene),
          .row_tolerance = std::max(1e-5, step_tolerance_of(scene)),
          .takes_time_steps = !history(scene).empty()};
}

// The tolerance of a row in time also decides how many modes are kept, which no mesh shows.
double step_tolerance_of(const ArrayScene& scene) {
  return std::holds_alternative<RowTransient>(scene.drive) ? 0.05 * scene.tolerance
                                                           : scene.tolerance;
}

CostMeshes meshes_of(const ArrayScene& scene) {
  return {.diameter_m = scene.geometry.diameter_m,
          .graded = {{2, 1}, {3, 2}, {4, 2}, {5, 2}, {6, 3}, {7, 3}},
          .highest_uniform = 7,
          .uniform_layers = scene.electrodes.is_equipotential ? 2 : 1,
          .reference_layers = 5,
          .step_tolerance = step_tolerance_of(scene),
          .row_tolerance = scene.tolerance};
}

// The tolerance also decides on the grids of a contact, and whether pillars move each other through the film.
// A touch in time to a tenth takes ten times as long as to a fifth.
double step_tolerance_of(const SpaceScene& scene) {
  if (scene.touch) return std::max(0.2 * scene.tolerance, SpaceScene::kTolerances.least);
  return scene.press ? std::max(0.1 * scene.tolerance, SpaceScene::kTolerances.least)
                     : SpaceScene::kTolerances.least;
}

double step_tolerance_of(const LayerScene& scene) {
  return std::max(0.1 * scene.tolerance, LayerScene::kTolerances.least);
}

// Each degree of the feet is an accuracy of the film and its waves as well; there are no others.
CostMeshes meshes_of(const SpaceScene& scene) {
  return {.diameter_m = scene.diameter_m,
          .graded = {{3, 1}, {4, 2}, {5, 2}, {6, 3}, {7, 3}},
          .highest_uniform = 0,
          .reference_layers = 4,
          .step_tolerance = step_tolerance_of(scene),
          .row_tolerance = scene.tolerance};
}

// Grids of a layer are known by their degree alone (layer_meshes()).
CostMeshes meshes_of(const LayerScene& scene) {
  return {.diameter_m = 2.0 * scene.electrode_radius_m,
          .graded = {{3, 1}, {4, 2}, {5, 3}, {6, 4}},
          .highest_uniform = 0,
          .reference_layers = 5,
          .step_tolerance = step_tolerance_of(scene),
          .row_tolerance = scene.tolerance};
}

Discretisation graded(const PillarScene& scene, int degree, int layers) {
  Discretisation mesh = mesh_sequence(scene.geometry).front();
  mesh.degree = degree;
  mesh.layers = layers;
  return mesh;
}

Discretisation graded(const ArrayScene& scene, int degree, int layers) {
  Discretisation mesh = array_meshes(scene).front();
  mesh.degree = degree;
  // An electrode's edge takes as many layers as the degree (array_meshes()).
  mesh.layers = scene.electrodes.is_equipotential ? std::max(degree, layers) : layers;
  return mesh;
}

Discretisation graded(const SpaceScene& scene, int degree, int) {
  for (const Discretisation& mesh : space_meshes(scene)) {
    if (mesh.degree >= degree) return mesh;
  }
  return space_meshes(scene).back();
}

Discretisation graded(const LayerScene& scene, int degree, int) {
  const std::vector<Discretisation> meshes = layer_meshes(scene);
  for (const Discretisation& mesh : meshes) {
    if (mesh.degree >= degree) return mesh;
  }
  return meshes.back();
}

// A film that is left out needs no elements beside the pillar.
Discretisation without_effect(const PillarScene& without, Discretisation mesh) {
  if (!without.film) mesh.film_elements = 1;
  return mesh;
}

Discretisation without_effect(const ArrayScene&, Discretisation mesh) {
  return mesh;
}

Discretisation without_effect(const SpaceScene&, Discretisation mesh) {
  return mesh;
}

Discretisation without_effect(const LayerScene&, Discretisation mesh) {
  return mesh;
}

// Unknowns of axial motion with its potential, with the bottom and one face of the film held.
// Other motions have more fields, in about the same proportion on every mesh.
double size_of(const PillarScene& scene, const Discretisation& mesh) {
  const PillarMesh made = pillar_mesh(with_electrode_edge(scene.geometry, scene.electrodes), mesh);
  const Section& section = made.section;
  const double bottom_m = scene.film ? -scene.geometry.film->thickness_m : 0.0;
  double count = 0.0;
  for (int node = 0; node < section.node_count(); ++node) {
    const double z_m = section.node_z(node);
    if (z_m > bottom_m) count += section.node_x(node) > 0.0 ? 2.0 : 1.0;
    if (scene.electrodes && z_m < 0.0) count += 1.0;
  }
  return count;
}

// Unknowns of the pieces of a row and of the chain that joins them (models/array/plane).
double size_of(const ArrayScene& scene, const Discretisation& mesh) {
  const ArrayMesh lines = array_mesh(scene.geometry, scene.electrodes, mesh);
  const auto nodes = [&](std::size_t breaks) {
    return static_cast<double>(mesh.degree) * (static_cast<double>(breaks) - 1.0);
  };
  const double fields = scene.film.has_permittivity() ? 3.0 : 2.0;
  const double end = fields * nodes(lines.film_z.size());
  const int under = lines.cell.last_pillar_column - lines.cell.first_pillar_column;
  double count = 2.0 * (mesh.degree * under + 1.0) * nodes(lines.pillar_z.size());
  int pieces = scene.geometry.count;
  for (const auto* piece : {&lines.cell.x, &lines.gap_x, &lines.edge_x}) {
    if (!piece->empty()) count += end * (nodes(piece->size()) + 1.0);
  }
  if (lines.ends_differ) {
    count += end * (nodes(lines.first_cell.x.size()) + nodes(lines.last_cell.x.size()) + 2.0);
  }
  if (!lines.gap_x.empty()) pieces += scene.geometry.count - 1;
  if (!lines.edge_x.empty()) pieces += 2;
  return count + end * (pieces + 1);
}

// The larger systems of an array in the plane are those of one pillar (models/array/space).
double size_of(const SpaceScene& scene, const Discretisation& mesh) {
  PillarGeometry pillar;
  pillar.diameter_m = scene.diameter_m;
  pillar.length_m = scene.length_m;
  return 3.0 * pillar_mesh(pillar, mesh).section.node_count();
}

// Cells of the grid.
double size_of(const LayerScene& scene, const Discretisation& mesh) {
  const double across = cells_across(scene, mesh);
  return scene.is_plane() ? across : across * across;
}

}  // namespace

CostMeshes cost_meshes(const Scene& scene) {
  return std::visit([](const auto& body) { return meshes_of(body); }, scene);
}

Discretisation graded_mesh(const Scene& scene, int degree, int layers) {
  return std::visit([&](const auto& body) { return graded(body, degree, layers); }, scene);
}

Discretisation uniform_mesh(const Scene& scene, int degree) {
  Discretisation mesh = graded_mesh(scene, degree, 1);
  mesh.layers = cost_meshes(scene).uniform_layers;
  return mesh;
}

double mesh_size(const Scene& scene, const Discretisation& mesh) {
  return std::visit([&](const auto& body) { return size_of(body, mesh); }, scene);
}

Discretisation mesh_without_effect(const Scene& without, Discretisation mesh) {
  return std::visit([&](const auto& body) { return without_effect(body, mesh); }, without);
}

}  // namespace viscard
