#include "io/config/config_file.h"

#include "io/basics/atomic_file.h"
#include "io/basics/file_kind.h"
#include "io/config/config_fields.h"
#include "io/config/config_show.h"
#include "io/config/performance_file.h"
#include "models/experiment/calibration_check.h"
#include "models/experiment/converter.h"
#include "models/experiment/test_phases.h"
#include "models/material/liquid.h"
#include "models/maths/text_of_number.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace viscard {
namespace {

constexpr double kVoltsPerCount = 20.0 / 16777216.0;  // 24 bits from -10 V to +10 V

// Reads the fields, then checks them together; an error of the checks gets the file's name. Returns
// whether the file says plausible = "off".
template <typename Config>
bool fill_from_toml(const std::string& text, const std::string& name, Plausible judged,
                    void (*show)(FieldVisitor&, Config&), void (*check)(Config&), Config& config) {
  const bool accepts_any = read_toml_fields(
      text, name, [&](FieldVisitor& fields) { show(fields, config); }, {.plausible = judged});
  try {
    check(config);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(name + ": " + error.what());
  }
  return accepts_any;
}

// The same of a rig, a test or a specimen, which keep it.
template <typename Config>
Config config_from_toml(const std::string& text, const std::string& name, Plausible judged,
                        Config config, void (*show)(FieldVisitor&, Config&),
                        void (*check)(Config&)) {
  config.accepts_implausible = fill_from_toml(text, name, judged, show, check, config);
  return config;
}

// Reads a file about to be used.
template <typename Config>
Config read_for_use(const std::filesystem::path& path, Plausible judged,
                    Config (*from_toml)(const std::string&, const std::string&, Plausible)) {
  Config config = from_toml(read_file(path), path.string(), judged);
  config.accepts_implausible |= judged == Plausible::kOff;
  return config;
}

template <typename Config>
std::string toml_from_config(Config config, void (*show)(FieldVisitor&, Config&)) {
  const std::string head = config.accepts_implausible ? "plausible = \"off\"\n" : "";
  return head + toml_from_fields([&](FieldVisitor& fields) { show(fields, config); });
}

// The counts of a named converter have one meaning. A capture stores both keys.
void convert_counts(LoadCellConfig& cell) {
  if (cell.converter.empty()) return;
  const double volts = volts_per_count_of(cell);
  const bool is_given = cell.volts_per_count != kVoltsPerCount;
  if (is_given && std::abs(cell.volts_per_count / volts - 1.0) > 1e-9) {
    throw std::invalid_argument("load_cell.volts_per_count is " + text_of(cell.volts_per_count) +
                                " V, but converter, gain and reference make " + text_of(volts) +
                                " V. Omit volts_per_count");
  }
  cell.volts_per_count = volts;
}

void check_rig(RigConfig& rig) {
  convert_counts(rig.load_cell);
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
        "recovery.unload_to_fraction is 1, so the specimen would not be unloaded; use 0.1, or set "
        "recovery.hold = 0 to omit the recovery");
  }
  phases_from_plan(plan);
}

void check_specimen(Specimen& specimen) {
  validate(specimen.contact);
}

void check_truth(EmulatedTruth& truth) {
  if (std::isnan(truth.material.nu)) truth.material.nu = truth.contact.poisson_ratio;
  validate(truth.contact);
  validate_solid(truth.material);
}

// The section [performance] is not part of a rig; performance_from_toml() reads it.
void show_rig_file(FieldVisitor& fields, RigConfig& rig) {
  show_rig(fields, rig);
  RigPerformance performance;
  fields.section("performance", [&](FieldVisitor& inner) { show_performance(inner, performance); });
}

}  // namespace

namespace {

// depth_relative_u: of a text that does not state it.
RigConfig rig_of(const std::string& text, const std::string& name, Plausible judged,
                 double depth_relative_u) {
  RigConfig unset;
  unset.load_cell.volts_per_count = kVoltsPerCount;
  unset.stage.depth_relative_u = depth_relative_u;
  return read_as(FileKind::kRig, text, name, [&] {
    return config_from_toml<RigConfig>(text, name, judged, unset, show_rig_file, check_rig);
  });
}

// Of a file that describes a bench; a capture keeps what was stated when it was made.
RigConfig bench_from_toml(const std::string& text, const std::string& name, Plausible judged) {
  return rig_of(text, name, judged, kScrewDepth_u);
}

}  // namespace

RigConfig rig_from_toml(const std::string& text, const std::string& name, Plausible judged) {
  return rig_of(text, name, judged, 0.0);
}

TestPlan test_from_toml(const std::string& text, const std::string& name, Plausible judged) {
  return read_as(FileKind::kRigTest, text, name, [&] {
    return config_from_toml<TestPlan>(text, name, judged, {}, show_test, check_test);
  });
}

Specimen specimen_from_toml(const std::string& text, const std::string& name, Plausible judged) {
  return read_as(FileKind::kSpecimen, text, name, [&] {
    return config_from_toml<Specimen>(text, name, judged, {}, show_specimen, check_specimen);
  });
}

EmulatedTruth truth_from_toml(const std::string& text, const std::string& name, Plausible judged) {
  EmulatedTruth unset;
  unset.material.nu = std::numeric_limits<double>::quiet_NaN();
  return read_as(FileKind::kTruth, text, name, [&] {
    fill_from_toml(text, name, judged, show_truth, check_truth, unset);
    return unset;
  });
}

namespace {

// Checks that apply only to a rig about to be used; the rig in an old capture is read without them.
// toml, name: of the file that holds the calibration.
void check_before_use(const RigConfig& rig, const std::string& toml, const std::string& name) {
  const LoadCellConfig& cell = rig.load_cell;
  const bool may_count = has_converter(cell) && cell.unit.empty() && cell.line_format != "volts";
  if (may_count && cell.volts_per_count == 0.0) {
    throw std::runtime_error(name +
                             ": load_cell.volts_per_count is 0, so counts cannot be converted to a "
                             "force; give the volts "
                             "of one count, or omit the key for 20 V / 2^24");
  }
  try {
    validate_dates(rig.calibration);
    validate_date("frame.date", rig.frame.date);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(name + ": " + error.what());
  }
  if (const std::string fault = depth_fault(rig.stage); !fault.empty()) {
    const std::string key = "stage.depth_relative_u";
    const int line = line_of_key(toml, key);
    throw std::runtime_error(name + (line > 0 ? ":" + std::to_string(line) : "") + ": " + key +
                             ": " + fault);
  }
  if (!rig.calibration.file.empty()) return;  // the record is checked once it has been read
  if (const auto fault = calibration_fault(rig.calibration, reading_span(cell))) {
    const std::string key = "calibration." + fault->key;
    const int line = line_of_key(toml, key);
    throw std::runtime_error(name + (line > 0 ? ":" + std::to_string(line) : "") + ": " + key +
                             ": " + fault->text);
  }
}

}  // namespace

namespace {

void check_frame(const FrameConfig& frame, const std::string& toml, const std::string& name) {
  const std::string fault = frame_fault(frame);
  if (fault.empty()) return;
  const int line = line_of_key(toml, "frame.stiffness");
  throw std::runtime_error(name + (line > 0 ? ":" + std::to_string(line) : "") +
                           ": frame.stiffness: " + fault);
}

}  // namespace

namespace {

// Notes where the file states the ports.
void place_ports(const std::string& text, const std::filesystem::path& path, RigConfig& rig) {
  const auto place = [&](const std::string& key) {
    return path.string() + ":" + std::to_string(line_of_key(text, key));
  };
  rig.stage.port_place = place("stage.port");
  rig.load_cell.port_place = place("load_cell.port");
  rig.thermometer.port_place = place("thermometer.port");
}

}  // namespace

RigConfig read_rig_to_calibrate(const std::filesystem::path& path, Plausible judged) {
  RigConfig rig = read_for_use(path, judged, bench_from_toml);
  place_ports(read_file(path), path, rig);
  LoadCellCalibration& calibration = rig.calibration;
  const std::filesystem::path record = path.parent_path() / calibration.file;
  if (calibration.file.empty() || calibration.capacity_N > 0.0 || !exists(record)) return rig;
  const CalibrationRecord before = read_calibration(record);
  if (before.calibration) calibration.capacity_N = before.calibration->capacity_N;
  return rig;
}

namespace {

// Checks a rig and takes what the records that it names have. text: of the rig file.
RigConfig with_records(RigConfig rig, const std::string& text, const std::filesystem::path& path) {
  check_before_use(rig, text, path.string());
  place_ports(text, path, rig);
  const std::filesystem::path folder = path.parent_path();
  // The record replaces the whole section, so that its numbers are never mixed with older ones.
  // Only the rated load of the cell may be in the rig file alone.
  if (!rig.calibration.file.empty()) {
    const double capacity_N = rig.calibration.capacity_N;
    const std::string file = rig.calibration.file;
    const std::filesystem::path where =
        path_at_key(text, path, "calibration.file", file, FileKind::kCalibration);
    const CalibrationRecord record = read_calibration(where);
    if (!record.calibration) {
      throw std::runtime_error((folder / rig.calibration.file).string() +
                               ": has no [calibration]; make one with viscard calibrate");
    }
    rig.calibration = *record.calibration;
    if (rig.calibration.capacity_N == 0.0) rig.calibration.capacity_N = capacity_N;
    validate(rig.calibration);
    check_before_use(rig, read_file(where), where.string());
  }
  if (rig.frame.file.empty()) {
    check_frame(rig.frame, text, path.string());
  } else {
    const std::filesystem::path where =
        path_at_key(text, path, "frame.file", rig.frame.file, FileKind::kCalibration);
    const CalibrationRecord record = read_calibration(where);
    if (!record.frame) {
      throw std::runtime_error((folder / rig.frame.file).string() +
                               ": has no [frame]; make one with viscard calibrate --compliance");
    }
    rig.frame = *record.frame;
    check_frame(rig.frame, read_file(where), where.string());
  }
  return rig;
}

}  // namespace

RigConfig read_rig(const std::filesystem::path& path, Plausible judged) {
  return with_records(read_for_use(path, judged, bench_from_toml), read_file(path), path);
}

RigConfig rig_of_text(const std::string& text, const std::filesystem::path& path,
                      Plausible judged) {
  return with_records(bench_from_toml(text, path.string(), judged), text, path);
}

void require_id(const Specimen& specimen, const std::string& toml, const std::string& name) {
  if (!trimmed(specimen.id).empty()) return;
  throw std::runtime_error(name + ":" + std::to_string(line_of_key(toml, "id")) +
                           ": id is empty; expected a name for the specimen, such as "
                           "\"pdms-1to10-a\": results are filed under it");
}

TestPlan read_test(const std::filesystem::path& path, Plausible judged) {
  return read_for_use(path, judged, test_from_toml);
}
Specimen read_specimen(const std::filesystem::path& path, Plausible judged) {
  const Specimen specimen = read_for_use(path, judged, specimen_from_toml);
  require_id(specimen, read_file(path), path.string());
  return specimen;
}
EmulatedTruth read_truth(const std::filesystem::path& path) {
  return truth_from_toml(read_file(path), path.string(), Plausible::kScene);
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

}  // namespace viscard
