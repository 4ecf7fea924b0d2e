#pragma once

#include "io/flow/design/requirements.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// A dimension of a scene that alone, all others fixed, makes a requirement pass.
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

// The quantity with one dimension changed; not answered where there is no such scene.
using QuantityAt = std::function<RequiredValue(double value_m)>;

// The value nearest to `from_m`, between a quarter and four times it, at which the quantity keeps the
// limit for certain; nothing if none was found. The quantity is taken to cross the limit once between
// values that differ by a factor of two, and a direction in which it moves away from the limit twice is
// given up.
std::optional<Remedy> seek_remedy(double from_m, double limit, bool is_upper,
                                  const QuantityAt& quantity_at);

}  // namespace viscard
