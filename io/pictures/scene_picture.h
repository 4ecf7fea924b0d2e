#pragma once

#include "models/scene/scene.h"

#include <string>

namespace viscard {

// The geometry of a scene to scale, as an SVG document: pillars, film, electrodes and ground, the
// held bottom, the load, with their sizes. A section along the axis, or a view from above.
std::string svg_from_scene(const Scene& scene, const std::string& title);

std::string svg_from_scene(const PillarScene& scene, const std::string& title);
// A long row shows its first and last pillars, an endless one faint neighbours beyond the mirrors.
std::string svg_from_scene(const ArrayScene& scene, const std::string& title);
// An array in the plane as seen from above: film, pillars, those that bear the load, a length to scale.
std::string svg_from_scene(const SpaceScene& scene, const std::string& title);
// A layer as a section through the middle of the shape, with its electrodes.
std::string svg_from_scene(const LayerScene& scene, const std::string& title);

// "a rigid sphere of radius 3650 um pressed 10 um deep"
std::string words_of_press(const ShapePress& press);

}  // namespace viscard
