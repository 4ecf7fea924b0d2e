#pragma once

#include "io/cli/fit/fit_input.h"
#include "models/material/material.h"

#include <optional>
#include <string>

namespace viscard {

// What a fit itself cannot know of the material.
struct FittedMaterialWords {
  std::optional<double> nu;         // none: the specimen's, or 0.495 without punch geometry
  std::optional<double> rho_kg_m3;  // none: the specimen's
  std::string command;
  std::string created_at;  // ISO 8601, empty in reproducible mode
};

// The material file of one fitted capture or table: name, validity window, and where it comes from
// with the SHA-256 of the raw file. Throws std::invalid_argument if the fit is of stiffnesses,
// std::runtime_error if the raw file cannot be read any more.
Material material_from_fitted(const FittedFile& fitted, const FittedMaterialWords& words);

// The time now in UTC, "2026-01-05T10:00:00Z".
std::string now_iso8601();

}  // namespace viscard
