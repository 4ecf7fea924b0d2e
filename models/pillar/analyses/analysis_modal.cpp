#include "models/answer/scene_mistake.h"
#include "models/maths/require.h"
#include "models/maths/text_of_number.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/buckling_limit.h"
#include "models/pillar/analyses/family_modes.h"
#include "models/pillar/analyses/modal_mesh.h"
#include "models/pillar/analyses/pressed_modes.h"
#include "models/pillar/analyses/slender_rounding.h"
#include "models/pillar/body/pillar_model.h"
#include "models/pillar/body/pillar_modes.h"
#include "models/pillar/body/section_grid.h"
#include "models/pillar/body/solution_rest.h"
#include "models/pillar/time/relaxed_modes.h"
#include "models/pillar/time/viscoelastic_pillar.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

namespace viscard {
namespace {

const ModalDrive& modal_drive(const PillarScene& scene) {
  return std::get<ModalDrive>(scene.drive);
}

void check_modal(const PillarScene& scene) {
  const int modes = modal_drive(scene).modes;
  require_value(modes >= 1 && modes <= 40, "modes per family", modes, "", "from 1 to 40");
  if (!scene.surroundings.air) return;
  if (scene.plane)
    throw SceneMistake("surroundings.air", "is answered around cylinders, not strips");
  // Heavier fluids change the modes, whose own frequencies would have to enter the formula.
  constexpr double kMostOfPillar = 0.05;
  if (scene.surroundings.air_density_kg_m3 <= kMostOfPillar * scene.pillar.rho_kg_m3) return;
  throw SceneMistake("surroundings.air_density",
                     "a gas of at most a twentieth of the pillar's density is answered, no liquid");
}

std::vector<std::string> modal_names(const PillarScene& scene) {
  std::vector<std::string> names = {"frequency", "lateral", "longitudinal"};
  if (!scene.plane) names.insert(names.end(), {"torsion", "ovalling"});
  return names;
}

// Rigid motions of a free body have no frequency.
void note_rigid_motions(const PillarScene& scene, SceneAnswer& answer) {
  if (scene.fixed_bottom) return;
  std::string list;
  int all = 0;
  for (const ModeFamily& family : mode_families(scene)) {
    const int directions = family.harmonic > 0 ? 2 : 1;  // sideways along x and along y
    const int count = directions * rigid_motion_count(family.motion);
    if (count > 0) list += (all > 0 ? ", " : "") + std::to_string(count) + " " + family.name;
    all += count;
  }
  answer.notes.push_back("the bottom is free: " + std::to_string(all) +
                         " motions of the body as a whole (" + list +
                         ") have no frequency and are not listed");
}

// A mode that a push does not excite has no frequency.
void note_overdamped(const PillarScene& scene, const std::string& mode, SceneAnswer& answer) {
  if (modal_drive(scene).pressure_Pa > 0.0) {
    throw std::runtime_error(mode + " does not vibrate under the pressure of " +
                             text_of(modal_drive(scene).pressure_Pa, 5) +
                             " Pa: the material relaxes so quickly that the pillar creeps instead, "
                             "and may buckle; reduce the pressure");
  }
  answer.notes.push_back(mode +
                         " does not vibrate: the material relaxes so quickly that it creeps back "
                         "after a push; it is not listed");
}

// Modes with the moduli at their own complex frequencies (eq. 22b).
void add_relaxed_modes(const PillarScene& scene, const ModeFamily& family, const PillarModel& model,
                       const PillarModel* axial, SceneAnswer& answer) {
  int number = 0;
  for (const RelaxedMode& mode : family_relaxed_modes(scene, model, axial)) {
    ++number;
    if (mode.frequency_Hz == 0.0) {
      note_overdamped(scene, std::string(family.name) + " mode " + std::to_string(number), answer);
      continue;
    }
    answer.modes.push_back({.family = family.name,
                            .harmonic = family.harmonic,
                            .frequency_Hz = mode.frequency_Hz,
                            .damping_ratio = mode.damping_ratio});
    answer.step_error = std::max(answer.step_error, mode.error);
  }
}

void add_family(const PillarScene& scene, const ModeFamily& family, const PillarModel* axial,
                SceneAnswer& answer) {
  const PillarModel model = model_of(scene, family.motion, answer.discretisation);
  count_unknowns(model, answer);
  if (!scene.pillar.terms.empty()) {
    add_relaxed_modes(scene, family, model, axial, answer);
    return;
  }
  for (const PillarMode& mode : family_modes(scene, model, axial)) {
    double unresolved = 0.0;
    if (model.nearby() == nullptr) {
      const double omega_1_s = 2.0 * std::numbers::pi * mode.frequency_Hz;
      const SolutionRest rest(model, mode.shape);  // omega^2 is the work of a unit mass norm
      unresolved = 0.5 * missing_share(rest, rest, omega_1_s * omega_1_s);
    }
    answer.modes.push_back({.family = family.name,
                            .harmonic = family.harmonic,
                            .frequency_Hz = mode.frequency_Hz,
                            .unresolved = unresolved,
                            .damping_ratio = {}});
  }
}

void run_modal(const PillarScene& scene, SceneAnswer& answer) {
  const ModalMesh modal = modal_mesh(scene, answer.discretisation);
  answer.discretisation = modal.mesh;
  const std::unique_ptr<PillarModel> axial = pressed_model(scene, answer.discretisation);
  try {
    for (const ModeFamily& family : mode_families(scene))
      add_family(scene, family, axial.get(), answer);
  } catch (const BeyondBuckling& beyond) {
    judge_buckling(scene, beyond);
  }
  add_rounding(scene, modal.rounding, answer);
  add_missing_layers(modal.rim, answer);
  note_rigid_motions(scene, answer);
}

// Shapes right after loading, with the instantaneous moduli.
SectionGrid modal_grid(const PillarScene& scene, const ModeFamily& family,
                       const Discretisation& mesh) {
  const PillarModel model = model_of(scene, family.motion, mesh);
  Sampling at = sampling_of(model);
  at.grid.name = family.name;
  at.grid.harmonic = family.motion == Motion::kPlaneAntisymmetric ? 1 : family.harmonic;
  int number = 0;
  const std::unique_ptr<PillarModel> axial = pressed_model(scene, mesh);
  for (const PillarMode& mode : family_modes(scene, model, axial.get())) {
    SectionField shape = displacement_field(
        model, at, std::string(family.name) + "_" + std::to_string(++number), mode.shape);
    shape.unit = "1";
    normalise(at.grid.harmonic, shape);
    at.grid.fields.push_back(std::move(shape));
  }
  return at.grid;
}

std::vector<SectionGrid> modal_fields(const PillarScene& scene, const Discretisation& mesh) {
  std::vector<SectionGrid> grids;
  for (const ModeFamily& family : mode_families(scene)) {
    grids.push_back(modal_grid(scene, family, mesh));
  }
  return grids;
}

// Frequency below which the film itself does not vibrate (a bonded layer in shear), over the
// highest frequency the modes asked for can have.
double film_over_pillar_frequency(const PillarScene& scene) {
  const double R = 0.5 * scene.geometry.diameter_m;
  const double L = scene.geometry.length_m;
  const double E = scene.pillar.E0_Pa;
  const double rho = scene.pillar.rho_kg_m3;
  const double film_Hz = std::sqrt(elasticity_of(*scene.film).shear_Pa / scene.film->rho_kg_m3) /
                         (4.0 * scene.geometry.film->thickness_m);
  const double rod_Hz = (2.0 * modal_drive(scene).modes - 1.0) / (4.0 * L) * std::sqrt(E / rho);
  const double shear_m_s = std::sqrt(E / (2.0 * (1.0 + scene.pillar.nu) * rho));
  const double ovalling_Hz = scene.plane ? 0.0 : 2.3 * shear_m_s / (2.0 * std::numbers::pi * R);
  return film_Hz / std::hypot(rod_Hz, ovalling_Hz);
}

// p/p_cr of a push with the long-term moduli, which bounds the share of every mode (eq. E6).
double long_term_share(const PillarScene& scene) {
  return std::max(0.0, pressure_Pa(scene)) / engesser_pressure_Pa(long_term_scene(scene));
}

// Factor by which a push increases the change of a lateral frequency if the foot turns: f^2 goes as 1 - s,
// s = p/p_cr, and falls by (4 - 2 s) E I/(k L): 4 of a vibrating clamped beam, 2 of its buckling load.
double increase_by_push(double share) {
  return (1.0 - 0.5 * share) / std::max(1.0 - share, 1e-6);
}

EffectEstimate modal_film_compliance(const PillarScene& scene, const EffectEstimate&) {
  const FilmShares shares = film_shares(scene);
  const double ratio = film_over_pillar_frequency(scene);
  if (ratio < 2.0) {
    return {EffectRole::kNeeded, 1.0, "film over pillar frequency", ratio,
            "the film vibrates among the modes asked for"};
  }
  const double sideways =
      std::min(1.0, shares.lateral() * increase_by_push(long_term_share(scene)));
  const double largest = std::max({shares.axial, sideways, shares.torsion});
  return {EffectRole::kOptional, kUnevenTraction * largest / (1.0 - 1.0 / (ratio * ratio)),
          "base compliance over pillar's", largest, "lowers the frequencies of pillar and film"};
}

// The modulus at the lowest frequency against the instantaneous one (eq. E3). A pressure takes the
// share p/p_cr of the stiffness, so that f^2 goes as E'(w)/E_0 - p/p_cr.
EffectEstimate modal_relaxation(const PillarScene& scene, const EffectEstimate& usual) {
  if (!(scene.pillar.rho_kg_m3 > 0.0)) return usual;
  const PronySeries series = largest_relaxation(scene.pillar);
  const double share =
      std::clamp(modal_drive(scene).pressure_Pa / engesser_pressure_Pa(scene), 0.0, 0.99);
  const double nu_w = 2.0 * std::numbers::pi * 0.5 * std::sqrt(1.0 - share) *
                      std::min(1.0, 0.5 * scene.geometry.diameter_m / scene.geometry.length_m) *
                      first_rod_frequency_Hz(scene);
  const double loss =
      1.0 - complex_modulus_Pa(series, nu_w).storage_Pa / instantaneous_modulus_Pa(series);
  return {EffectRole::kOptional, 0.5 * loss / (1.0 - share), "1 - E'(w)/E_0", loss,
          "the modulus at the lowest frequency"};
}

// f(p) = f(0) sqrt(1 - p/p_cr) holds for the first lateral mode, exactly for equal shapes, and
// bounds the others (eq. E6): torsion falls by p/(2 G), axial modes by p/(2 E).
EffectEstimate modal_geometric_stiffness(const PillarScene& scene, const EffectEstimate& usual) {
  const double share = usual.value;
  if (usual.number.empty()) return usual;  // no pressure
  if (scene.plane) {
    return {EffectRole::kOutside, std::min(1.0, 0.5 * share), "p/p_cr", share,
            "modes of a strip are computed without load"};
  }
  const double lasting = long_term_share(scene);
  const double error = modal_drive(scene).pressure_Pa < 0.0 ? std::sqrt(1.0 + share) - 1.0
                       : lasting < 0.9                      ? 1.0 - std::sqrt(1.0 - lasting / 0.95)
                                                            : 1.0;
  return {EffectRole::kOptional, error, "p/p_cr", share, "the load softens the modes"};
}

}  // namespace

Analysis modal_analysis() {
  return {.name = "modal",
          .drive = ModalDrive{},
          .has_inertia = true,
          .bends = true,
          .load_stays = true,
          .free_bottom = FreeBottom::kFloats,
          .weighs_pressure = true,
          .check = check_modal,
          .result_names = modal_names,
          .run = run_modal,
          .push_Pa = pressure_Pa,
          .fields = modal_fields,
          .solve_nearby = modal_nearby,
          .relaxation = modal_relaxation,
          .film_compliance = modal_film_compliance,
          .geometric_stiffness = modal_geometric_stiffness};
}

}  // namespace viscard
