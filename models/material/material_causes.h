#pragma once

#include "models/material/series_directions.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace viscard {

inline constexpr const char* kRandomPart = "random part";
inline constexpr const char* kSystematicPart = "systematic part";  // the cause follows

// Why a material is not known exactly: directions that one cause moves it along, independent of each
// other and of those of other causes.
struct MaterialCause {
  std::string name;
  std::vector<SeriesDirection> directions;
};

// The causes that the material states. Its covariance is left out where it does not apply (has_band in
// series_band.h); then `left_out` says why, and otherwise is empty.
struct MaterialCauses {
  std::vector<MaterialCause> causes;
  std::string left_out;
};
MaterialCauses causes_of(const Material& material);

// The material moved along all directions of the causes, one standard deviate for each in their order.
Material material_at(const Material& material, const std::vector<MaterialCause>& causes,
                     const Eigen::VectorXd& deviates);

}  // namespace viscard
