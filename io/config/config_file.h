#pragma once

#include "models/experiment/calibration.h"
#include "models/experiment/emulated_specimen.h"
#include "models/experiment/rig_config.h"
#include "models/experiment/specimen.h"
#include "models/experiment/test_plan.h"
#include "models/quantities/plausible.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// Reads the TOML files that a user writes; commented examples are data/demo/*.toml. A quantity is a
// number in SI or a string with its unit ("40 um"). A missing key keeps the default of its struct;
// keys without a sensible default are required. All readers throw std::runtime_error with file,
// line, key and the expected value, and for an unknown key the nearest known key. Values that no bench
// can have are refused too, unless the file or `judged` accepts them.
// A rig file without depth_relative_u gets kScrewDepth_u.
RigConfig read_rig(const std::filesystem::path& path, Plausible judged = Plausible::kMeasured);
// The same of a text that shall stand in that file.
RigConfig rig_of_text(const std::string& text, const std::filesystem::path& path, Plausible judged);
// The same before its load cell is calibrated: the gain may be a guess, and the record that the file names
// need not exist yet. Only the capacity is taken from an older record.
RigConfig read_rig_to_calibrate(const std::filesystem::path& path,
                                Plausible judged = Plausible::kMeasured);
TestPlan read_test(const std::filesystem::path& path, Plausible judged = Plausible::kMeasured);
Specimen read_specimen(const std::filesystem::path& path, Plausible judged = Plausible::kMeasured);
EmulatedTruth read_truth(const std::filesystem::path& path);

// Ends the id of a calibration or frame whose record was edited since it was written.
inline constexpr const char* kEditedMark = " (edited)";

// A record written by `viscard calibrate`. A rig file names it by file = "..." in [calibration] or
// [frame]; the path is relative to the rig file. It has the keys of those sections, and [[budget]].
struct CalibrationRecord {
  std::optional<LoadCellCalibration> calibration;
  std::optional<FrameConfig> frame;
  std::vector<UncertaintyRow> budget;
};
CalibrationRecord read_calibration(const std::filesystem::path& path);
CalibrationRecord calibration_from_toml(const std::string& text, const std::string& name);
std::string toml_from_calibration(const CalibrationRecord& record);

// The same from text; messages show name in place of the file. Old captures are read as they are: without
// depth_relative_u they state none.
RigConfig rig_from_toml(const std::string& text, const std::string& name,
                        Plausible judged = Plausible::kOff);
TestPlan test_from_toml(const std::string& text, const std::string& name,
                        Plausible judged = Plausible::kOff);
Specimen specimen_from_toml(const std::string& text, const std::string& name,
                            Plausible judged = Plausible::kOff);
EmulatedTruth truth_from_toml(const std::string& text, const std::string& name,
                              Plausible judged = Plausible::kOff);

// Throws std::runtime_error for a specimen without a name; results are filed under it.
void require_id(const Specimen& specimen, const std::string& toml, const std::string& name);

// The text that reads back as the same struct, every double exactly.
std::string toml_from_rig(const RigConfig& rig);
std::string toml_from_test(const TestPlan& plan);
std::string toml_from_specimen(const Specimen& specimen);

}  // namespace viscard
