#include "io/config/config_file.h"

#include "io/basics/atomic_file.h"
#include "io/config/config_fields.h"
#include "io/config/config_show.h"
#include "models/experiment/test_phases.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace viscard {
namespace {

using enum Range;
constexpr double kVoltsPerCount = 20.0 / 16777216.0;  // 24 bits from -10 V to +10 V

void show_stage(FieldVisitor& fields, StageConfig& stage) {
  fields.text({"driver", "grbl"}, stage.driver);
  fields.text({"port", "/dev/serial/by-id/usb-..."}, stage.port);
  show_integer(fields, "baud", 300, 4'000'000, stage.baud);
  std::string axis(1, stage.axis);
  fields.text({"axis", "Z"}, axis);
  if (axis.size() != 1) {
    throw std::runtime_error("stage.axis is '" + axis + "'; expected one letter, such as \"Z\"");
  }
  stage.axis = axis.front();
  show_integer(fields, "toward_specimen", -1, 1, stage.toward_specimen);
  fields.quantity({"travel", "m", kPositive}, stage.travel_m);
  fields.quantity({"backlash", "m", kNotNegative}, stage.backlash_m);
  fields.boolean("home", stage.home);
  fields.quantity({"microstep", "m", kNotNegative}, stage.microstep_m);
  show_integer(fields, "device", 1, 99, stage.device);
  show_integer(fields, "axis_number", 1, 9, stage.axis_number);
}

void show_load_cell(FieldVisitor& fields, LoadCellConfig& cell) {
  fields.text({"driver", "hx711"}, cell.driver);
  fields.text({"port", "/dev/serial/by-id/usb-..."}, cell.port);
  show_integer(fields, "baud", 300, 4'000'000, cell.baud);
  fields.text({"line_format", "auto"}, cell.line_format);
  fields.quantity({"expected_rate", "Hz", kPositive}, cell.expected_rate_Hz);
  fields.quantity({"volts_per_count", "V"}, cell.volts_per_count);
  fields.boolean("compression_is_positive", cell.compression_is_positive);
  fields.text({"dialect", "34401a"}, cell.dialect);
  fields.text({"unit", "N"}, cell.unit);
  fields.text({"framing", "8N1"}, cell.framing);
}

void show_rig(FieldVisitor& fields, RigConfig& rig) {
  fields.text({"name", "bench 1"}, rig.name);
  fields.quantity({"clock_speed", "1", kPositive}, rig.clock_speed);
  fields.section("stage", [&](FieldVisitor& inner) { show_stage(inner, rig.stage); });
  fields.section("load_cell", [&](FieldVisitor& inner) { show_load_cell(inner, rig.load_cell); });
  const LoadCellConfig& cell = rig.load_cell;
  const bool knows_gain = cell.driver == "mark10" || cell.driver == "sauter" || !cell.unit.empty();
  fields.section("calibration", [&](FieldVisitor& inner) {
    show_calibration(inner, rig.calibration, knows_gain);
  });
  fields.section("frame", [&](FieldVisitor& inner) {
    inner.text({"file", "bench.frame.toml"}, rig.frame.file);
    // Required: a frame taken as rigid without a word about it can halve the modulus.
    inner.quantity({.key = "stiffness",
                    .unit = "N/m",
                    .range = kPositive,
                    .is_required = rig.frame.file.empty(),
                    .word = "rigid",
                    .word_value = 0.0},
                   rig.frame.stiffness_N_m);
    inner.quantity({"stiffness_relative_u", "1", kNotNegative}, rig.frame.stiffness_relative_u);
    inner.text({"id", "bench 2026-11"}, rig.frame.id);
    inner.text({"date", "2026-11-21"}, rig.frame.date);
  });
  fields.section("safety", [&](FieldVisitor& inner) {
    inner.quantity({"warn_fraction", "1", kFraction}, rig.safety.warn_fraction);
    inner.quantity({"soft_fraction", "1", kFraction}, rig.safety.soft_fraction);
    inner.quantity({"hard_fraction", "1", kFraction}, rig.safety.hard_fraction);
  });
}

// [tip]: left out for a flat punch.
void show_tip(FieldVisitor& fields, PunchContact& contact) {
  std::string shape = contact.shape == TipShape::kSphere ? "sphere"
                      : contact.shape == TipShape::kCone ? "cone"
                                                         : "flat";
  fields.text({"shape", "flat"}, shape);
  if (shape != "flat" && shape != "sphere" && shape != "cone") {
    throw std::runtime_error("tip.shape is '" + shape +
                             "'; expected \"flat\", \"sphere\" or \"cone\"");
  }
  contact.shape = shape == "sphere" ? TipShape::kSphere
                  : shape == "cone" ? TipShape::kCone
                                    : TipShape::kFlat;
  fields.boolean("sticking", contact.is_sticking);
  if (shape == "sphere") {
    fields.quantity({"radius", "m", kPositive, true}, contact.punch_radius_m);
    fields.quantity({"radius_u", "m", kNotNegative}, contact.punch_radius_u_m);
  }
  if (shape == "cone") {
    fields.quantity({"half_angle", "rad", kPositive, true}, contact.half_angle_rad);
    fields.quantity({"half_angle_u", "rad", kNotNegative}, contact.half_angle_u_rad);
  }
}

void show_contact(FieldVisitor& fields, PunchContact& contact) {
  if (contact.shape == TipShape::kFlat) {
    fields.quantity({"punch_diameter", "m", kPositive, true, 2.0}, contact.punch_radius_m);
    fields.quantity(
        {.key = "punch_diameter_u", .unit = "m", .range = kNotNegative, .written_per_value = 2.0},
        contact.punch_radius_u_m);
  }
  // Required: a half-space taken for granted overestimates the modulus of a thin layer.
  fields.quantity({.key = "layer_thickness",
                   .unit = "m",
                   .range = kPositive,
                   .is_required = true,
                   .word = "half-space",
                   .word_value = 0.0},
                  contact.layer_thickness_m);
  fields.quantity({"layer_thickness_u", "m", kNotNegative}, contact.layer_thickness_u_m);
  fields.quantity({.key = "poisson_ratio", .range = kNotNegative, .is_required = true},
                  contact.poisson_ratio);
  fields.quantity({"poisson_ratio_u", "1", kNotNegative}, contact.poisson_ratio_u);
}

void show_specimen(FieldVisitor& fields, Specimen& specimen) {
  fields.text({"id", "pdms-1to10-a", true}, specimen.id);
  fields.text({"material", "PDMS"}, specimen.material);
  fields.quantity({"mixing_ratio", "1", kNotNegative}, specimen.mixing_ratio);
  fields.quantity({"modulus_guess", "Pa", kPositive, true}, specimen.modulus_guess_Pa);
  fields.quantity({"density", "kg/m3", kNotNegative}, specimen.rho_kg_m3);
  fields.quantity({"temperature", "degC"}, specimen.temperature_C);
  fields.section("tip", [&](FieldVisitor& inner) { show_tip(inner, specimen.contact); });
  fields.section("contact", [&](FieldVisitor& inner) { show_contact(inner, specimen.contact); });
}

void show_truth_material(FieldVisitor& fields, Material& material) {
  fields.text({"name", "PDMS 1:10"}, material.name);
  fields.quantity({"E0", "Pa", kPositive, true}, material.E0_Pa);
  fields.quantity({"poisson_ratio", "1"}, material.nu);
  fields.quantity({"density", "kg/m3", kNotNegative}, material.rho_kg_m3);
  fields.list(
      "terms", material.terms.size(),
      [&](std::size_t size) {
        material.terms.assign(size, {0.0, std::numeric_limits<double>::quiet_NaN(), 0.0});
      },
      [&](FieldVisitor& inner, std::size_t i) {
        MaterialTerm& term = material.terms[i];
        inner.quantity({"g", "1", kNotNegative, true}, term.g);
        inner.quantity({"k", "1", kNotNegative}, term.k);
        inner.quantity({"tau", "s", kPositive, true}, term.tau_s);
        if (std::isnan(term.k)) term.k = term.g;  // constant Poisson ratio unless said otherwise
      });
}

void show_truth(FieldVisitor& fields, EmulatedTruth& truth) {
  show_integer(fields, "seed", 0, std::numeric_limits<std::int64_t>::max(), truth.seed);
  fields.section("contact", [&](FieldVisitor& inner) { show_contact(inner, truth.contact); });
  fields.section("material",
                 [&](FieldVisitor& inner) { show_truth_material(inner, truth.material); });
  fields.section("rig", [&](FieldVisitor& inner) {
    inner.quantity({.key = "frame_stiffness",
                    .unit = "N/m",
                    .range = kPositive,
                    .word = "rigid",
                    .word_value = 0.0},
                   truth.frame_stiffness_N_m);
    inner.quantity({"surface_position", "m", kNotNegative}, truth.surface_position_m);
    inner.quantity({"force_noise", "N", kNotNegative}, truth.force_noise_N);
    inner.quantity({"force_offset", "N"}, truth.force_offset_N);
    inner.quantity({"drift_relative", "1/s"}, truth.drift_relative_per_s);
    inner.quantity({"cell_gain", "V/N", kNotNegative}, truth.cell_gain);
    inner.quantity({"cell_full_scale", "N", kPositive}, truth.cell_full_scale_N);
    inner.quantity({"cell_nonlinearity", "1"}, truth.cell_nonlinearity);
    inner.quantity({"cell_hysteresis", "1"}, truth.cell_hysteresis);
    inner.quantity({"overload", "N", kNotNegative}, truth.overload_N);
    inner.quantity({"sample_rate", "Hz", kPositive}, truth.sample_rate_Hz);
    inner.quantity({"steps", "1/m", kPositive}, truth.steps_per_m);
    inner.quantity({"acceleration", "m/s2", kPositive}, truth.acceleration_m_s2);
    inner.quantity({"max_rate", "m/s", kPositive}, truth.max_rate_m_s);
  });
}

// Reads, then checks what no single key can tell; errors of the checks get the file's name.
template <typename Config>
Config config_from_toml(const std::string& text, const std::string& name, Config config,
                        void (*show)(FieldVisitor&, Config&), void (*check)(Config&)) {
  read_toml_fields(text, name, [&](FieldVisitor& fields) { show(fields, config); });
  try {
    check(config);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(name + ": " + error.what());
  }
  return config;
}

template <typename Config>
std::string toml_from_config(Config config, void (*show)(FieldVisitor&, Config&)) {
  return toml_from_fields([&](FieldVisitor& fields) { show(fields, config); });
}

void check_rig(RigConfig& rig) {
  if (rig.stage.toward_specimen == 0) {
    throw std::invalid_argument(
        "stage.toward_specimen is 0; expected 1 or -1, the sign of machine motion that presses "
        "into the specimen");
  }
  if (rig.calibration.file.empty()) validate(rig.calibration);
  const SafetyConfig& safety = rig.safety;
  if (!(safety.warn_fraction <= safety.soft_fraction &&
        safety.soft_fraction < safety.hard_fraction)) {
    throw std::invalid_argument(
        "safety: expected warn_fraction <= soft_fraction < hard_fraction, such as 0.7, 0.8, 0.95");
  }
}

void check_test(TestPlan& plan) {
  if (plan.unload_to_fraction >= 1.0 && plan.recovery_s > 0.0) {
    throw std::invalid_argument(
        "recovery.unload_to_fraction is 1, so nothing would be unloaded; use 0.1, or recovery.hold "
        "= 0 to leave it out");
  }
  phases_from_plan(plan);
}

void check_specimen(Specimen& specimen) {
  validate(specimen.contact);
}

void check_truth(EmulatedTruth& truth) {
  if (std::isnan(truth.material.nu)) truth.material.nu = truth.contact.poisson_ratio;
  validate(truth.contact);
  validate(truth.material);
}

}  // namespace

RigConfig rig_from_toml(const std::string& text, const std::string& name) {
  RigConfig unset;
  unset.load_cell.volts_per_count = kVoltsPerCount;
  return config_from_toml<RigConfig>(text, name, unset, show_rig, check_rig);
}

TestPlan test_from_toml(const std::string& text, const std::string& name) {
  return config_from_toml<TestPlan>(text, name, {}, show_test, check_test);
}

Specimen specimen_from_toml(const std::string& text, const std::string& name) {
  return config_from_toml<Specimen>(text, name, {}, show_specimen, check_specimen);
}

EmulatedTruth truth_from_toml(const std::string& text, const std::string& name) {
  EmulatedTruth unset;
  unset.material.nu = std::numeric_limits<double>::quiet_NaN();
  return config_from_toml<EmulatedTruth>(text, name, unset, show_truth, check_truth);
}

// What a rig about to be used must say; a record of an old run is read without.
void check_before_use(const RigConfig& rig, const std::string& name) {
  const LoadCellConfig& cell = rig.load_cell;
  const bool may_count = cell.driver == "hx711" && cell.unit.empty() && cell.line_format != "volts";
  if (may_count && cell.volts_per_count == 0.0) {
    throw std::runtime_error(
        name +
        ": load_cell.volts_per_count is 0, so that counts make no force; give the volts of one "
        "count, or leave it out for 20 V / 2^24");
  }
  try {
    validate_dates(rig.calibration);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(name + ": " + error.what());
  }
}

RigConfig read_rig(const std::filesystem::path& path) {
  RigConfig rig = rig_from_toml(read_file(path), path.string());
  check_before_use(rig, path.string());
  const std::filesystem::path folder = path.parent_path();
  // What a record says replaces all of the section, so that it cannot be mixed with older numbers;
  // only the cell's rating may stand in the rig file alone.
  if (!rig.calibration.file.empty()) {
    const double capacity_N = rig.calibration.capacity_N;
    const std::string file = rig.calibration.file;
    const CalibrationRecord record = read_calibration(folder / rig.calibration.file);
    if (!record.calibration) {
      throw std::runtime_error((folder / rig.calibration.file).string() +
                               ": holds no [calibration]; make one with viscard calibrate");
    }
    rig.calibration = *record.calibration;
    if (rig.calibration.capacity_N == 0.0) rig.calibration.capacity_N = capacity_N;
    validate(rig.calibration);
    check_before_use(rig, (folder / file).string());
  }
  if (!rig.frame.file.empty()) {
    const CalibrationRecord record = read_calibration(folder / rig.frame.file);
    if (!record.frame) {
      throw std::runtime_error((folder / rig.frame.file).string() +
                               ": holds no [frame]; make one with viscard calibrate --compliance");
    }
    rig.frame = *record.frame;
  }
  return rig;
}
TestPlan read_test(const std::filesystem::path& path) {
  return test_from_toml(read_file(path), path.string());
}
Specimen read_specimen(const std::filesystem::path& path) {
  return specimen_from_toml(read_file(path), path.string());
}
EmulatedTruth read_truth(const std::filesystem::path& path) {
  return truth_from_toml(read_file(path), path.string());
}

std::string toml_from_rig(const RigConfig& rig) {
  return toml_from_config(rig, show_rig);
}
std::string toml_from_test(const TestPlan& plan) {
  return toml_from_config(plan, show_test);
}
std::string toml_from_specimen(const Specimen& specimen) {
  return toml_from_config(specimen, show_specimen);
}
std::string toml_from_truth(const EmulatedTruth& truth) {
  return toml_from_config(truth, show_truth);
}

}  // namespace viscard
