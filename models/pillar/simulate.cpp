#include "models/pillar/pillar_modes.h"
#include "models/pillar/scene.h"
#include "models/pillar/viscoelastic_pillar.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace viscard {
namespace {

PillarMedia media_of(const Scene& scene) {
  return {isotropic_medium(scene.pillar.E0_Pa, scene.pillar.nu, scene.pillar.rho_kg_m3),
          scene.film};
}

Motion axial_motion(const Scene& scene) {
  return scene.plane ? Motion::kPlaneSymmetric : Motion::kLongitudinal;
}

ModelOptions options_of(const Scene& scene, Motion motion) {
  return {.motion = motion, .plane = scene.plane.value_or(PlaneState::kStrain)};
}

// Everything one mesh answers, without error estimates.
class OneMesh {
 public:
  OneMesh(const Scene& scene, const Discretisation& discretisation)
      : scene_(scene), discretisation_(discretisation) {
    answer_.discretisation = discretisation;
  }

  SceneAnswer run() {
    switch (scene_.kind) {
      case AnalysisKind::kStatic:
        scene_.electrodes ? piezo() : statics();
        break;
      case AnalysisKind::kModal:
        modes();
        break;
      case AnalysisKind::kBuckling: {
        const PillarModel axial = model(Motion::kLongitudinal);
        const PillarModel lateral = model(Motion::kLateral);
        count(lateral);
        add("buckling_pressure", buckling(axial, lateral).pressure_Pa, "Pa");
        break;
      }
      case AnalysisKind::kCreep:
      case AnalysisKind::kRelaxation:
        history();
        break;
    }
    return std::move(answer_);
  }

 private:
  PillarModel model(Motion motion) {
    return PillarModel(scene_.geometry, discretisation_, media_of(scene_),
                       options_of(scene_, motion));
  }
  void add(const char* name, double value, const char* unit) {
    answer_.results.push_back({name, value, unit, 0.0});
  }
  void count(const PillarModel& model) {
    answer_.unknowns = std::max(answer_.unknowns, model.system().size());
  }

  void stresses(const PillarModel& model, const PillarState& state) {
    const double R = model.radius_m();
    add("base_stress_at_half_radius",
        model.stress_at(state, model.element_at(0.5 * R, 0.0, kPillarRegion), 0.5 * R, 0.0)[2],
        "Pa");
    if (!scene_.film) return;
    const double bottom_m = -scene_.geometry.film->thickness_m;
    add("film_bottom_stress_mean", model.mean_stress(state, 2, bottom_m, kFilmRegion, R), "Pa");
  }

  void statics() {
    const PillarModel axial = model(axial_motion(scene_));
    count(axial);
    const Eigen::VectorXd traction = axial.top_traction();
    const PillarState state = axial.solve(-scene_.pressure_Pa * traction);
    add("top_displacement", traction.dot(state.unknowns) / traction.sum(), "m");
    stresses(axial, state);
  }

  void piezo() {
    ModelOptions options = options_of(scene_, axial_motion(scene_));
    options.electrodes = scene_.electrodes;
    const PillarModel coupled(scene_.geometry, discretisation_, media_of(scene_), options);
    count(coupled);
    if (coupled.electrode_dof() < 0) {  // charge-free face, read at its centre
      const PillarState state = piezo_sampled(coupled, scene_.pressure_Pa);
      const bool top = scene_.electrodes->grounded == FilmFace::kBottom;
      add("potential_at_centre",
          potential_at_V(coupled, state, 0.0, top ? 0.0 : -scene_.geometry.film->thickness_m), "V");
      return;
    }
    const PiezoAnswer answer = piezo_static(coupled, scene_.pressure_Pa);
    add("electrode_voltage", answer.voltage_V, "V");
    add("electrode_charge", answer.charge_C, "C");
    add("electrode_capacitance", answer.capacitance_F, "F");
    add("top_displacement", answer.top_displacement_m, "m");
    add("displacement_per_volt", answer.displacement_per_V_m, "m/V");
  }

  void modes() {
    struct Family {
      const char* name;
      Motion motion;
      int harmonic;
    };
    const std::vector<Family> families =
        scene_.plane ? std::vector<Family>{{"lateral", Motion::kPlaneAntisymmetric, 0},
                                           {"longitudinal", Motion::kPlaneSymmetric, 0}}
                     : std::vector<Family>{{"lateral", Motion::kLateral, 1},
                                           {"longitudinal", Motion::kLongitudinal, 0},
                                           {"torsion", Motion::kTorsion, 0},
                                           {"ovalling", Motion::kOvalling, 2}};
    for (const Family& family : families) {
      const PillarModel one = model(family.motion);
      count(one);
      const bool pressed = scene_.pressure_Pa != 0.0 && family.motion == Motion::kLateral;
      const int wanted = std::min(scene_.modes, one.system().size());
      const std::vector<PillarMode> found =
          pressed
              ? modes_under_pressure(model(Motion::kLongitudinal), one, scene_.pressure_Pa, wanted)
              : lowest_modes(one, wanted);
      for (const PillarMode& mode : found) {
        answer_.modes.push_back({family.name, family.harmonic, mode.frequency_Hz, 0.0});
      }
    }
  }

  void history() {
    const bool is_creep = scene_.kind == AnalysisKind::kCreep;
    const ViscoelasticPillar pillar(scene_.geometry, discretisation_, scene_.pillar,
                                    is_creep ? TopLoad::kPressure : TopLoad::kRigidPlate,
                                    scene_.film);
    count(pillar.model());
    std::vector<HistoryPoint> history = scene_.history;
    for (HistoryPoint& point : history) point.value *= is_creep ? -pillar.top_area_m2() : -1.0;
    HistoryOptions options;
    options.tolerance = 0.1 * scene_.tolerance;
    const HistoryResult run = run_history(
        pillar.system(), is_creep ? Control::kForce : Control::kDisplacement, history, options);
    if (!run.converged) {
      throw std::runtime_error("the time steps do not settle to a tenth of the tolerance of " +
                               std::to_string(scene_.tolerance));
    }
    const double per_area = -1.0 / pillar.top_area_m2();
    SceneCurve curve{
        is_creep ? "top_displacement" : "top_pressure", is_creep ? "m" : "Pa", run.time_s, {}};
    for (std::size_t i = 0; i < run.time_s.size(); ++i) {
      curve.value.push_back(is_creep ? run.displacement[i] : run.force[i] * per_area);
    }
    const auto peak =
        std::max_element(curve.value.begin(), curve.value.end(),
                         [](double a, double b) { return std::abs(a) < std::abs(b); });
    add(is_creep ? "top_displacement_end" : "top_pressure_end", curve.value.back(),
        curve.unit.c_str());
    add(is_creep ? "top_displacement_peak" : "top_pressure_peak", *peak, curve.unit.c_str());
    answer_.curves.push_back(std::move(curve));
  }

  const Scene& scene_;
  Discretisation discretisation_;
  SceneAnswer answer_;
};

std::vector<double> numbers_of(const SceneAnswer& answer) {
  std::vector<double> numbers;
  for (const SceneResult& result : answer.results) numbers.push_back(result.value);
  for (const SceneMode& mode : answer.modes) numbers.push_back(mode.frequency_Hz);
  return numbers;
}

void set_errors(SceneAnswer& answer, const std::vector<double>& error) {
  std::size_t i = 0;
  for (SceneResult& result : answer.results) result.error_estimate = error[i++];
  for (SceneMode& mode : answer.modes) mode.error_estimate = error[i++];
}

std::vector<Discretisation> meshes_of(const Scene& scene) {
  // Elements of the shaft and the outer film no longer than a few radii, so that long pillars and
  // wide films are resolved by the same degrees.
  const double R_m = 0.5 * scene.geometry.diameter_m;
  const double shaft = (scene.geometry.length_m - 2.0 * R_m) / (4.0 * R_m);
  const int shaft_elements = std::clamp(static_cast<int>(std::lround(shaft)), 1, 40);
  int film_elements = 1;
  if (scene.geometry.film) {
    const double scale_m = std::min(2.0 * R_m, 2.0 * scene.geometry.film->thickness_m);
    const double outside_m = scene.geometry.film->radius_m - 2.0 * R_m;
    film_elements = std::clamp(static_cast<int>(std::ceil(outside_m / scale_m)), 1, 40);
  }
  std::vector<Discretisation> meshes;
  for (const auto& [degree, layers] :
       {std::pair{3, 1}, {4, 2}, {5, 2}, {6, 3}, {7, 3}, {8, 4}, {9, 4}, {10, 5}}) {
    meshes.push_back({.degree = degree,
                      .layers = layers,
                      .shaft_elements = shaft_elements,
                      .film_elements = film_elements});
  }
  return meshes;
}

// A load on the straight pillar beyond its buckling pressure has no meaning; worth computing only
// where Euler's formula (clamped-free, K = 2) comes near.
void refuse_buckled(const Scene& scene) {
  if (scene.plane || scene.kind == AnalysisKind::kModal || scene.kind == AnalysisKind::kBuckling)
    return;
  double largest_Pa = scene.pressure_Pa;
  if (scene.kind == AnalysisKind::kCreep) {
    for (const HistoryPoint& point : scene.history) largest_Pa = std::max(largest_Pa, point.value);
  }
  const double slenderness = scene.geometry.diameter_m / scene.geometry.length_m;
  const double pi = std::numbers::pi;
  const double euler_Pa = pi * pi / 64.0 * scene.pillar.E0_Pa * slenderness * slenderness;
  if (largest_Pa < 0.5 * euler_Pa) return;
  const Discretisation mesh = meshes_of(scene)[1];
  const PillarModel axial(scene.geometry, mesh, media_of(scene), {.motion = Motion::kLongitudinal});
  const PillarModel lateral(scene.geometry, mesh, media_of(scene), {.motion = Motion::kLateral});
  const double critical_Pa = buckling(axial, lateral).pressure_Pa;
  if (largest_Pa >= critical_Pa) {
    throw std::runtime_error(
        "a pressure of " + std::to_string(largest_Pa) +
        " Pa is beyond the buckling pressure of about " + std::to_string(critical_Pa) +
        " Pa: the straight pillar gives way sideways. Reduce the load, or make the "
        "pillar shorter or thicker");
  }
}

std::vector<SceneEffect> effects_of(const Scene& scene) {
  const bool in_time =
      scene.kind == AnalysisKind::kCreep || scene.kind == AnalysisKind::kRelaxation;
  const bool modal = scene.kind == AnalysisKind::kModal;
  return {{"relaxation", in_time && !scene.pillar.terms.empty(),
           in_time ? "the analysis is in time"
                   : "static and modal answers use the instantaneous moduli"},
          {"inertia", modal, modal ? "modal analysis" : "the analysis is quasi-static"},
          {"incompressibility", scene.pillar.nu >= kNearlyIncompressible,
           "pressures are condensed from a Poisson ratio of 0.45 on"},
          {"film_compliance", scene.film.has_value(),
           scene.film ? "the scene has a film" : "the base is rigid"},
          {"piezo_coupling", scene.electrodes && scene.kind == AnalysisKind::kStatic,
           scene.electrodes ? "the film has electrodes; both ways" : "no electrode"},
          {"geometric_stiffness",
           scene.kind == AnalysisKind::kBuckling || (modal && scene.pressure_Pa != 0.0),
           "buckling, and modes under a pressure"}};
}

}  // namespace

SceneAnswer simulate(const Scene& scene) {
  validate(scene);
  refuse_buckled(scene);
  std::vector<double> last;
  std::vector<double> last_change;
  SceneAnswer answer;
  for (const Discretisation& mesh : meshes_of(scene)) {
    answer = OneMesh(scene, mesh).run();
    const std::vector<double> now = numbers_of(answer);
    std::vector<double> change(now.size(), 0.0);
    answer.largest_relative_error = last.size() == now.size() ? 0.0 : 1.0;
    for (std::size_t i = 0; i < now.size() && last.size() == now.size(); ++i) {
      change[i] = std::abs(now[i] - last[i]);
      // A chance agreement of two meshes must not pass for convergence.
      if (!last_change.empty()) change[i] = std::max(change[i], 0.1 * last_change[i]);
      if (change[i] > 0.0) {
        answer.largest_relative_error =
            std::max(answer.largest_relative_error, change[i] / std::abs(now[i]));
      }
    }
    set_errors(answer, change);
    const bool compared_twice = !last_change.empty();
    if (last.size() == now.size()) last_change = change;
    last = now;
    if (compared_twice && answer.largest_relative_error <= scene.tolerance) break;
  }
  if (!(answer.largest_relative_error <= scene.tolerance)) {
    throw std::runtime_error("the finest mesh leaves a relative error of about " +
                             std::to_string(answer.largest_relative_error) +
                             "; ask for a tolerance that is not smaller");
  }
  answer.effects = effects_of(scene);
  return answer;
}

}  // namespace viscard
