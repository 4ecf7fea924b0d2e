#include "models/pillar/analyses/large_strain.h"

#include "models/hyperelastic/hyperelastic_law.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/top_load.h"
#include "models/pillar/body/solution_rest.h"
#include "models/pillar/large/large_static.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace viscard {
namespace {

// The law with the modulus at rest of the scene's material, which an uncertain scene may change.
HyperelasticLaw rubber_of(const PillarScene& scene) {
  HyperelasticLaw law = *scene.rubber;
  law.moduli_Pa *= scene.pillar.E0_Pa / youngs_modulus_Pa(law);
  return law;
}

LargeLoad large_load(const PillarScene& scene) {
  return {.pressure_Pa = pressure_Pa(scene), .displacement_m = displacement_m(scene)};
}

// A pillar of rubber on its film without a potential, on a mesh with the electrode's edge.
struct LargeAnswer {
  PillarModel model;
  LargeBody body;
  LargeState state;
  LargeAnswer(const PillarScene& scene, const Discretisation& mesh)
      : model(with_electrode_edge(scene.geometry, scene.electrodes), mesh, media_of(scene),
              options_of(scene, axial_motion(scene))),
        body(model, finite_law(rubber_of(scene), scene.pillar.nu)),
        state(solve_large(body, large_load(scene))) {}
};

void note_newton(const LargeState& state, SceneAnswer& answer) {
  answer.step_error = state.rest;
  if (state.falling_directions == 0) return;
  answer.notes.push_back("the energy of the pillar at large strain falls in " +
                         std::to_string(state.falling_directions) +
                         (state.falling_directions == 1 ? " direction" : " directions") +
                         ": its surface may crease, mostly at the singular rim of the bond");
}

void add_true_stresses(const LargeAnswer& large, SceneAnswer& answer) {
  const PillarModel& model = large.model;
  const double R_m = model.radius_m();
  const double x_m = 0.5 * R_m;
  answer.results.push_back(
      {"base_stress_at_half_radius",
       large.body.true_stress_at_Pa(large.state.u, model.element_at(x_m, 0.0, kPillarRegion), x_m,
                                    0.0)[2],
       "Pa"});
  const double bond_m = bond_radius_m(model.geometry());
  answer.results.push_back(
      {"base_stress_mean", large.state.force_N / (std::numbers::pi * bond_m * bond_m), "Pa"});
  if (!model.geometry().film) return;
  const PillarState film{large.state.u, large.state.u};
  answer.results.push_back(
      {"film_bottom_stress_mean",
       model.mean_stress(film, 2, -model.geometry().film->thickness_m, kFilmRegion, R_m), "Pa"});
}

void run_large_elastic(const PillarScene& scene, const LargeAnswer& large, SceneAnswer& answer) {
  const PillarModel& model = large.model;
  const LargeState& state = large.state;
  if (moves_top(scene)) {
    add_top_force(scene, state.force_N, state.force_N / state.top_displacement_m, answer);
  } else {
    answer.results.push_back({"top_displacement", state.top_displacement_m, "m"});
  }
  // What the polynomials of the linear solution lack, relative.
  const Eigen::VectorXd traction = model.top_traction();
  const PillarState per_Pa = model.solve(-traction);
  const SolutionRest rest(model, per_Pa.unknowns);
  const double unresolved = missing_share(rest, rest, traction.dot(per_Pa.unknowns));
  for (SceneResult& result : answer.results) result.unresolved = unresolved;
  add_true_stresses(large, answer);
}

// What large strain multiplies: displacement and voltage per pressure.
struct Change {
  double displacement = 1.0, voltage = 1.0, centre = 1.0, mean = 1.0;
};

Change change_of(const PillarScene& scene, const LargeAnswer& large, const PillarModel& electric) {
  const PillarModel& elastic = large.model;
  const PillarState linear = elastic.solve(-large.state.pressure_Pa * elastic.top_traction());
  Change change;
  change.displacement = large.state.top_displacement_m / elastic.mean_top_displacement_m(linear);
  if (electric.electrode_dof() >= 0) {
    change.voltage = piezo_from_motion(elastic, electric, large.state.u).voltage_V /
                     piezo_from_motion(elastic, electric, linear.unknowns).voltage_V;
    return change;
  }
  const PillarState is = potential_from_motion(elastic, electric, large.state.u);
  const PillarState was = potential_from_motion(elastic, electric, linear.unknowns);
  const double z_m = free_face_m(scene);
  const double R_m = electric.radius_m();
  change.centre = potential_at_V(electric, is, 0.0, z_m) / potential_at_V(electric, was, 0.0, z_m);
  change.mean =
      mean_potential_V(electric, is, z_m, R_m) / mean_potential_V(electric, was, z_m, R_m);
  return change;
}

void run_large_piezo(const PillarScene& scene, const LargeAnswer& large, SceneAnswer& answer) {
  const PillarModel electric = electric_model_of(scene, axial_motion(scene), answer.discretisation);
  const Change change = change_of(scene, large, electric);
  FilmAnswer per_Pa = film_answer(scene, answer);
  per_Pa.piezo.top_displacement_m *= change.displacement;
  per_Pa.piezo.voltage_V *= change.voltage;
  per_Pa.piezo.charge_C *= change.voltage;
  per_Pa.centre_V *= change.centre;
  per_Pa.mean_V *= change.mean;
  add_film_results(scene, per_Pa, answer);
  answer.notes.emplace_back(
      "what large strain changes in the film's voltage and charge is computed one way: the field "
      "does not act back on the change");
  // At rest only: a voltage on a strained pillar is not answered.
  std::erase_if(answer.results,
                [](const SceneResult& result) { return result.name == "displacement_per_volt"; });
}

}  // namespace

const char* why_small_strain(const PillarScene& scene) {
  const Analysis& analysis = analysis_of(scene);
  if (!scene.rubber) return "small strains are assumed; give the pillar a law of rubber";
  if (analysis.why_small_strain == nullptr) return "only statics know large strain";
  return analysis.why_small_strain(scene);
}

bool is_large(const PillarScene& scene) {
  return !scene.small_strain && why_small_strain(scene) == nullptr;
}

void run_large(const PillarScene& scene, SceneAnswer& answer) {
  const LargeAnswer large(scene, answer.discretisation);
  count_unknowns(large.model, answer);
  note_newton(large.state, answer);
  scene.electrodes ? run_large_piezo(scene, large, answer)
                   : run_large_elastic(scene, large, answer);
}

std::string at_once_note(const PillarScene& scene, const PillarScene& reduced) {
  if (scene.pillar.terms.empty() || !is_large(reduced)) return "";
  return "large strain is that of the law of rubber at once, right after loading; the relaxation "
         "of its file does not count here (creep, relaxation and vibration have it, at small "
         "strain)";
}

std::vector<SectionGrid> large_fields(const PillarScene& scene, const Discretisation& mesh) {
  const LargeAnswer large(scene, mesh);
  Sampling at = sampling_of(large.model);
  at.grid.name = "static";
  at.grid.fields.push_back(displacement_field(large.model, at, "displacement_m", large.state.u));
  const PillarState film{large.state.u, large.state.u};
  SectionField stress = stress_field(large.model, at, film);
  const double off_axis_m = 1e-6 * large.model.radius_m();
  for (std::size_t i = 0; i < at.element.size(); ++i) {
    if (at.element[i]->region != kPillarRegion) continue;
    const double x_m = std::max(at.grid.x_m[i], off_axis_m);
    stress.value[i][0] =
        large.body.true_stress_at_Pa(large.state.u, *at.element[i], x_m, at.grid.z_m[i])[2];
  }
  at.grid.fields.push_back(stress);
  if (scene.electrodes) {
    const PillarModel electric = electric_model_of(scene, axial_motion(scene), mesh);
    const PillarState potential = potential_from_motion(large.model, electric, large.state.u);
    const Sampling of_film = sampling_of(electric);
    at.grid.fields.push_back(potential_field(electric, of_film, potential));
  }
  return {at.grid};
}

double large_strain_error(const PillarScene& scene, double strain) {
  const HyperelasticLaw law = rubber_of(scene);
  constexpr int kStrains = 16;
  double largest = std::abs(strain);
  for (int i = 1; i <= kStrains; ++i) {
    const double e = strain * i / kStrains;
    const double stress_Pa =
        e > -1.0 ? nominal_stress_Pa(law, Deformation::kUniaxial, 1.0 + e) : NAN;
    const double change = std::abs(stress_Pa / (scene.pillar.E0_Pa * e) - 1.0);
    if (!(change < 1.0)) return 1.0;
    largest = std::max(largest, change);
  }
  const double shape = 0.25 * scene.geometry.diameter_m / scene.geometry.length_m;
  const double confined = 2.0 * shape * shape / (1.0 + 2.0 * shape * shape);
  return std::min(1.0, kLargeStrainMargin * largest + 2.0 * std::abs(strain) * confined);
}

}  // namespace viscard
