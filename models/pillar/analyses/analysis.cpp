#include "models/pillar/analyses/analysis.h"

#include "models/pillar/time/spectrum.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {

const std::vector<Analysis>& analyses() {
  static const std::vector<Analysis> kAnalyses = {
      static_analysis(), modal_analysis(),    buckling_analysis(),  relaxation_analysis(),
      creep_analysis(),  harmonic_analysis(), transient_analysis(),
  };
  return kAnalyses;
}

const Analysis& analysis_of(const PillarScene& scene) {
  for (const Analysis& analysis : analyses()) {
    if (analysis.drive.index() == scene.drive.index()) return analysis;
  }
  throw std::logic_error("this drive has no row in the table of analyses");
}

PillarMedia media_of(const PillarScene& scene) {
  PillarMedia media{isotropic_medium(scene.pillar.E0_Pa, scene.pillar.nu, scene.pillar.rho_kg_m3),
                    scene.film};
  const Surroundings& around = scene.surroundings;
  media.pillar.free_strain = around.pillar_expansion_1_K * around.heated_K();
  if (!media.film) return media;
  media.film->free_strain = around.film_expansion_1_K * around.heated_K();
  media.film->free_polarisation_C_m2 = around.pyroelectric_C_m2K * around.heated_K();
  return media;
}

Motion axial_motion(const PillarScene& scene) {
  return scene.plane ? Motion::kPlaneSymmetric : Motion::kLongitudinal;
}

Motion lateral_motion(const PillarScene& scene) {
  return scene.plane ? Motion::kPlaneAntisymmetric : Motion::kLateral;
}

ModelOptions options_of(const PillarScene& scene, Motion motion) {
  const bool is_pressed_by_plate =
      plate_on_top(scene) || (moves_top(scene) && motion == axial_motion(scene));
  const bool is_pinned =
      !scene.fixed_bottom && analysis_of(scene).free_bottom == FreeBottom::kPinned;
  return {.motion = motion,
          .plane = scene.plane.value_or(PlaneState::kStrain),
          .fixed_bottom = scene.fixed_bottom,
          .pin_bottom = is_pinned,
          .rigid_top = is_pressed_by_plate,
          .condense_pressures_from = scene.condense_pressures_from};
}

void count_unknowns(const PillarModel& model, SceneAnswer& answer) {
  answer.unknowns = std::max(answer.unknowns, model.system().size());
}

void add_time_constant(double time_constant_s, SceneAnswer& answer) {
  if (!std::isfinite(time_constant_s)) return;
  answer.results.push_back({"readout_time_constant", time_constant_s, "s"});
}

SceneCurve spectrum_of(const SceneCurve& curve) {
  const Spectrum spectrum = amplitude_spectrum(
      std::vector<double>(curve.value.begin(), curve.value.end() - 1), curve.x[1] - curve.x[0]);
  return {curve.name + "_spectrum", curve.unit, spectrum.frequency_Hz, spectrum.amplitude,
          "frequency_Hz"};
}

const NearbyPillar* nearby_of(const PillarScene& scene, Motion motion, bool is_electric,
                              NearbyRole role) {
  if (scene.nearby == nullptr) return nullptr;
  for (const auto& one : *scene.nearby) {
    const ModelOptions& its = one->model().options();
    if (one->role() == role && its.motion == motion && its.electrodes.has_value() == is_electric) {
      return one.get();
    }
  }
  throw NotNearby("no nearby pillar moves like this one");
}

namespace {

ModelOptions electric_options_of(const PillarScene& scene, Motion motion) {
  ModelOptions options = options_of(scene, motion);
  options.electrodes = scene.electrodes;
  return options;
}

PillarModel model_with(const PillarScene& scene, const ModelOptions& options,
                       const Discretisation& mesh) {
  const NearbyPillar* nearby = nearby_of(scene, options.motion, options.electrodes.has_value());
  return PillarModel(scene.geometry, mesh, media_of(scene), options,
                     nearby == nullptr ? nullptr : &nearby->model(),
                     nearby == nullptr ? nullptr : &nearby->solutions());
}

}  // namespace

PillarModel model_of(const PillarScene& scene, Motion motion, const Discretisation& mesh) {
  return model_with(scene, options_of(scene, motion), mesh);
}

PillarModel electric_model_of(const PillarScene& scene, Motion motion, const Discretisation& mesh) {
  return model_with(scene, electric_options_of(scene, motion), mesh);
}

std::unique_ptr<NearbyPillar> nearby_model_of(const PillarScene& scene, Motion motion,
                                              const Discretisation& mesh) {
  return std::make_unique<NearbyPillar>(scene.geometry, mesh, media_of(scene),
                                        options_of(scene, motion));
}

std::unique_ptr<NearbyPillar> nearby_electric_model_of(const PillarScene& scene, Motion motion,
                                                       const Discretisation& mesh) {
  return std::make_unique<NearbyPillar>(scene.geometry, mesh, media_of(scene),
                                        electric_options_of(scene, motion));
}

std::vector<std::string> moving_names(const PillarScene& scene, const std::string& first,
                                      const std::vector<std::string>& endings) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& stem) {
    names.push_back(stem);
    for (const std::string& ending : endings) names.push_back(stem + ending);
  };
  add(first);
  const bool has_quadrants = reads_quadrants(scene);
  if (!scene.electrodes || (is_lateral(scene) && !has_quadrants)) return names;
  const bool is_sampled = scene.electrodes->electrode_radius_m == 0.0;
  if (has_quadrants) {
    add(is_sampled ? "quadrant_voltage" : "quadrant_charge");
  } else {
    add(is_sampled ? "potential_at_centre" : "electrode_voltage");
  }
  if (!scene.readout) return names;
  add("reading");
  if (!has_quadrants) names.emplace_back("electrode_capacitance");
  names.emplace_back("readout_time_constant");
  return names;
}

PronySeries largest_relaxation(const Material& material) {
  PronySeries series;
  double rest = 1.0;
  for (const MaterialTerm& term : material.terms) {
    const double share = std::max(term.g, term.k);
    series.terms.push_back({share, term.tau_s});
    rest -= share;
  }
  series.equilibrium_modulus_Pa = std::max(rest, 1e-3);
  return series;
}

double first_rod_frequency_Hz(const PillarScene& scene) {
  return std::sqrt(scene.pillar.E0_Pa / scene.pillar.rho_kg_m3) / (4.0 * scene.geometry.length_m);
}

}  // namespace viscard
