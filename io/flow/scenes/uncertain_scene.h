#pragma once

#include "io/scenes/scene_file.h"
#include "models/uncertainty/linear_propagation.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// Effects that the plan has chosen for a scene.
EffectChoices chosen_effects(const Scene& scene);

// The uncertain inputs of a scene: its uncertain quantities, and the uncertainty that the file of
// its pillars' material states. Each input is one cause; causes are independent of each other.
class UncertainScene {
 public:
  // `text` stands in the file `path`; `file` is what was read from it. The tolerance is that of `file`.
  // Throws std::runtime_error if the file holds a sweep or nothing uncertain.
  UncertainScene(SceneFile file, std::string text, std::filesystem::path path);

  const SceneFile& file() const { return file_; }
  const std::vector<UncertainInput>& inputs() const { return inputs_; }
  // Description of an input in words: "40 um +- 1 um".
  const std::vector<std::string>& descriptions() const { return descriptions_; }
  const std::vector<std::string>& notes() const { return notes_; }

  // The scene at standard deviates, with the effects that the file states. Throws as scene_from_toml() does.
  Scene scene_at(const Eigen::VectorXd& deviates) const;
  // The scene at standard deviates, which its plan reduces with the effects of `file`'s scene, also
  // where their estimates differ. Throws as scene_from_toml() and plan_effects() do.
  Scene reduced_at(const Eigen::VectorXd& deviates) const;

 private:
  void add_quantities();
  void add_material();

  SceneFile file_;
  std::string text_;
  std::filesystem::path path_;
  EffectChoices choices_;  // the plan's
  std::vector<UncertainInput> inputs_;
  std::vector<std::string> descriptions_, notes_;
};

}  // namespace viscard
