#include "models/maths/require.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/buckling_limit.h"
#include "models/pillar/body/pillar_modes.h"

namespace viscard {
namespace {

void check_buckling(const PillarScene& scene) {
  require(!scene.plane, "buckling is computed for a cylinder, not for a strip");
}

void run_buckling(const PillarScene& scene, SceneAnswer& answer) {
  const PillarModel axial = model_of(scene, Motion::kLongitudinal, answer.discretisation);
  const PillarModel lateral = model_of(scene, Motion::kLateral, answer.discretisation);
  count_unknowns(lateral, answer);
  answer.results.push_back({"buckling_pressure", buckling(axial, lateral).pressure_Pa, "Pa"});
}

// A plate halves the free length above the foot, so that the turn of the foot counts twice.
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
          .result_names = [](const PillarScene&) -> std::vector<std::string> {
            return {"buckling_pressure"};
          },
          .run = run_buckling,
          .found_pressure_Pa = engesser_pressure_Pa,
          .film_compliance = buckling_film_compliance,
          .geometric_stiffness = buckling_geometric_stiffness};
}

}  // namespace viscard
