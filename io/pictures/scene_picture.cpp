#include "io/pictures/scene_picture.h"

#include "io/pictures/array_picture.h"
#include "io/pictures/pillar_picture.h"

namespace viscard {
namespace {

std::string svg_from(const PillarScene& scene, const std::string& title) {
  return svg_from_pillar(scene, title);
}
std::string svg_from(const ArrayScene& scene, const std::string& title) {
  return svg_from_array(scene, title);
}

}  // namespace

std::string svg_from_scene(const Scene& scene, const std::string& title) {
  return std::visit([&](const auto& body) { return svg_from(body, title); }, scene);
}

}  // namespace viscard
