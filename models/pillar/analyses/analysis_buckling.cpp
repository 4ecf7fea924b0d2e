#include "models/answer/scene_mistake.h"
#include "models/maths/failure_text.h"
#include "models/maths/require.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/bowed_pillar.h"
#include "models/pillar/analyses/buckling_limit.h"
#include "models/pillar/analyses/slender_rounding.h"
#include "models/pillar/body/nearby_pillar.h"
#include "models/pillar/body/pillar_modes.h"
#include "models/pillar/body/section_grid.h"

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace viscard {
namespace {

const BucklingDrive& buckling_drive(const PillarScene& scene) {
  return std::get<BucklingDrive>(scene.drive);
}

void check_buckling(const PillarScene& scene) {
  require(!scene.plane, "buckling is computed for a cylinder, not for a strip");
  const BucklingDrive& drive = buckling_drive(scene);
  if (drive.bow_m == 0.0) return;
  at_key("analysis.bow", [&] { check_bow(scene, drive.bow_m, drive.collapse_strain); });
}

// Names of what a bowed pillar adds.
constexpr const char* kCollapse = "collapse_pressure";
constexpr const char* kOffset = "collapse_offset";

void add_collapse(const PillarScene& scene, double buckling_Pa, double unresolved,
                  SceneAnswer& answer) {
  const BucklingDrive& drive = buckling_drive(scene);
  if (drive.bow_m == 0.0) return;
  const Collapse found = collapse(scene, buckling_Pa, drive.bow_m, drive.collapse_strain);
  answer.results.push_back({kCollapse, found.pressure_Pa, "Pa"});
  answer.results.back().unresolved = unresolved + found.left_out;
  answer.results.push_back({kOffset, found.offset_m, "m"});
  answer.results.back().unresolved = unresolved + found.left_out;
}

// Under a tip whose rim is thin, local modes of its inner corner mix with the pillar's own modes:
// the load falls with each finer mesh, and the change between two meshes underestimates the error.
// A tip of 10 um x 5 um (rim of 14 degrees) on 40 um x 120 um: 12 958, 12 931, 12 901, 12 870, 12
// 824, 12 589 Pa at degrees 4 to 8 and 10. Rims of 19 degrees and more converge (10 um x 7 um: 12
// 979 and 12 975 Pa at 1e-3 and 2e-4).
double fall_under_thin_rim(const Flare& tip) {
  constexpr double kThinnest =
      0.35;  // tangent of the rim's angle, height/(2 width) of the parabola
  constexpr double kFall = 0.05;
  return tip.width_m > 0.0 && tip.height_m < 2.0 * kThinnest * tip.width_m ? kFall : 0.0;
}

void run_buckling(const PillarScene& scene, SceneAnswer& answer) {
  const int layers = answer.discretisation.layers;
  avoid_rounding(scene, answer.discretisation);
  // The load goes as the square of the first lateral frequency.
  const double rim =
      answer.discretisation.layers < layers
          ? 2.0 * rim_share(scene, answer.discretisation, answer.discretisation.layers)
          : 0.0;
  const PillarModel axial = model_of(scene, Motion::kLongitudinal, answer.discretisation);
  const PillarModel lateral = model_of(scene, Motion::kLateral, answer.discretisation);
  count_unknowns(lateral, answer);
  const NearbyPillar* nearby = nearby_of(scene, Motion::kLateral, false);
  Buckling found;
  if (nearby == nullptr) {
    found = buckling(axial, lateral);
  } else {
    found.pressure_Pa = buckling_pressure_nearby_Pa(axial, lateral, nearby->buckled());
  }
  // Of what the rim's stress changes to first order; if less of it is left out of the search (0.004 of
  // the radius instead of 0.012), loads change by 0.1 to 0.3 of that.
  constexpr double kSecondOrder = 0.3;
  answer.results.push_back({"buckling_pressure", found.pressure_Pa, "Pa"});
  answer.results.back().unresolved =
      kSecondOrder * std::abs(found.rim_share) + fall_under_thin_rim(scene.geometry.tip) + rim;
  add_collapse(scene, found.pressure_Pa, answer.results.back().unresolved, answer);
}

// The axial model, whose stress is that of a neighbour to first order, and the shape of the lateral one.
NearbyPillars buckling_nearby(const PillarScene& scene, const Discretisation& mesh) {
  NearbyPillars nearby;
  nearby.push_back(nearby_model_of(scene, Motion::kLongitudinal, mesh));
  nearby.push_back(nearby_model_of(scene, Motion::kLateral, mesh));
  nearby[0]->solve();
  nearby[1]->find_buckling(nearby[0]->model());
  return nearby;
}

// The shape in which the pillar buckles. Its slowest vibration tends to it as the pressure tends to
// the buckling pressure, where (K - p K_sigma) x = omega^2 M x with omega = 0 is the buckling problem.
// Empty if modes at the rim of the bond hide it on this mesh.
std::vector<SectionGrid> buckling_fields(const PillarScene& scene, const Discretisation& mesh) {
  const PillarModel axial = model_of(scene, Motion::kLongitudinal, mesh);
  const PillarModel lateral = model_of(scene, Motion::kLateral, mesh);
  constexpr double kShare = 0.999;
  std::vector<PillarMode> modes;
  try {
    const double pressure_Pa = kShare * buckling(axial, lateral).pressure_Pa;
    modes = modes_under_pressure(axial, lateral, pressure_Pa, 1);
  } catch (const std::runtime_error& error) {
    if (!is_refusal(error)) throw;
    return {};
  }
  Sampling at = sampling_of(lateral);
  at.grid.name = "buckling";
  at.grid.harmonic = 1;
  SectionField shape = displacement_field(lateral, at, "buckling_shape", modes.at(0).shape);
  shape.unit = "1";
  normalise(at.grid.harmonic, shape);
  at.grid.fields.push_back(std::move(shape));
  return {at.grid};
}

// A plate halves the free length above the foot, so the rotation of the foot counts twice.
EffectEstimate buckling_film_compliance(const PillarScene& scene, const EffectEstimate&) {
  const FilmShares shares = film_shares(scene);
  return {EffectRole::kOptional,
          (plate_on_top(scene) ? 2.0 : 1.0) * kUnevenTraction * shares.lateral(), "2 E I/(k L)",
          2.0 * shares.bending, "the base turns under the bent pillar"};
}

EffectEstimate buckling_geometric_stiffness(const PillarScene&, const EffectEstimate&) {
  return {EffectRole::kNeeded, 1.0, "", 0.0, "buckling is nothing else"};
}

}  // namespace

Analysis buckling_analysis() {
  return {.name = "buckling",
          .drive = BucklingDrive{},
          .bends = true,
          .weighs_stress = true,
          .check = check_buckling,
          .result_names = [](const PillarScene& scene) -> std::vector<std::string> {
            if (buckling_drive(scene).bow_m == 0.0) return {"buckling_pressure"};
            return {"buckling_pressure", kCollapse, kOffset};
          },
          .run = run_buckling,
          .found_pressure_Pa = engesser_pressure_Pa,
          .fields = buckling_fields,
          .solve_nearby = buckling_nearby,
          .film_compliance = buckling_film_compliance,
          .geometric_stiffness = buckling_geometric_stiffness};
}

}  // namespace viscard
