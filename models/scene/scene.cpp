#include "models/scene/scene.h"

#include "models/array/plane/check_array.h"
#include "models/pillar/analyses/buckling_limit.h"
#include "models/pillar/analyses/check_pillar.h"
#include "models/pillar/analyses/pillar_results.h"

namespace viscard {
namespace {

void refuse(const PillarScene& scene) {
  refuse_beyond_buckling(scene);
}
void refuse(const ArrayScene&) {}

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
  std::visit([](const auto& body) { refuse(body); }, scene);
}

std::vector<std::string> result_names(const Scene& scene) {
  return std::visit([](const auto& body) { return result_names(body); }, scene);
}

}  // namespace viscard
