#pragma once

#include "io/flow/fit_file.h"
#include "models/material/material.h"

#include <optional>
#include <string>

namespace viscard {

// Properties of the material that the fit does not determine.
struct MaterialRequest {
  std::optional<double> nu;         // none: that of the specimen, or 0.495 without punch geometry
  std::optional<double> rho_kg_m3;  // none: that of the specimen
  std::string command;
  std::string created_at;  // ISO 8601, empty in reproducible mode
};

// Makes the material of one fitted capture or table, with its name, validity window and provenance
// (including the SHA-256 of the raw file). Throws std::invalid_argument if the fit gave
// stiffnesses, std::runtime_error if the raw file cannot be read.
Material material_from_fitted(const FittedFile& fitted, const MaterialRequest& request);

}  // namespace viscard
