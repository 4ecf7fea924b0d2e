#include "models/scene/scene.h"

#include "models/array/layer/simulate_layer.h"
#include "models/array/plane/simulate_array.h"
#include "models/array/space/simulate_space.h"
#include "models/pillar/analyses/buckling_limit.h"
#include "models/pillar/analyses/creep_buckling.h"
#include "models/pillar/analyses/simulate_pillar.h"

namespace viscard {
namespace {

// One pillar of an array that stays under a pressure.
std::string note_of_one(PillarScene one, double pressure_Pa) {
  one.drive = StaticDrive{.pressure_Pa = pressure_Pa};
  return creep_buckling_note(one);
}

std::string creep_buckling_note(const ArrayScene& row) {
  if (row.load != ArrayLoad::kPressure || !std::holds_alternative<RowStatic>(row.drive)) return "";
  return note_of_one(single_pillar(row), row.load_Pa);
}

std::string creep_buckling_note(const SpaceScene& array) {
  for (const SpaceClass& one : classes_of(array)) {
    std::string note = note_of_one(single_pillar(array, one), array.pressure_Pa);
    if (!note.empty()) return note;
  }
  return "";
}

// A layer does not buckle.
std::string creep_buckling_note(const LayerScene&) {
  return "";
}

}  // namespace

SceneCommon& common(Scene& scene) {
  return std::visit([](auto& body) -> SceneCommon& { return body; }, scene);
}

const SceneCommon& common(const Scene& scene) {
  return std::visit([](const auto& body) -> const SceneCommon& { return body; }, scene);
}

const char* kind_of(const Scene& scene) {
  return std::visit([](const auto& body) { return body.kKind; }, scene);
}

const ToleranceRange& tolerances_of(const Scene& scene) {
  return std::visit([](const auto& body) -> const ToleranceRange& { return body.kTolerances; },
                    scene);
}

void validate(const Scene& scene) {
  std::visit([](const auto& body) { validate(body); }, scene);
}

void refuse_beyond_buckling(const Scene& scene) {
  if (const auto* pillar = std::get_if<PillarScene>(&scene)) refuse_beyond_buckling(*pillar);
}

std::string creep_buckling_note(const Scene& scene) {
  return std::visit([](const auto& body) { return creep_buckling_note(body); }, scene);
}

void refuse_buckling_in_creep(const Scene& scene) {
  if (const auto* pillar = std::get_if<PillarScene>(&scene)) refuse_buckling_in_creep(*pillar);
}

std::vector<std::string> result_names(const Scene& scene) {
  return std::visit([](const auto& body) { return result_names(body); }, scene);
}

}  // namespace viscard
