#pragma once

#include "models/experiment/calibration.h"
#include "models/experiment/emulated_specimen.h"
#include "models/experiment/rig_config.h"
#include "models/experiment/specimen.h"
#include "models/experiment/test_plan.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// The TOML files a user writes; commented examples are data/demo/*.toml. A quantity is a number in
// SI or a string with its unit ("40 um"). What is missing keeps the default of its struct; a key
// without a sensible default must be there. All readers throw std::runtime_error: file, line, key,
// what is expected, and for an unknown key the nearest known one.
RigConfig read_rig(const std::filesystem::path& path);
TestPlan read_test(const std::filesystem::path& path);
Specimen read_specimen(const std::filesystem::path& path);
EmulatedTruth read_truth(const std::filesystem::path& path);

// A record of `viscard calibrate`, which a rig file names by file = "..." under [calibration] or
// [frame] (beside the rig file). Keys as in those sections, and [[budget]].
struct CalibrationRecord {
  std::optional<LoadCellCalibration> calibration;
  std::optional<FrameConfig> frame;
  std::vector<UncertaintyRow> budget;
};
CalibrationRecord read_calibration(const std::filesystem::path& path);
CalibrationRecord calibration_from_toml(const std::string& text, const std::string& name);
std::string toml_from_calibration(const CalibrationRecord& record);

// The same from text; name stands for the file in messages.
RigConfig rig_from_toml(const std::string& text, const std::string& name);
TestPlan test_from_toml(const std::string& text, const std::string& name);
Specimen specimen_from_toml(const std::string& text, const std::string& name);
EmulatedTruth truth_from_toml(const std::string& text, const std::string& name);

// And back: reading the text gives the same struct, every double exactly.
std::string toml_from_rig(const RigConfig& rig);
std::string toml_from_test(const TestPlan& plan);
std::string toml_from_specimen(const Specimen& specimen);

}  // namespace viscard
