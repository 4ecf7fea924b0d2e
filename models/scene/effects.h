#pragma once

#include "models/answer/effect_estimate.h"
#include "models/scene/scene.h"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <vector>

namespace viscard {

// An effect on one kind of scene.
template <typename Body>
struct EffectOn {
  EffectEstimate (*estimate)(const Body& scene);
  void (*leave_out)(Body& scene) = nullptr;  // for optional effects that are off
  void (*insist)(Body& scene) = nullptr;     // for effects that are forced on
};

// The estimate of an effect that has no part in a kind of scene, by its reason.
template <std::size_t kSize>
struct Reason {
  constexpr Reason(const char (&words)[kSize]) { std::copy_n(words, kSize, text); }  // NOLINT
  char text[kSize] = {};
};
template <Reason kReason, typename Body>
EffectEstimate absent(const Body&) {
  return {.reason = kReason.text};
}

// One effect: what it changes, what it costs, and its treatment by each kind of scene.
struct Effect {
  const char* name;  // key in a scene's [effects]
  const char* changes;
  const char* cost;
  std::tuple<EffectOn<PillarScene>, EffectOn<ArrayScene>, EffectOn<SpaceScene>> on;
  // True for a choice between kinds of elements with the same answer; studies leave it to the plan.
  bool is_choice_of_elements = false;
};

// The effects on a layer, most of which have no part in it, stand apart (layer_effects.cpp).
const EffectOn<LayerScene>& effect_on_layer(const Effect& effect);

template <typename Body>
const EffectOn<Body>& effect_on(const Effect& effect) {
  if constexpr (std::is_same_v<Body, LayerScene>) {
    return effect_on_layer(effect);
  } else {
    return std::get<EffectOn<Body>>(effect.on);
  }
}

const std::vector<Effect>& effects();  // all, in the order they are printed

}  // namespace viscard
