#include "models/answer/scene_mistake.h"
#include "models/maths/require.h"
#include "models/maths/text_of_number.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/simulate_pillar.h"

#include <cmath>
#include <string>

namespace viscard {
namespace {

void check_electrodes(const PillarScene& scene) {
  if (!scene.electrodes) return;
  if (!scene.film || !scene.film->is_piezoelectric()) {
    throw SceneMistake("geometry.electrode", "an electrode needs a film of piezoelectric material");
  }
  const double film_m = scene.geometry.film->radius_m;
  const double electrode_m = scene.electrodes->electrode_radius_m;
  if (electrode_m > film_m * (1.0 + kSameLength)) {
    throw SceneMistake("geometry.electrode.radius",
                       "the electrode's radius of " + micrometres(electrode_m, 12) +
                           " is wider than the film's of " + micrometres(film_m, 12));
  }
}

// A mesh that the scene requests has to fit into memory.
void check_mesh(const PillarScene& scene) {
  if (!scene.discretisation || !(scene.discretisation->uniform_m > 0.0)) return;
  const PillarGeometry& g = scene.geometry;
  const double per_length_1_m = scene.discretisation->degree / scene.discretisation->uniform_m;
  double section_m2 = 0.5 * g.diameter_m * g.length_m;
  if (g.film) section_m2 += g.film->radius_m * g.film->thickness_m;
  const double unknowns = 3.0 * section_m2 * per_length_1_m * per_length_1_m;
  constexpr double kMost = 1e6;
  if (unknowns <= kMost) return;
  throw SceneMistake("discretisation.element_size", "elements this small make about " +
                                                        text_of(unknowns, 2) +
                                                        " unknowns, more than the limit of " +
                                                        text_of(kMost, 2) + "; make them larger");
}

// A free body can vibrate, be accelerated and bear loads that balance themselves, such as an electrode's
// field.
void check_bottom(const PillarScene& scene) {
  if (scene.fixed_bottom) return;
  const char* const key = scene.geometry.film ? "geometry.film.bottom" : "geometry.bottom";
  const std::string instead =
      ". A free bottom has modes (kind = \"modal\"), the motion by a voltage (kind = \"static\") "
      "and that by a load on the top in time (kind = \"harmonic\" or \"transient\"); for anything "
      "else write bottom = \"fixed\"";
  const Analysis& analysis = analysis_of(scene);
  if (analysis.free_bottom == FreeBottom::kMoves) {
    if (load_place(scene) == LoadPlace::kTop) return;
    throw SceneMistake(
        "analysis.load.on",
        "a free bottom rests on no base that could accelerate it: let the load act on "
        "the top, or write bottom = \"fixed\"");
  }
  if (analysis.free_bottom == FreeBottom::kRefused) {
    throw SceneMistake(key, std::string("nothing holds a pillar with a free bottom: a ") +
                                analysis.name + " analysis would move it away as a whole" +
                                instead);
  }
  if (pressure_Pa(scene) != 0.0 || displacement_m(scene)) {
    throw SceneMistake(
        key, "nothing holds a pillar with a free bottom against the load on its top" + instead);
  }
  if (analysis.free_bottom == FreeBottom::kPinned && drive_V(scene) == 0.0 &&
      !scene.surroundings.strains_by_heat()) {
    throw SceneMistake(
        key, "a static analysis with a free bottom needs a voltage on an electrode" + instead);
  }
}

}  // namespace

void validate(const PillarScene& scene) {
  at_key("geometry", [&] { validate(scene.geometry); });
  at_key("materials.pillar", [&] { validate(scene.pillar); });
  if (scene.rubber) {
    at_key("materials.pillar", [&] { validate(*scene.rubber); });
    at_key("materials.pillar.nu", [&] {
      require_value(scene.pillar.nu > 0.0, "the Poisson ratio of rubber", scene.pillar.nu, "",
                    "above 0 and at most 0.5");
    });
  }
  check_tolerance(scene.tolerance, PillarScene::kTolerances);
  if (scene.geometry.film.has_value() != scene.film.has_value()) {
    throw SceneMistake("geometry.film", "a film needs its material, and a material its film");
  }
  check_electrodes(scene);
  check_bottom(scene);
  check_mesh(scene);
  if (!std::isfinite(pressure_Pa(scene))) {
    throw SceneMistake("analysis.load.pressure", "the pressure is not finite");
  }
  const Analysis& analysis = analysis_of(scene);
  if (analysis.has_inertia) {
    const std::string needs = std::string(analysis.name) + " analysis needs the density of the ";
    if (!(scene.pillar.rho_kg_m3 > 0.0)) throw SceneMistake("materials.pillar", needs + "pillar");
    if (scene.film && !(scene.film->rho_kg_m3 > 0.0)) {
      throw SceneMistake("geometry.film.material", needs + "film");
    }
  }
  at_key("analysis", [&] { analysis.check(scene); });
}

std::vector<std::string> result_names(const PillarScene& scene) {
  return analysis_of(scene).result_names(scene);
}

}  // namespace viscard
