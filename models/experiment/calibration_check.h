#pragma once

#include "models/experiment/rig_config.h"

#include <optional>
#include <string>

namespace viscard {

// The largest reading of either sign that reaches the computer, in the unit of the calibration.
struct ReadingSpan {
  double largest = 10.0;
  bool is_known = false;      // stated, or of a converter; otherwise that of a usual amplifier
  bool is_in_newton = false;  // of an instrument that sends forces; it has no converter to saturate
};
// From [load_cell]: span, or 2^23 counts of volts_per_count if that is at most 10 V, or +-10 V.
ReadingSpan reading_span(const LoadCellConfig& cell);

struct CalibrationFault {
  std::string key;   // of [calibration]
  std::string text;  // what is wrong, with value and limit, and what to do
};

// Why no load cell behind such a converter can have this calibration: a gain that is negative, that drives
// the converter beyond its span before the capacity is reached, or that uses next to nothing of the
// span; weights above the capacity; a zero outside the span. Nothing if it can. Every door asks this function:
// `viscard calibrate`, the rig file with its records, and the preflight of each capture.
std::optional<CalibrationFault> calibration_fault(const LoadCellCalibration& calibration,
                                                  const ReadingSpan& span);

// Why no frame has this stiffness (0: rigid), or "".
std::string frame_fault(const FrameConfig& frame);

// Why no stage counts its depth so badly (depth_relative_u), or "".
std::string depth_fault(const StageConfig& stage);

// Throws std::invalid_argument "calibration.KEY ..." for such a rig, and whatever validate() refuses.
void require_believable(const RigConfig& rig);

}  // namespace viscard
