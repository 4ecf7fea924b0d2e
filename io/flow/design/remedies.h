#pragma once

#include "io/flow/design/requirements.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// A dimension of a scene whose change alone makes a requirement pass.
struct Remedy {
  std::string key;      // "geometry.spacing"
  double from_m = 0.0;  // what the scene has
  double to_m = 0.0;    // the nearest value that passes, to three digits
  RequiredValue found;  // the quantity there
};

// The dimensions of a scene that single changes may concern: keys and values (m).
struct SceneDimension {
  std::string key;
  double value_m = 0.0;
};
// Those lengths of pillars, gaps, films and electrodes that stand in the file.
std::vector<SceneDimension> dimensions_of(const std::string& text,
                                          const std::filesystem::path& path);

// The quantity with one dimension changed; "not answered" if such a scene does not exist.
using QuantityAt = std::function<RequiredValue(double value_m)>;

// The value nearest to `from_m`, between a quarter and four times it, at which the quantity
// certainly keeps the limit; nothing if none was found. Assumes that the quantity crosses the limit
// at most once between values that differ by a factor of two. A direction in which the quantity
// moves away from the limit twice is given up.
std::optional<Remedy> seek_remedy(double from_m, double limit, bool is_upper,
                                  const QuantityAt& quantity_at);

}  // namespace viscard
