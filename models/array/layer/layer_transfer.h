#pragma once

#include "models/answer/scene_answer.h"
#include "models/array/layer/layer_scene.h"
#include "models/array/layer/layer_waves.h"

#include <string>
#include <vector>

namespace viscard {

// How waves of pressure on the face of a layer, along axis 1 of the film, appear at the film (eq.
// L7). k = 0: a uniform pressure.
struct LayerTransfer {
  double reading_V_Pa = 0.0;  // of a point, per pressure
  double sinking_m_Pa = 0.0;
};
LayerTransfer layer_transfer(const LayerWaves& waves, double k_1_m);

// The wavelength at which the reading per pressure is half of that of a uniform pressure.
double half_wavelength_m(const LayerWaves& waves);

// Effect of a rough surface (eq. T4) that touches everywhere: the correlation between the readings
// at points of the film and the mean heights over tops of the radius (in a section half of the
// width), and the rms reading per rms height.
struct LayerBlurring {
  double correlation = 0.0;
  double voltage_V_m = 0.0;
};
LayerBlurring layer_blurring(const LayerWaves& waves, bool is_plane, double correlation_length_m,
                             double radius_m);

// Adds those of these that the scene asks for: the results half_wavelength, blurring and
// voltage_per_rms_height (the last two under a rough shape), and the curves voltage_per_pressure
// and voltage_per_height over the wavelength.
void add_transfer(const LayerScene& scene, const LayerWaves& waves, SceneAnswer& answer);
std::vector<std::string> transfer_names(const LayerScene& scene);

}  // namespace viscard
