#include "models/pillar/analyses/buckling_limit.h"

#include "models/answer/scene_mistake.h"
#include "models/maths/failure_text.h"
#include "models/maths/text_of_number.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/body/pillar_modes.h"
#include "models/pillar/mesh/pillar_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace viscard {
namespace {

// Infinite for a pillar so stubby that it buckles only locally, at the rim of its bond. A longer one buckles by the
// beam's formula at the latest.
double buckling_pressure_Pa(const PillarModel& axial, const PillarModel& lateral, double beam_Pa) {
  constexpr double kLong = 10.0;  // length over diameter
  try {
    return buckling(axial, lateral).pressure_Pa;
  } catch (const std::runtime_error& error) {
    if (!is_refusal(error)) throw;
    const PillarGeometry& pillar = axial.geometry();
    return pillar.length_m > kLong * pillar.diameter_m ? beam_Pa
                                                       : std::numeric_limits<double>::infinity();
  }
}

// Meshes on which the limit is found: the coarse one is accurate within kCoarseLimit, so a load
// closer to the limit is judged on the fine one.
enum class LimitMesh { kCoarse = 1, kFine = 3 };
constexpr double kCoarseLimit = 0.02;

// Whether Engesser's formula, for a clamped foot, is closer than a coarse mesh. The contraction that the bond
// hinders takes 0.1 diameters off the length, twice as much of the load relative to it.
bool is_beam(const PillarScene& scene) {
  constexpr double kSlender = 100.0;  // length over diameter
  constexpr double kTurns = 0.01;     // of the bending
  return scene.geometry.length_m > kSlender * scene.geometry.diameter_m &&
         scene.geometry.tip.width_m == 0.0 && (!scene.film || film_shares(scene).bending < kTurns);
}

// Pressure at which the pillar buckles with a free top or under a plate that slides, and how far it is then shortened.
struct BucklingLimit {
  double pressure_Pa = 0.0;
  double shortening_m = 0.0;  // under a plate
};
BucklingLimit buckling_limit(const PillarScene& scene, bool has_plate,
                             LimitMesh on = LimitMesh::kCoarse) {
  const double beam_Pa = engesser_pressure_Pa(scene, has_plate ? TopEnd::kSlides : TopEnd::kFree);
  if (is_beam(scene)) return {beam_Pa, beam_Pa / scene.pillar.E0_Pa * scene.geometry.length_m};
  const Discretisation mesh = stressed_mesh_sequence(scene.geometry)[static_cast<std::size_t>(on)];
  const PillarModel axial(scene.geometry, mesh, media_of(scene),
                          {.motion = Motion::kLongitudinal, .rigid_top = has_plate});
  const PillarModel lateral(scene.geometry, mesh, media_of(scene),
                            {.motion = Motion::kLateral, .rigid_top = has_plate});
  const double pressure_Pa = buckling_pressure_Pa(axial, lateral, beam_Pa);
  if (!has_plate) return {pressure_Pa};
  return {pressure_Pa,
          axial.mean_top_displacement_m(axial.solve(axial.top_traction())) * pressure_Pa};
}

// A plate holds the top upright, so that the pillar buckles between the two.
BucklingShare share_under_plate(const PillarScene& scene) {
  // A pillar that would be longer is pressed by a top that is held.
  const double moved_m = *displacement_m(scene) - scene.surroundings.pillar_expansion_1_K *
                                                      scene.surroundings.heated_K() *
                                                      scene.geometry.length_m;
  const double rough_m = engesser_pressure_Pa(scene) / scene.pillar.E0_Pa * scene.geometry.length_m;
  if (-moved_m < 0.5 * rough_m) return {};
  const double most_m = scene.plane ? rough_m : buckling_limit(scene, true).shortening_m;
  const double share = -moved_m / most_m;
  if (share < 1.0) return {share};
  return {share, "a displacement of " + micrometres(moved_m, 5) + " is beyond about " +
                     micrometres(-most_m, 3) +
                     ", where the pillar buckles between its foot and the plate on its top"};
}

}  // namespace

double weight_on_top_Pa(const PillarScene& scene) {
  constexpr double kShare = 2.467 / 7.837;
  return kShare * scene.surroundings.gravity_m_s2 * scene.pillar.rho_kg_m3 *
         scene.geometry.length_m;
}

TopEnd top_end(const PillarScene& scene) {
  return moves_top(scene) || plate_on_top(scene) ? TopEnd::kSlides : TopEnd::kFree;
}

double euler_pressure_Pa(const PillarScene& scene, TopEnd end) {
  const double radius_of_gyration_m =
      scene.plane ? scene.geometry.diameter_m / std::sqrt(12.0) : 0.25 * scene.geometry.diameter_m;
  const double lengths = end == TopEnd::kFree ? 2.0 : end == TopEnd::kSlides ? 1.0 : 0.5;
  const double slenderness = lengths * scene.geometry.length_m / radius_of_gyration_m;
  return std::numbers::pi * std::numbers::pi * scene.pillar.E0_Pa / (slenderness * slenderness);
}

double engesser_pressure_Pa(const PillarScene& scene, TopEnd end) {
  const double nu = scene.pillar.nu;
  const double shear_Pa = scene.pillar.E0_Pa / (2.0 * (1.0 + nu));
  const double kappa = scene.plane ? 5.0 / 6.0 : 6.0 * (1.0 + nu) / (7.0 + 6.0 * nu);
  const double euler_Pa = euler_pressure_Pa(scene, end);
  return euler_Pa / (1.0 + euler_Pa / (kappa * shear_Pa));
}

double engesser_pressure_Pa(const PillarScene& scene) {
  return engesser_pressure_Pa(scene, top_end(scene));
}

PillarScene long_term_scene(const PillarScene& scene) {
  const DerivedModuli moduli = derived_moduli(scene.pillar);
  PillarScene relaxed = scene;
  relaxed.pillar.terms.clear();
  relaxed.pillar.E0_Pa = moduli.E_inf_Pa;
  relaxed.pillar.nu = moduli.nu_inf;
  return relaxed;
}

double largest_pressure_Pa(const PillarScene& scene) {
  const Analysis& analysis = analysis_of(scene);
  if (analysis.found_pressure_Pa != nullptr) return analysis.found_pressure_Pa(scene);
  double largest = std::abs(pressure_Pa(scene));
  if (moves_top(scene) && !is_lateral(scene)) {
    largest = std::abs(*displacement_m(scene)) / scene.geometry.length_m * scene.pillar.E0_Pa;
  }
  if (analysis.history == HistoryOf::kPressure && load_place(scene) == LoadPlace::kTop) {
    largest = std::max(largest, largest_size(history(scene)));
  }
  return largest;
}

double rough_buckling_pressure_Pa(const PillarScene& scene) {
  const double slenderness = scene.geometry.diameter_m / scene.geometry.length_m;
  const double pi = std::numbers::pi;
  const double euler_Pa = pi * pi / 64.0 * scene.pillar.E0_Pa * slenderness * slenderness;
  const double turn = scene.film ? 2.0 * film_shares(scene).bending : 0.0;  // of the foot
  return 0.5 * euler_Pa / (1.0 + kUnevenTraction * turn);
}

double pillar_buckling_pressure_Pa(const PillarScene& scene, TopEnd end) {
  if (scene.plane || end == TopEnd::kSticks) return engesser_pressure_Pa(scene, end);
  return buckling_limit(scene, end == TopEnd::kSlides).pressure_Pa;
}

BucklingShare buckling_share(const PillarScene& scene) {
  const Analysis& analysis = analysis_of(scene);
  if (analysis.push_Pa == nullptr || is_lateral(scene) || !scene.fixed_bottom) return {};
  if (moves_top(scene)) return share_under_plate(scene);
  const double largest_Pa = analysis.push_Pa(scene) + std::max(0.0, weight_on_top_Pa(scene));
  if (largest_Pa < rough_buckling_pressure_Pa(scene)) return {};
  double critical_Pa = pillar_buckling_pressure_Pa(scene);
  if (!scene.plane && std::abs(largest_Pa - critical_Pa) < kCoarseLimit * critical_Pa) {
    critical_Pa = buckling_limit(scene, false, LimitMesh::kFine).pressure_Pa;
  }
  const double share = largest_Pa / critical_Pa;
  if (share < 1.0) return {share};
  return {share, "a pressure of " + text_of(largest_Pa, 5) +
                     " Pa is beyond the buckling pressure of about " + text_of(critical_Pa, 5) +
                     " Pa: the straight pillar buckles sideways"};
}

bool holds_straight(const PillarScene& scene) {
  const auto forced = scene.effects.find("geometric_stiffness");
  return forced != scene.effects.end() && forced->second == EffectChoice::kOff;
}

double refuse_beyond_buckling(const PillarScene& scene) {
  if (holds_straight(scene)) return 0.0;
  const BucklingShare share = buckling_share(scene);
  const std::string& why = share.beyond;
  if (why.empty()) return share.of_limit;
  throw SceneMistake(has_history(scene) ? "analysis.history"
                     : moves_top(scene) ? "analysis.load.displacement"
                                        : "analysis.load",
                     why +
                         ". Reduce the load, make the pillar shorter or thicker, or declare that "
                         "it is held straight (geometric_stiffness = \"off\" under [effects])");
}

}  // namespace viscard
