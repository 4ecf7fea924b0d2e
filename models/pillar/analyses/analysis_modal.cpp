#include "models/material/hereditary.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/film_shares.h"
#include "models/pillar/analyses/pillar_scales.h"
#include "models/pillar/analyses/relaxed_modes.h"
#include "models/pillar/body/pillar_modes.h"
#include "models/pillar/body/rigid_motion.h"
#include "models/pillar/body/section_sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

const ModalDrive& modal_drive(const PillarScene& scene) {
  return std::get<ModalDrive>(scene.drive);
}

// A family of motion and its place in the answer.
struct ModeFamily {
  const char* name;
  Motion motion;
  int harmonic;
};

std::vector<ModeFamily> mode_families(const PillarScene& scene) {
  if (scene.plane) {
    return {{"lateral", Motion::kPlaneAntisymmetric, 0},
            {"longitudinal", Motion::kPlaneSymmetric, 0}};
  }
  return {{"lateral", Motion::kLateral, 1},
          {"longitudinal", Motion::kLongitudinal, 0},
          {"torsion", Motion::kTorsion, 0},
          {"ovalling", Motion::kOvalling, 2}};
}

std::vector<PillarMode> family_modes(const PillarScene& scene, const ModeFamily& family,
                                     const PillarModel& model, const SceneAnswer& on_mesh) {
  const bool pressed = modal_drive(scene).pressure_Pa != 0.0 && family.motion == Motion::kLateral;
  const int rigid = scene.fixed_bottom ? 0 : rigid_motion_count(family.motion);
  const int wanted = std::min(modal_drive(scene).modes, model.system().size() - rigid);
  return pressed ? modes_under_pressure(model_of(scene, Motion::kLongitudinal, on_mesh), model,
                                        modal_drive(scene).pressure_Pa, wanted)
                 : lowest_modes(model, wanted);
}

void check_modal(const PillarScene& scene) {
  const int modes = modal_drive(scene).modes;
  if (modes >= 1 && modes <= 40) return;
  throw std::invalid_argument("modes: " + std::to_string(modes) +
                              " per family; it must lie between 1 and 40");
}

std::vector<std::string> modal_names(const PillarScene& scene) {
  std::vector<std::string> names = {"frequency", "lateral", "longitudinal"};
  if (scene.plane) return names;
  names.emplace_back("torsion");
  names.emplace_back("ovalling");
  return names;
}

// A free body moves as a whole at no frequency at all.
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
                         ") have no frequency and are left out");
}

void run_modal(const PillarScene& scene, SceneAnswer& answer) {
  // The n-th mode of a clamped bar has n - 1/2 half waves; an element for each lets the lowest
  // degrees see them all, so that no mesh is refined for want of one.
  if (!scene.discretisation) {
    answer.discretisation.longest_m = scene.geometry.length_m / (modal_drive(scene).modes - 0.5);
  }
  for (const ModeFamily& family : mode_families(scene)) {
    const PillarModel model = model_of(scene, family.motion, answer);
    count_unknowns(model, answer);
    for (const PillarMode& mode : family_modes(scene, family, model, answer)) {
      answer.modes.push_back({family.name, family.harmonic, mode.frequency_Hz, 0.0});
    }
  }
  note_rigid_motions(scene, answer);
}

SectionGrid modal_grid(const PillarScene& scene, const ModeFamily& family,
                       const SceneAnswer& on_mesh) {
  const PillarModel model = model_of(scene, family.motion, on_mesh);
  Sampling at = sampling_of(model);
  at.grid.name = family.name;
  at.grid.harmonic = family.motion == Motion::kPlaneAntisymmetric ? 1 : family.harmonic;
  int number = 0;
  for (const PillarMode& mode : family_modes(scene, family, model, on_mesh)) {
    SectionField shape = displacement_field(
        model, at, std::string(family.name) + "_" + std::to_string(++number), mode.shape);
    shape.unit = "1";
    normalise(at.grid.harmonic, shape);
    at.grid.fields.push_back(std::move(shape));
  }
  return at.grid;
}

std::vector<SectionGrid> modal_fields(const PillarScene& scene, const Discretisation& mesh) {
  SceneAnswer on_mesh;
  on_mesh.discretisation = mesh;
  std::vector<SectionGrid> grids;
  for (const ModeFamily& family : mode_families(scene)) {
    grids.push_back(modal_grid(scene, family, on_mesh));
  }
  return grids;
}

double modal_push_Pa(const PillarScene& scene) {
  return modal_drive(scene).pressure_Pa;
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

EffectEstimate modal_film_compliance(const PillarScene& scene, const EffectEstimate&) {
  const FilmShares shares = film_shares(scene);
  const double ratio = film_over_pillar_frequency(scene);
  if (ratio < 2.0) {
    return {EffectRole::kNeeded, 1.0, "film over pillar frequency", ratio,
            "the film vibrates among the modes asked for"};
  }
  const double largest = std::max({shares.axial, shares.lateral(), shares.torsion});
  return {EffectRole::kOptional, kUnevenTraction * largest / (1.0 - 1.0 / (ratio * ratio)),
          "base compliance over pillar's", largest, "lowers the frequencies of pillar and film"};
}

// The modulus at the lowest frequency against the instantaneous one (eq. E3).
EffectEstimate modal_relaxation(const PillarScene& scene, const EffectEstimate& usual) {
  if (!(scene.pillar.rho_kg_m3 > 0.0)) return usual;
  const PronySeries series = largest_relaxation(scene.pillar);
  const double nu_w = 2.0 * std::numbers::pi * 0.5 *
                      std::min(1.0, 0.5 * scene.geometry.diameter_m / scene.geometry.length_m) *
                      first_rod_frequency_Hz(scene);
  const double loss =
      1.0 - complex_modulus_Pa(series, nu_w).storage_Pa / instantaneous_modulus_Pa(series);
  return {EffectRole::kOptional, 0.5 * loss, "1 - E'(w)/E_0", loss,
          "the modulus at the lowest frequency"};
}

// f(p) = f(0) sqrt(1 - p/p_cr) holds for the first lateral mode, exactly for equal shapes, and
// bounds the others (eq. E6).
EffectEstimate modal_geometric_stiffness(const PillarScene& scene, const EffectEstimate& usual) {
  const double share = usual.value;
  if (usual.number.empty()) return usual;  // no pressure
  if (scene.plane) {
    return {EffectRole::kOutside, std::min(1.0, 0.5 * share), "p/p_cr", share,
            "modes of a strip are computed without load"};
  }
  const double error = modal_drive(scene).pressure_Pa < 0.0 ? std::sqrt(1.0 + share) - 1.0
                       : share < 0.9                        ? 1.0 - std::sqrt(1.0 - share / 0.95)
                                                            : 1.0;
  return {EffectRole::kOptional, error, "p/p_cr", share, "the load softens lateral modes"};
}

}  // namespace

Analysis modal_analysis() {
  return {.name = "modal",
          .drive = ModalDrive{},
          .has_inertia = true,
          .bends = true,
          .free_bottom = FreeBottom::kFloats,
          .check = check_modal,
          .result_names = modal_names,
          .run = run_modal,
          .finish = relax_modes,
          .push_Pa = modal_push_Pa,
          .fields = modal_fields,
          .relaxation = modal_relaxation,
          .film_compliance = modal_film_compliance,
          .geometric_stiffness = modal_geometric_stiffness};
}

}  // namespace viscard
