#pragma once

#include "models/array/layer/layer_scene.h"

namespace viscard {

// The contact area on the face, found on coarse grids: the square that later grids divide, and the
// depth there.
struct LayerWindow {
  LayerGrid grid;  // count is that of the coarse grid
  double depth_m = 0.0;
  double indentation_m = 0.0;  // depth below the first touch, or a little more
  double force_N = 0.0;        // about; 0: the shape touches nothing
};

// Widest window, in thicknesses of the layer.
constexpr double kWidestWindow = 100.0;

// Throws SceneMistake for a shape that touches more than the widest window, has nothing under it to bear
// its force, or would press the layer flat.
LayerWindow layer_window(const LayerScene& scene, const LayerWaves& waves);

}  // namespace viscard
