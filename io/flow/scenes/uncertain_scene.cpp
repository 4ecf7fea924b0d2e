#include "io/flow/scenes/uncertain_scene.h"

#include "models/material/material_causes.h"
#include "models/scene/plan.h"
#include "models/uncertainty/uncertain_number.h"

#include <fmt/format.h>

#include <map>
#include <stdexcept>

namespace viscard {

EffectChoices chosen_effects(const Scene& scene) {
  EffectChoices choices = common(scene).effects;
  for (const SceneEffect& effect : plan_effects(scene).effects) {
    if (effect.is_choice) choices[effect.name] = effect.on ? EffectChoice::kOn : EffectChoice::kOff;
  }
  return choices;
}

namespace {

std::string description_of(const MaterialCause& cause, const Material& material) {
  if (cause.name.rfind(kSystematicPart, 0) != 0) {
    return "covariance of the moduli and relaxation times";
  }
  const PronySeries series = young_series(material);
  const double E0_Pa = instantaneous_modulus_Pa(series);
  const double moved_Pa = instantaneous_modulus_Pa(moved(series, cause.directions.front(), 1.0));
  return fmt::format("E0 moves by {:.2g} %, the shares that relax with it",
                     100.0 * std::abs(moved_Pa / E0_Pa - 1.0));
}

const char* material_word(const Scene& scene) {
  return std::holds_alternative<LayerScene>(scene) ? "materials.layer" : "materials.pillar";
}

}  // namespace

UncertainScene::UncertainScene(SceneFile file, std::string text, std::filesystem::path path)
    : file_(std::move(file)), text_(std::move(text)), path_(std::move(path)) {
  if (!file_.sweep.is_empty()) {
    throw std::runtime_error(path_.string() +
                             ": a scene with a [sweep] has no uncertainty; leave the sweep out");
  }
  add_quantities();
  add_material();
  if (inputs_.empty()) {
    // What the file of the material lacks, which add_material() has noted.
    const std::string why = notes_.empty() ? "" : " (" + notes_.front() + ")";
    throw std::runtime_error(
        path_.string() + ": nothing is uncertain" + why +
        ". Write a quantity as \"40 um +- 1 um\", or name a linear material file that "
        "viscard fit has written");
  }
  choices_ = chosen_effects(file_.scene);
}

void UncertainScene::add_quantities() {
  for (const UncertainField& one : file_.uncertain) {
    inputs_.push_back({one.key, 1, one.number.spread == Spread::kUniform});
    descriptions_.push_back(one.text);
  }
}

void UncertainScene::add_material() {
  const MaterialCauses& material = file_.material_causes;
  const std::string word = material_word(file_.scene);
  for (const MaterialCause& cause : material.causes) {
    inputs_.push_back(
        {word + ": " + cause.name, static_cast<Eigen::Index>(cause.directions.size())});
    descriptions_.push_back(description_of(cause, common(file_.scene).pillar));
  }
  if (!material.left_out.empty()) notes_.push_back(word + ": " + material.left_out);
}

Scene UncertainScene::scene_at(const Eigen::VectorXd& deviates) const {
  std::map<std::string, double> values;
  Eigen::Index next = 0;
  for (const UncertainField& one : file_.uncertain) {
    values[one.key] = value_at(one.number, deviates[next++]);
  }
  // The file was judged at its values; an error bar may reach beyond a range.
  Scene scene = scene_from_toml(text_, path_, values, Plausible::kOff).scene;
  SceneCommon& parts = common(scene);
  parts.tolerance = common(file_.scene).tolerance;
  parts.pillar = material_at(parts.pillar, file_.material_causes.causes,
                             deviates.tail(deviates.size() - next));
  return scene;
}

Scene UncertainScene::reduced_at(const Eigen::VectorXd& deviates) const {
  Scene scene = scene_at(deviates);
  common(scene).effects = choices_;
  refuse_beyond_buckling(scene);
  return plan_effects(scene).reduced;
}

}  // namespace viscard
