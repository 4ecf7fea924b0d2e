// Effects on a bulk layer under a shape.
#include "models/array/layer/simulate_layer.h"
#include "models/scene/effects.h"
#include "models/scene/scene_effects.h"

#include <algorithm>
#include <map>
#include <string>

namespace viscard {
namespace {

// Share of the film in the sinking of the face under a wide pressure: t/M of the film over that of
// film and layer, M = E (1 - nu)/((1 + nu)(1 - 2 nu)).
EffectEstimate film_compliance_estimate(const LayerScene& scene) {
  const double film = scene.film_thickness_m / scene.film.stiffness_Pa(2, 2);
  const double share = film / (film + scene.thickness_m / bonded_modulus_Pa(scene));
  return {EffectRole::kNeeded, share, "t/M of the film over both", share,
          "its potential is asked for"};
}

// The coupling constant e33^2/(c33 eps33) that stiffens the film (IEEE Std 176-1987).
EffectEstimate piezo_coupling_estimate(const LayerScene& scene) {
  const Medium& film = scene.film;
  const double coupling = film.piezo_C_m2(2, 2) * film.piezo_C_m2(2, 2) /
                          (film.stiffness_Pa(2, 2) * film.permittivity_F_m(2, 2));
  return {EffectRole::kNeeded, std::min(1.0, coupling), "e33^2/(c33 eps33)", coupling,
          "its potential is asked for"};
}

EffectEstimate relaxation_estimate(const LayerScene& scene) {
  if (scene.pillar.terms.empty()) return {.reason = "the material is elastic"};
  return {.reason = "answers right after loading, with the instantaneous moduli"};
}

EffectEstimate incompressibility_estimate(const LayerScene& scene) {
  if (scene.pillar.nu < kNearlyIncompressible) {
    return {.reason = "the layer is solved through its thickness with degree 10"};
  }
  return {EffectRole::kNeeded, 1.0, "Poisson ratio", scene.pillar.nu,
          "a bonded layer yields by what its volume changes"};
}

// The second-order part of a rod's stress is 2.3 times its strain (models/scene/README.md).
EffectEstimate finite_strain_estimate(const LayerScene& scene) {
  const double strain = layer_strain(scene);
  return {EffectRole::kOutside, 2.3 * strain, "strain", strain,
          "small strains are assumed; not in the error"};
}

// A face without ends cannot follow a shape everywhere; for a shape of given width the scene may
// request it.
EffectEstimate contact_estimate(const LayerScene& scene) {
  const EffectRole role = scene.width_m > 0.0 ? EffectRole::kOptional : EffectRole::kNeeded;
  EffectEstimate estimate{role, 1.0, "", 0.0,
                          "where the shape does not touch, the face is not pulled"};
  estimate.declared_off = kPrescribed;
  return estimate;
}

}  // namespace

const EffectOn<LayerScene>& effect_on_layer(const Effect& effect) {
  using Layer = EffectOn<LayerScene>;
  static const std::map<std::string, Layer> kOnLayers = {
      {"relaxation", {relaxation_estimate}},
      {"incompressibility", {incompressibility_estimate}},
      {"film_compliance", {film_compliance_estimate}},
      {"piezo_coupling", {piezo_coupling_estimate}},
      {"finite_strain", {finite_strain_estimate}},
      {"contact", {contact_estimate, [](LayerScene& scene) { scene.feels_contact = false; }}},
      {"leakage", {absent<"faces without charge, before any leaks in">}},
      {"three_dimensional", {[](const LayerScene& scene) -> EffectEstimate {
         if (scene.is_plane()) return {.reason = "a section of a layer that is endless along y"};
         return {EffectRole::kNeeded, 1.0, "", 0.0, "the face has two directions"};
       }}}};
  static const Layer kNoPart = {absent<"has no part in a layer">};
  const auto found = kOnLayers.find(effect.name);
  return found == kOnLayers.end() ? kNoPart : found->second;
}

}  // namespace viscard
