// Any bytes are read as a joint fit or refused by one exception with a text. A fit that can be read
// gives the materials that cards and predictions take from it, and its band over the ratios, or one
// exception with a text; it is written and read again unchanged.
#include "io/materials/material_file.h"

#include <cstdint>
#include <stdexcept>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace viscard;
  RatioFit fit;
  try {
    fit = ratio_fit_from_json({reinterpret_cast<const char*>(data), size}, "fuzz");
  } catch (const std::runtime_error&) {
    return 0;
  }
  const auto& ratios = fit.best.ratios;
  for (const double ratio : {ratios.front(), 0.5 * (ratios.front() + ratios.back()), 1e3}) {
    try {
      material_at_ratio(fit, ratio, /*may_extrapolate=*/true);
    } catch (const std::invalid_argument&) {
    }
  }
  try {
    ratio_band(fit, 5);
  } catch (const std::invalid_argument&) {
  }
  std::string written;
  try {
    written = json_from_ratio_fit(fit);
  } catch (const std::invalid_argument&) {  // a material that cannot be
    return 0;
  }
  if (json_from_ratio_fit(ratio_fit_from_json(written, "written")) != written) __builtin_trap();
  return 0;
}
