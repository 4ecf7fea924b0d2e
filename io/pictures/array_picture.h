#pragma once

#include "models/array/plane/array_scene.h"

#include <string>

namespace viscard {

// svg_from_scene() of a row of pillars. A long row shows its first and last pillars; an endless one
// shows, faint, the neighbours beyond the mirrors.
std::string svg_from_array(const ArrayScene& scene, const std::string& title);

}  // namespace viscard
