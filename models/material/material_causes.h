#pragma once

#include "models/material/series_directions.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace viscard {

inline constexpr const char* kRandomPart = "random part";
inline constexpr const char* kSystematicPart = "systematic part";  // the cause follows

// Causes of the uncertainty of a material: directions along which one cause moves it, independent
// of each other and of those of other causes.
struct MaterialCause {
  std::string name;
  std::vector<SeriesDirection> directions;
};

// The causes that the material states. If its covariance does not apply, it is left out (has_band
// in series_band.h), and `left_out` gives the reason; otherwise `left_out` is empty.
struct MaterialCauses {
  std::vector<MaterialCause> causes;
  std::string left_out;
};
MaterialCauses causes_of(const Material& material);

// The material moved along all directions of the causes, with one standard normal number for each
// direction in their order.
Material material_at(const Material& material, const std::vector<MaterialCause>& causes,
                     const Eigen::VectorXd& deviates);

}  // namespace viscard
