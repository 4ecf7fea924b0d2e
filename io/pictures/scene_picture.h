#pragma once

#include "models/scene/scene.h"

#include <string>

namespace viscard {

// The geometry of a scene to scale, as an SVG document: pillars, film, electrodes and ground, the
// held bottom, the load, with their sizes. A section along the axis.
std::string svg_from_scene(const Scene& scene, const std::string& title);

}  // namespace viscard
