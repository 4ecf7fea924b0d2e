#pragma once

#include "models/answer/scene_answer.h"
#include "models/array/layer/layer_contact.h"
#include "models/array/layer/layer_scene.h"

#include <vector>

namespace viscard {

// What the electrodes of a layer read, as factors of the potential in Fourier space (eq. L6).
class LayerReadings {
 public:
  static constexpr std::size_t kPoint = 0;  // the potential at a point

  explicit LayerReadings(const LayerScene& scene);

  const std::vector<LayerKernel::Reading>& factors() const { return factors_; }
  // Relative error of the readings: equipotential electrodes whose charges influence each other, and
  // whose charge is that under a film without its layer.
  double error() const { return error_; }

  // Adds the voltages that the scene asks for. The error is relative to the potential under the contact.
  void add(const LayerPressure& pressed, const LayerKernel& kernel, double relative_error,
           SceneAnswer& answer) const;

 private:
  void add_equipotential();
  double quarter_mean_V(const LayerPressure& pressed, const LayerKernel& kernel, double x_m,
                        double y_m, int quarter) const;

  const LayerScene* scene_;
  std::vector<LayerKernel::Reading> factors_;
  double error_ = 0.0;
};

}  // namespace viscard
