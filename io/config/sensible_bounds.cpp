#include "io/config/sensible_bounds.h"

#include "io/config/config_fields.h"
#include "models/maths/text_of_number.h"

#include <stdexcept>
#include <vector>

namespace viscard {
namespace {

// The bounds of one kind of quantity, in its unit.
struct Bounds {
  double lowest, highest;
  const char* unit;
  const char* lowest_text;
  const char* highest_text;
};

constexpr double kMonth_s = 30.0 * 86400.0;
constexpr Bounds kModulus{100.0, 1e12, "Pa", "100 Pa", "1 TPa"};
constexpr Bounds kTemperature{-200.0, 1000.0, "degC", "-200 degC", "1000 degC"};
constexpr Bounds kDensity{0.0, 3e4, "kg/m3", "0", "30000 kg/m3"};
constexpr Bounds kShare{0.0, 1.0, "", "0", "1"};
constexpr Bounds kTip{1e-6, 0.1, "m", "1 um", "100 mm"};
constexpr Bounds kThickness{1e-6, 1.0, "m", "1 um", "1 m"};
constexpr Bounds kDepth{0.0, 0.05, "m", "0", "50 mm"};
constexpr Bounds kDistance{0.0, 1.0, "m", "0", "1 m"};
constexpr Bounds kSpeed{1e-9, 0.2, "m/s", "1 nm/s", "200 mm/s"};
constexpr Bounds kForce{0.0, 1e4, "N", "0", "10 kN"};
constexpr Bounds kDuration{1e-3, kMonth_s, "s", "1 ms", "30 days (2592000 s)"};
constexpr Bounds kHold{0.0, kMonth_s, "s", "0", "30 days (2592000 s)"};
constexpr Bounds kTravel{1e-6, 2.0, "m", "1 um", "2 m"};
constexpr Bounds kPeriod{0.01, 3600.0, "s", "10 ms", "1 h"};
// "1 degC" is a temperature, 274.15 K, and no difference.
constexpr Bounds kDrift{0.01, 50.0, "K", "0.01 K", "50 K"};
constexpr Bounds kRate{0.01, 1e5, "Hz", "0.01 Hz", "100 kHz"};

struct CheckedValue {
  std::string key;  // "ramp.hold"; an entry of a list by its number: "levels.2"
  double value;
  const Bounds& bounds;
  const char* example;
};

std::string place(const std::string& name, const std::string& toml, const std::string& key) {
  const int line = line_of_key(toml, key);
  return name + (line > 0 ? ":" + std::to_string(line) : "") + ": ";
}

void refuse_outside(const std::vector<CheckedValue>& values, const std::string& toml,
                    const std::string& name) {
  for (const auto& [key, value, bounds, example] : values) {
    if (value >= bounds.lowest && value <= bounds.highest) continue;
    const std::string unit = *bounds.unit != '\0' ? std::string(" ") + bounds.unit : "";
    throw std::runtime_error(place(name, toml, key) + key + " is " + text_of(value) + unit +
                             "; expected " + bounds.lowest_text + " to " + bounds.highest_text +
                             ", such as " + example + ". Is its unit missing or wrong?");
  }
}

}  // namespace

void refuse_senseless(const RigConfig& rig, const std::string& toml, const std::string& name) {
  refuse_outside({{"stage.travel", rig.stage.travel_m, kTravel, "\"10 mm\""},
                  {"load_cell.expected_rate", rig.load_cell.expected_rate_Hz, kRate, "\"80 Hz\""},
                  {"thermometer.period", rig.thermometer.period_s, kPeriod, "\"1 s\""},
                  {"thermometer.drift_limit", rig.thermometer.drift_limit_K, kDrift, "\"1 K\""}},
                 toml, name);
}

void refuse_senseless(const TestPlan& plan, const std::string& toml, const std::string& name) {
  std::vector<CheckedValue> values{
      {"approach.speed", plan.approach_speed_m_s, kSpeed, "\"0.05 mm/s\""},
      {"approach.limit", plan.approach_limit_m, kDistance, "\"5 mm\""},
      {"approach.contact_force", plan.contact_force_N, kForce, "\"10 mN\""},
      {"approach.gap", plan.gap_m, kDepth, "\"20 um\""},
      {"approach.baseline", plan.baseline_s, kHold, "\"10 s\""},
      {"ramp.depth", plan.depth_m, kDepth, "\"0.13 mm\""},
      {"ramp.duration", plan.ramp_s, kDuration, "\"1 s\""},
      {"ramp.hold", plan.hold_s, kHold, "\"60 s\""},
      {"recovery.unload_speed", plan.unload_speed_m_s, kSpeed, "\"4 mm/s\""},
      {"recovery.hold", plan.recovery_s, kHold, "\"20 s\""},
      {"retract.speed", plan.retract_speed_m_s, kSpeed, "\"1 mm/s\""},
      {"retract.distance", plan.retract_m, kDistance, "\"0.5 mm\""},
      {"preload.force", plan.preload_N, kForce, "\"20 mN\""},
      {"preload.hold", plan.preload_s, kHold, "\"10 s\""},
      {"creep.force", plan.creep.force_N, kForce, "\"1 N\""},
      {"creep.duration", plan.creep.ramp_s, kDuration, "\"1 s\""},
      {"creep.hold", plan.creep.hold_s, kHold, "\"120 s\""},
      {"creep.depth_limit", plan.creep.depth_limit_m, kDepth, "\"0.3 mm\""},
      {"cycles.depth", plan.cycles.depth_m, kDepth, "\"0.1 mm\""},
      {"cycles.duration", plan.cycles.ramp_s, kDuration, "\"1 s\""},
      {"cycles.hold", plan.cycles.hold_s, kHold, "\"5 s\""},
      {"cycles.rest", plan.cycles.rest_s, kHold, "\"5 s\""},
      {"staircase.depth", plan.staircase.depth_m, kDepth, "\"0.1 mm\""},
      {"staircase.duration", plan.staircase.step_s, kDuration, "\"0.5 s\""},
      {"staircase.hold", plan.staircase.hold_s, kHold, "\"10 s\""},
      {"compliance.force", plan.compliance.force_N, kForce, "\"1.5 N\""},
      {"compliance.hold", plan.compliance.hold_s, kHold, "\"2 s\""}};
  for (std::size_t i = 0; i < plan.levels.size(); ++i) {
    const DepthLevel& level = plan.levels[i];
    const std::string entry = "levels." + std::to_string(i + 1);
    values.push_back({entry + ".depth", level.depth_m, kDepth, "\"0.1 mm\""});
    values.push_back({entry + ".duration", level.ramp_s, kDuration, "\"1 s\""});
    values.push_back({entry + ".hold", level.hold_s, kHold, "\"30 s\""});
  }
  refuse_outside(values, toml, name);
}

void refuse_senseless(const Specimen& specimen, const std::string& toml, const std::string& name) {
  if (trimmed(specimen.id).empty()) {
    throw std::runtime_error(place(name, toml, "id") +
                             "id is empty; expected a name for the specimen, such as "
                             "\"pdms-1to10-a\": results are filed under it");
  }
  std::vector<CheckedValue> values{
      {"modulus_guess", specimen.modulus_guess_Pa, kModulus, "\"2 MPa\""},
      {"relaxation_guess", specimen.relaxation_guess, kShare, "0.05"},
      {"temperature", specimen.temperature_C, kTemperature, "\"23 degC\""},
      {"density", specimen.rho_kg_m3, kDensity, "\"965 kg/m3\""}};
  const PunchContact& contact = specimen.contact;
  if (contact.shape == TipShape::kFlat) {
    values.push_back({"contact.punch_diameter", 2.0 * contact.punch_radius_m, kTip, "\"4.4 mm\""});
  } else if (contact.shape == TipShape::kSphere) {
    values.push_back({"tip.radius", contact.punch_radius_m, kTip, "\"2 mm\""});
  }
  if (contact.layer_thickness_m > 0.0) {
    values.push_back(
        {"contact.layer_thickness", contact.layer_thickness_m, kThickness, "\"11 mm\""});
  }
  refuse_outside(values, toml, name);
}

}  // namespace viscard
