#include "io/flow/design/requirement_kinds.h"

#include "io/basics/atomic_file.h"
#include "io/basics/file_kind.h"
#include "io/basics/words.h"
#include "io/flow/design/required_values.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {

const std::vector<RequirementKind>& requirement_kinds() {
  using R = Requirements;
  static const std::vector<RequirementKind> kKinds = {
      {"pillars_per_tactel", "1", false, "pillars in one tactel", &R::pillars_per_tactel,
       required_pillars_per_tactel},
      {"resolved_wavelength", "m", true, "shortest wavelength that is read",
       &R::resolved_wavelength_m, required_wavelength},
      {"largest_pressure", "Pa", false, "mean pressure before buckling", &R::largest_pressure_Pa,
       required_pressure},
      {"largest_force", "N", false, "force on a tactel before buckling", &R::largest_force_N,
       required_force},
      {"bandwidth", "Hz", false, "frequency up to which it follows", &R::bandwidth_Hz,
       required_bandwidth},
      {"lowest_frequency", "Hz", true, "frequency from which it follows", &R::lowest_frequency_Hz,
       required_lowest_frequency},
      {"hysteresis", "1", true, "loop of force against depth", &R::hysteresis, required_hysteresis},
      {"nonlinearity", "1", true, "deviation from a straight line", &R::nonlinearity,
       required_nonlinearity},
      {"pressure_resolution", "Pa", true, "pressure on a pillar that equals the noise",
       &R::pressure_resolution_Pa, required_pressure_resolution},
      {"force_resolution", "N", true, "force on a pillar that equals the noise",
       &R::force_resolution_N, required_force_resolution},
      {"crosstalk", "1", true, "largest reading of a neighbour", &R::crosstalk, required_crosstalk},
      {"crosstalk_all", "1", true, "what all neighbours add", &R::crosstalk_all,
       required_crosstalk_all},
      {"pressure_per_kelvin", "Pa/K", true, "pressure that a warm touch reads as",
       &R::pressure_per_kelvin_Pa_K, required_pressure_per_kelvin},
      {"voltage_per_pressure", "V/Pa", false, "reading per mean pressure",
       &R::voltage_per_pressure_V_Pa, required_voltage_per_pressure},
      {"collapse_margin", "1", false, "longest pillar that stands over its length",
       &R::collapse_margin, required_collapse_margin},
      {"slip_latency", "s", true, "time until the readings show that a top slides",
       &R::slip_latency_s, required_slip_latency},
      {"texture_amplitude", "m", true, "smallest ridge that is read while it slides by",
       &R::texture_amplitude_m, required_texture_amplitude}};
  return kKinds;
}

void show_requirements(FieldVisitor& v, Requirements& r) {
  v.text({"name", "human hand"}, r.name);
  v.quantity({.key = "tactel_area", .unit = "m2", .range = Range::kPositive}, r.tactel_area_m2);
  v.text({"top", "free"}, r.top);
  v.quantity({.key = "bandwidth_error", .range = Range::kPositive}, r.bandwidth_error);
  v.quantity({.key = "linear_to", .unit = "Pa", .range = Range::kPositive}, r.linear_to_Pa);
  v.quantity({.key = "texture_wavelength", .unit = "m", .range = Range::kPositive},
             r.texture_wavelength_m);
  v.quantity({.key = "texture_speed", .unit = "m/s", .range = Range::kPositive},
             r.texture_speed_m_s);
  for (const RequirementKind& kind : requirement_kinds()) {
    v.quantity({.key = kind.key, .unit = kind.unit, .range = Range::kPositive}, r.*kind.limit);
  }
}

void validate(const Requirements& r) {
  const std::vector<std::string> tops = {"free", "plate"};
  if (std::find(tops.begin(), tops.end(), r.top) == tops.end()) {
    throw std::invalid_argument("require.top cannot be '" + r.top + "'" +
                                did_you_mean(r.top, tops) + " There are: " + listed(tops));
  }
  const auto& kinds = requirement_kinds();
  const bool is_empty = std::all_of(kinds.begin(), kinds.end(), [&](const RequirementKind& kind) {
    return std::isnan(r.*kind.limit);
  });
  if (!is_empty) return;
  std::vector<std::string> keys;
  for (const RequirementKind& kind : kinds) keys.emplace_back(kind.key);
  throw std::invalid_argument(
      "nothing is required; put limits under [require], such as crosstalk = "
      "\"0.1 %\". There are: " +
      listed(keys));
}

Requirements requirements_from_toml(const std::string& text, const std::string& name) {
  Requirements requirements;
  read_toml_fields(text, name, [&](FieldVisitor& v) {
    v.section("require", [&](FieldVisitor& r) { show_requirements(r, requirements); });
  });
  try {
    validate(requirements);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(name + ": " + error.what());
  }
  return requirements;
}

Requirements read_requirements(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  return read_as(FileKind::kRequirements, text, path.string(),
                 [&] { return requirements_from_toml(text, path.string()); });
}

}  // namespace viscard
