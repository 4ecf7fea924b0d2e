#pragma once

#include "io/plots/plot.h"
#include "models/sensor/sensor_design.h"

#include <string>
#include <utility>
#include <vector>

namespace viscard {

// File names and pictures: buckling and matting limits of the length against spacing, the widest
// flaw-insensitive pillar against the adhesion strength, sensitivity and pitch against spacing, and
// the admissible lengths at the design's diameter and around it.
std::vector<std::pair<std::string, Plot>> design_pictures(const SensorGeometry& geometry,
                                                          const SensorMaterial& material,
                                                          const SensorRequirements& requirements);

}  // namespace viscard
