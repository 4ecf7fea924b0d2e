#include "models/array/space/simulate_space.h"
#include "models/array/space/space_contact.h"
#include "models/array/space/space_maps.h"
#include "models/array/space/touch_steps.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/buckling_limit.h"
#include "models/scene/scene_effects.h"
#include "models/sensor/sensor_design.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viscard {
namespace {

bool is_viscoelastic(const SpaceScene& scene) {
  return !scene.pillar.terms.empty() ||
         std::any_of(scene.others.begin(), scene.others.end(),
                     [](const SpaceClass& one) { return !one.material.terms.empty(); });
}

// The largest value of an estimate over the classes of pillars.
template <typename OfClass>
double largest_over_classes(const SpaceScene& scene, const OfClass& of_class) {
  double largest = 0.0;
  for (const SpaceClass& one : classes_of(scene)) largest = std::max(largest, of_class(one));
  return largest;
}

// Largest pressure on a top; under a shape that of an elastic foundation.
double top_pressure_Pa(const SpaceScene& scene) {
  return scene.press ? foundation_press(scene).largest_Pa : scene.pressure_Pa;
}

// One of the pillars on a wide film.
PillarScene on_film(const SpaceScene& scene, const SpaceClass& one) {
  PillarScene single = single_pillar(scene, one);
  single.film = scene.film;
  single.geometry.film = FilmGeometry{scene.film_thickness_m, one.diameter_m};
  return single;
}

}  // namespace

EffectEstimate film_compliance_estimate(const SpaceScene& scene) {
  const double share = largest_over_classes(scene, [&](const SpaceClass& one) {
    const FilmShares shares = film_shares(on_film(scene, one));
    return kUnevenTraction *
           (is_sheared(scene) ? std::max(shares.axial, shares.lateral()) : shares.axial);
  });
  return {EffectRole::kNeeded, share, "base compliance over pillar's", share,
          "its potential is asked for"};
}

EffectEstimate piezo_coupling_estimate(const SpaceScene& scene) {
  PillarScene one = on_film(scene, classes_of(scene).front());
  one.electrodes = ElectrodeOptions{scene.grounded, 0.5 * scene.diameter_m};
  one.wanted = {"electrode_voltage"};
  EffectEstimate estimate = piezo_coupling_estimate(one);
  estimate.role = EffectRole::kNeeded;
  estimate.reason = "its potential is asked for";
  return estimate;
}

EffectEstimate relaxation_estimate(const SpaceScene& scene) {
  if (!is_viscoelastic(scene)) return {.reason = "the material is elastic"};
  if (scene.touch) {
    const double share = relaxed_share(scene);
    if (scene.touch->is_path()) {
      return {EffectRole::kNeeded, share, "relaxed share at the end", share,
              "tops are dragged and left while they relax"};
    }
    return {EffectRole::kOptional, share, "relaxed share at the end", share,
            scene.touch->is_creep ? "the shape sinks in under its force"
                                  : "the force under the shape falls"};
  }
  return {.reason = "answers right after loading, with the instantaneous moduli"};
}

void leave_out_relaxation(SpaceScene& scene) {
  scene.pillar.terms.clear();
  for (SpaceClass& one : scene.others) one.material.terms.clear();
}

EffectEstimate dielectric_loss_estimate(const SpaceScene& scene) {
  if (!scene.touch) return film_loss_estimate(scene.film_loss, 0.0, 1.0);
  if (scene.touch->readout && scene.touch->readout->kind == ReadoutKind::kCharge) {
    return {.reason = "the amplifiers hold the film at 0 V, where it loses nothing"};
  }
  EffectEstimate estimate = film_loss_estimate(
      scene.film_loss, 1.0 / scene.touch->history.back().time_s, loss_in_time(false, true));
  if (scene.touch->readout || estimate.role == EffectRole::kAbsent) return estimate;
  estimate.role = EffectRole::kOutside;
  estimate.reason = "voltages are those of charges that stay; add [readout] to read them in time";
  return estimate;
}

EffectEstimate leakage_estimate(const SpaceScene& scene) {
  if (!scene.touch || !scene.touch->readout) {
    return {.reason = "faces without charge, before any leaks in"};
  }
  return {EffectRole::kNeeded, 1.0, "", 0.0, "the reading of an amplifier is asked for"};
}

EffectEstimate incompressibility_estimate(const SpaceScene& scene) {
  const double nu =
      largest_over_classes(scene, [](const SpaceClass& one) { return one.material.nu; });
  if (nu < kNearlyIncompressible) {
    return {.reason = "the mesh error that is watched contains it"};
  }
  return {EffectRole::kNeeded, 1.0, "Poisson ratio", nu,
          "forces on the film would lock without pressures of their own"};
}

// The amplitudes are those of rows in plane strain (eq. A4), in which a neighbour is a wall without end;
// tests/models/scene checks that they cover arrays of cylinders with up to six neighbours.
EffectEstimate crosstalk_estimate(const SpaceScene& scene) {
  const double gap_m = smallest_gap_m(scene);
  if (std::isinf(gap_m)) return {.reason = "a single pillar"};
  const double x = gap_m / scene.film_thickness_m;
  EffectEstimate estimate{EffectRole::kOptional,
                          neighbour_influence(x, scene.film_thickness_m / scene.diameter_m),
                          "gap over film thickness", x, "neighbours load the film"};
  if (scene.backing && scene.feels_backing) {
    estimate.role = EffectRole::kNeeded;
    estimate.reason = "the film stretches under all pillars on its backing";
  } else if (has_crosstalk(scene) && asks_for_map(scene, "crosstalk_percent")) {
    estimate.role = EffectRole::kNeeded;
    estimate.reason = "the influence of the neighbours is asked for";
  } else if (is_sheared(scene)) {
    estimate.role = EffectRole::kNeeded;
    estimate.reason = "the shear of a neighbour reads as pressure";
  }
  return estimate;
}

// A straight pillar shortens without it. A pillar that is pressed and sheared bends more than under the shear alone.
EffectEstimate geometric_stiffness_estimate(const SpaceScene& scene) {
  const double pressure_Pa = top_pressure_Pa(scene);
  if (!(pressure_Pa > 0.0)) return {.reason = "no pressure on the tops"};
  const double share = largest_over_classes(scene, [&](const SpaceClass& one) {
    return pressure_Pa / engesser_pressure_Pa(single_pillar(scene, one));
  });
  if (!is_sheared(scene)) {
    return {EffectRole::kAbsent, 0.0, "p/p_cr", share, "straight pillars shorten without it"};
  }
  if (!scene.press) {
    return stiffness_of_bent(
        share, 1.0, "the pressure bends pillars further that a shear bends; not in the error");
  }
  // Forces and voltages of pillars that bend change less than their moments.
  EffectEstimate estimate = stiffness_of_bent(share, foundation_press(scene).turn, kTurned);
  estimate.error = std::min(estimate.error, 1.0);
  return estimate;
}

// Pillars longer than eq. D3 allows stay together once they touch; no analysis includes that.
EffectEstimate adhesion_estimate(const SpaceScene& scene) {
  const double gap_m = smallest_gap_m(scene);
  if (std::isinf(gap_m)) return {.reason = "a single pillar with nothing to stick to"};
  return adhesion_at(largest_over_classes(scene, [&](const SpaceClass& one) {
    return one.length_m / longest_unmatted_m(one.diameter_m, gap_m,
                                             {.young_modulus_Pa = one.material.E0_Pa,
                                              .poisson_ratio = one.material.nu,
                                              .surface_energy_J_m2 = scene.surface_energy_J_m2});
  }));
}

EffectEstimate finite_strain_estimate(const SpaceScene& scene) {
  const double shear_Pa = std::hypot(scene.shear_x_Pa, scene.shear_y_Pa);
  const double pull_Pa = scene.press ? foundation_press(scene).pull_Pa : 0.0;
  const double pressure_Pa = std::max(std::abs(top_pressure_Pa(scene)), pull_Pa);
  const double strain = largest_over_classes(scene, [&](const SpaceClass& one) {
    // Bending strain at the foot of a cylinder: 8 tau l/(E d).
    const double bending_Pa = 8.0 * shear_Pa * one.length_m / one.diameter_m;
    return (pressure_Pa + bending_Pa) / one.material.E0_Pa;
  });
  return {EffectRole::kOutside, 2.3 * strain, "strain", strain,
          "small strains are assumed; not in the error"};
}

EffectEstimate contact_estimate(const SpaceScene& scene) {
  if (!scene.press) return {.reason = "no shape presses on the pillars"};
  EffectEstimate estimate = contact_of(*scene.press, foundation_press(scene));
  if (scene.backing) estimate.role = EffectRole::kNeeded;
  if (scene.touch) {
    estimate.role = EffectRole::kNeeded;
    estimate.reason = "the contact grows in time";
  }
  return estimate;
}

EffectEstimate pull_off_estimate(const SpaceScene& scene) {
  if (!scene.press) return {.reason = "no shape presses on the pillars"};
  const double work_J_m2 = scene.press->work_of_adhesion_J_m2;
  if (work_J_m2 == 0.0) return {.reason = "no work of adhesion is given"};
  const double largest_Pa = foundation_press(scene).largest_Pa;
  return pull_off_at(*scene.press, largest_over_classes(scene, [&](const SpaceClass& one) {
    const double area_m2 = 0.25 * std::numbers::pi * one.diameter_m * one.diameter_m;
    return largest_Pa > 0.0 ? class_pull_off_N(one, work_J_m2) / (area_m2 * largest_Pa) : 1.0;
  }));
}

// The film's reading of waves from the width of a foot to the extent of the array (eq. S1), and how far the
// backing sinks under all pillars, (1 - nu^2) p D/E of a half-space, over their shortening: Johnson, Contact
// Mechanics (1985), 3.4.
EffectEstimate backing_estimate(const SpaceScene& scene) {
  if (!scene.backing) return {.reason = "the base is rigid"};
  constexpr int kWaves = 8, kDegree = 6;
  SpaceArray array = array_of(scene);
  array.film.backing = scene.backing;
  LayeredFilm held = array.film;
  held.backing.reset();
  const double shortest_1_m = 2.0 / scene.diameter_m;
  const double extent_m = array_diagonal_m(array) + scene.diameter_m;
  const FilmWaves on_backing(array.film, 0.0, shortest_1_m, kDegree);
  const FilmWaves on_rigid(held, 0.0, shortest_1_m, kDegree);
  double change = 0.0;
  for (int i = 0; i < kWaves; ++i) {
    const double k_1_m =
        shortest_1_m * std::pow(2.0 / (extent_m * shortest_1_m), i / (kWaves - 1.0));
    const double rigid = on_rigid.reading(k_1_m)[2];
    change = std::max(change, std::abs(on_backing.reading(k_1_m)[2] / rigid - 1.0));
  }
  const double shares = largest_over_classes(scene, [&](const SpaceClass& one) {
    const double cover = 0.25 * std::numbers::pi * one.diameter_m * one.diameter_m *
                         static_cast<double>(scene.pillars.size()) / (extent_m * extent_m);
    const double nu = scene.backing->poisson_ratio;
    return (1.0 - nu * nu) * cover * extent_m * one.material.E0_Pa /
           (scene.backing->young_modulus_Pa * one.length_m);
  });
  if (scene.press) change = std::max(change, shares);
  return {EffectRole::kOptional, change, "film's E over backing's",
          elasticity_of(scene.film).young_Pa / scene.backing->young_modulus_Pa,
          "the film bends and stretches on its backing"};
}

}  // namespace viscard
