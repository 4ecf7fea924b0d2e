// Any bytes are read as a scene or refused by one exception with a text; a scene that can be read is
// planned or refused likewise. Files that a scene names are looked for beside data/scenes, where the
// seeds come from.
#include "io/scenes/scene_file.h"
#include "models/scene/plan.h"

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace viscard;
  try {
    const SceneFile file =
        scene_from_toml({reinterpret_cast<const char*>(data), size}, "data/scenes/fuzz.toml");
    const ScenePlan plan = plan_effects(file.scene);
    if (plan.effects.empty() || !std::isfinite(plan.left_out)) __builtin_trap();
  } catch (const std::runtime_error& error) {
    if (std::string(error.what()).empty()) __builtin_trap();
  } catch (const SceneMistake& error) {
    if (std::string(error.what()).empty()) __builtin_trap();
  }
  return 0;
}
