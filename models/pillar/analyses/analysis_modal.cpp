#include "models/maths/require.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/buckling_limit.h"
#include "models/pillar/body/pillar_model.h"
#include "models/pillar/body/pillar_modes.h"
#include "models/pillar/body/section_grid.h"
#include "models/pillar/body/solution_rest.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

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
                                     const PillarModel& model, const Discretisation& mesh) {
  const bool pressed = modal_drive(scene).pressure_Pa != 0.0 && family.motion == Motion::kLateral;
  const int rigid = scene.fixed_bottom ? 0 : rigid_motion_count(family.motion);
  const int wanted = std::min(modal_drive(scene).modes, model.system().size() - rigid);
  return pressed ? modes_under_pressure(model_of(scene, Motion::kLongitudinal, mesh), model,
                                        modal_drive(scene).pressure_Pa, wanted)
                 : lowest_modes(model, wanted);
}

void check_modal(const PillarScene& scene) {
  const int modes = modal_drive(scene).modes;
  require_value(modes >= 1 && modes <= 40, "modes per family", modes, "", "from 1 to 40");
}

std::vector<std::string> modal_names(const PillarScene& scene) {
  std::vector<std::string> names = {"frequency", "lateral", "longitudinal"};
  if (scene.plane) return names;
  names.emplace_back("torsion");
  names.emplace_back("ovalling");
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

void run_modal(const PillarScene& scene, SceneAnswer& answer) {
  // The n-th mode of a clamped bar has n - 1/2 half waves; with an element for each, even the
  // lowest degrees resolve all of them.
  if (!scene.discretisation) {
    answer.discretisation.longest_m = scene.geometry.length_m / (modal_drive(scene).modes - 0.5);
  }
  for (const ModeFamily& family : mode_families(scene)) {
    const PillarModel model = model_of(scene, family.motion, answer.discretisation);
    count_unknowns(model, answer);
    for (const PillarMode& mode : family_modes(scene, family, model, answer.discretisation)) {
      const double omega_1_s = 2.0 * std::numbers::pi * mode.frequency_Hz;
      const SolutionRest rest(model, mode.shape);  // omega^2 is the work of a unit mass norm
      const double unresolved = 0.5 * missing_share(rest, rest, omega_1_s * omega_1_s);
      answer.modes.push_back({family.name, family.harmonic, mode.frequency_Hz, 0.0, unresolved});
    }
  }
  note_rigid_motions(scene, answer);
}

SectionGrid modal_grid(const PillarScene& scene, const ModeFamily& family,
                       const Discretisation& mesh) {
  const PillarModel model = model_of(scene, family.motion, mesh);
  Sampling at = sampling_of(model);
  at.grid.name = family.name;
  at.grid.harmonic = family.motion == Motion::kPlaneAntisymmetric ? 1 : family.harmonic;
  int number = 0;
  for (const PillarMode& mode : family_modes(scene, family, model, mesh)) {
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

// At the relaxed frequency the storage modulus at the frequency itself carries the vibration:
//   f^2 = f_0^2 [E'(2 pi f)/E_0 - s]/(1 - s)   (eq. E8), s = p/p_cr.
double relaxed_frequency_Hz(double f0_Hz, const PronySeries& series, double stress_share) {
  const double E0 = instantaneous_modulus_Pa(series);
  double f_Hz = f0_Hz;
  constexpr int kIterations = 40;  // each reduces the error by d ln E'/d ln f < 1/2 or less
  for (int i = 0; i < kIterations; ++i) {
    const double E = complex_modulus_Pa(series, 2.0 * std::numbers::pi * f_Hz).storage_Pa / E0;
    f_Hz = f0_Hz * std::sqrt(std::max(0.0, (E - stress_share) / (1.0 - stress_share)));
  }
  return f_Hz;
}

// Replaces frequencies found with the instantaneous moduli by relaxed ones; torsion uses G', and
// only lateral modes feel the pressure. Exact without film and load at constant Poisson ratio
// (correspondence principle: Christensen, Theory of Viscoelasticity (1982), ch. 2); otherwise a
// tenth of the change is added to the error.
void relax_modes(const PillarScene& scene, SceneAnswer& answer) {
  if (scene.pillar.terms.empty()) return;
  const PronySeries young = young_series(scene.pillar);
  const PronySeries shear = shear_series(scene.pillar);
  const double share = pressure_Pa(scene) / engesser_pressure_Pa(scene);
  double first_lateral_Hz = 0.0;
  for (SceneMode& mode : answer.modes) {
    double stress_share = 0.0;
    if (mode.family == "lateral") {
      if (first_lateral_Hz == 0.0) first_lateral_Hz = mode.frequency_Hz;
      const double stiffer = first_lateral_Hz / mode.frequency_Hz;
      stress_share = std::min(0.99, share * stiffer * stiffer);
    }
    const double f_Hz = relaxed_frequency_Hz(
        mode.frequency_Hz, mode.family == "torsion" ? shear : young, stress_share);
    const bool exact = !scene.film && stress_share == 0.0 &&
                       (has_constant_poisson_ratio(scene.pillar) || mode.family == "torsion");
    if (!exact) mode.error_estimate += 0.1 * std::abs(mode.frequency_Hz - f_Hz);
    mode.frequency_Hz = f_Hz;
  }
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
          .push_Pa = pressure_Pa,
          .fields = modal_fields,
          .relaxation = modal_relaxation,
          .film_compliance = modal_film_compliance,
          .geometric_stiffness = modal_geometric_stiffness};
}

}  // namespace viscard
