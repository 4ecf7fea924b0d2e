#include "io/pictures/scene_picture.h"

namespace viscard {

std::string svg_from_scene(const Scene& scene, const std::string& title) {
  return std::visit([&](const auto& body) { return svg_from_scene(body, title); }, scene);
}

}  // namespace viscard
