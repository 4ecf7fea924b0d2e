#include "io/basics/atomic_file.h"
#include "io/basics/file_kind.h"
#include "io/basics/inputs.h"
#include "io/basics/sha256.h"
#include "io/config/config_file.h"
#include "io/config/config_show.h"

#include <stdexcept>

namespace viscard {
namespace {

using enum Range;

void show_budget(FieldVisitor& fields, std::vector<UncertaintyRow>& budget) {
  fields.list(
      "budget", budget.size(), [&](std::size_t size) { budget.assign(size, {}); },
      [&](FieldVisitor& inner, std::size_t i) {
        inner.text({"source", "weights", true}, budget[i].source);
        inner.quantity({"relative_u", "1", kNotNegative, true}, budget[i].relative_u);
        inner.text({"how", "as stated"}, budget[i].how);
      });
}

void show_frame_numbers(FieldVisitor& fields, FrameConfig& frame) {
  fields.quantity({"stiffness", "N/m"}, frame.stiffness_N_m);
  fields.quantity({"stiffness_relative_u", "1", kNotNegative}, frame.stiffness_relative_u);
  fields.text({"id", "bench 2026-11"}, frame.id);
  fields.text({"date", "2026-11-21"}, frame.date);
}

constexpr const char* kBodySum = "body_sha256";

// The first line of a record states the sum of what follows. False for a record without it, which was written
// by hand or before. The line ends of Windows are no edit; the writer escapes any other carriage return.
bool is_edited_since(std::string text) {
  std::erase(text, '\r');
  const std::string begin = kBodySum + std::string(" = \"");
  const std::size_t end = text.find('\n');
  if (!text.starts_with(begin) || end == std::string::npos)
    return text.find(kBodySum) != std::string::npos;
  return text.substr(0, end) != begin + sha256_of_text(text.substr(end + 1)) + "\"";
}

// A record has one of the two sections, and the contributions to its uncertainty.
void show_record(FieldVisitor& fields, LoadCellCalibration& calibration, FrameConfig& frame,
                 std::vector<UncertaintyRow>& budget) {
  std::string sum;
  fields.text({kBodySum, "64 digits"}, sum);
  fields.section("calibration", [&](FieldVisitor& inner) {
    LoadCellCalibration found = calibration;
    found.file = "-";  // a record need not have this section, so none of its keys is required
    show_calibration(inner, found, false);
    found.file.clear();
    calibration = found;
  });
  fields.section("frame", [&](FieldVisitor& inner) { show_frame_numbers(inner, frame); });
  show_budget(fields, budget);
}

}  // namespace

void show_calibration(FieldVisitor& fields, LoadCellCalibration& calibration, bool knows_gain) {
  fields.text({"file", "cell-7.calibration.toml"}, calibration.file);
  const bool is_elsewhere = !calibration.file.empty();
  if (knows_gain && calibration.volts_per_newton == 0.0) calibration.volts_per_newton = 1.0;
  fields.quantity(
      {.key = "volts_per_newton", .unit = "V/N", .is_required = !is_elsewhere && !knows_gain},
      calibration.volts_per_newton);
  fields.quantity({"volts_per_newton_u", "V/N", kNotNegative}, calibration.volts_per_newton_u);
  fields.quantity({"zero_volts", "V"}, calibration.zero_volts);
  fields.quantity({"capacity", "N", kPositive, !is_elsewhere}, calibration.capacity_N);
  fields.text({"id", "cell-7 2026-11"}, calibration.id);
  fields.text({"date", "2026-11-21"}, calibration.date);
  fields.text({"valid_until", "2027-11-21"}, calibration.valid_until);
  fields.quantity({"nonlinearity", "1", kNotNegative}, calibration.nonlinearity);
  fields.quantity({"hysteresis", "1", kNotNegative}, calibration.hysteresis);
  fields.quantity({"repeatability", "1", kNotNegative}, calibration.repeatability);
  fields.quantity({"largest_force", "N", kNotNegative}, calibration.largest_force_N);
  fields.quantity({"common_u", "1", kNotNegative}, calibration.common_u);
  fields.quantity({"shape_u", "1", kNotNegative}, calibration.shape_u);
  fields.quantity({"curvature_u", "1", kNotNegative}, calibration.curvature_u);
  fields.quantity({"curvature_at", "N", kNotNegative}, calibration.curvature_at_N);
}

CalibrationRecord calibration_from_toml(const std::string& text, const std::string& name) {
  CalibrationRecord record;
  LoadCellCalibration calibration;
  FrameConfig frame;
  frame.stiffness_N_m = -1.0;
  read_toml_fields(text, name, [&](FieldVisitor& fields) {
    show_record(fields, calibration, frame, record.budget);
  });
  if (calibration.volts_per_newton != 0.0) {
    if (calibration.id.empty() || calibration.date.empty()) {
      throw std::runtime_error(name + ": the calibration has no id or no date; give both");
    }
    record.calibration = calibration;
  }
  if (frame.stiffness_N_m > 0.0) record.frame = frame;
  return record;
}

CalibrationRecord read_calibration(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  CalibrationRecord record = read_as(FileKind::kCalibration, text, path.string(),
                                     [&] { return calibration_from_toml(text, path.string()); });
  if (!is_edited_since(text)) return record;
  note_input(path,
             "the record was edited since viscard calibrate wrote it; calibrate again, or, if the "
             "numbers are yours, "
             "remove its line body_sha256");
  // It goes wherever the name of the calibration goes: into captures, fits and reports.
  if (record.calibration) record.calibration->id += kEditedMark;
  if (record.frame) record.frame->id += kEditedMark;
  return record;
}

std::string toml_from_calibration(const CalibrationRecord& record) {
  const std::string body = toml_from_fields([&](FieldVisitor& fields) {
    LoadCellCalibration calibration = record.calibration.value_or(LoadCellCalibration{});
    FrameConfig frame = record.frame.value_or(FrameConfig{});
    std::vector<UncertaintyRow> budget = record.budget;
    if (record.calibration) {
      fields.section("calibration",
                     [&](FieldVisitor& inner) { show_calibration(inner, calibration, false); });
    }
    if (record.frame) {
      fields.section("frame", [&](FieldVisitor& inner) { show_frame_numbers(inner, frame); });
    }
    show_budget(fields, budget);
  });
  return kBodySum + std::string(" = \"") + sha256_of_text(body) + "\"\n" + body;
}

}  // namespace viscard
