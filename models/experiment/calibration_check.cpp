#include "models/experiment/calibration_check.h"

#include "models/maths/text_of_number.h"

#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

constexpr double kHalfOfCodes = 8388608.0;  // 2^23
// A cell that uses the whole span uses a thousandth of it when a column is mV instead of V.
constexpr double kLeastShare = 5e-4;
constexpr double kLeast_V = 1e-4;  // the weakest bridge gives some 0.5 mV at its capacity
constexpr double kGaugeLow = 0.5, kGaugeHigh = 2.0;
constexpr double kRounding = 1e-3;  // a weight of 250 g on a cell of 250 gf

const char* const kThousandTimes =
    "Is a column or a key a thousand times off (kg for g, mV for V)? ";

std::string span_text(const ReadingSpan& span) {
  return text_of(span.largest, 3) +
         (span.is_known ? " V" : " V (assumed, because the converter is not known)");
}

std::optional<CalibrationFault> fault_of_size(const LoadCellCalibration& calibration,
                                              const ReadingSpan& span) {
  const double gain = calibration.volts_per_newton;
  const double full = gain * calibration.capacity_N;
  const std::string key = "volts_per_newton";
  if (span.is_in_newton) {
    if (gain >= kGaugeLow && gain <= kGaugeHigh) return {};
    return CalibrationFault{key, "the gain is " + text_of(gain, 4) +
                                     ", but an instrument that sends forces has a gain near 1 (" +
                                     text_of(kGaugeLow) + " to " + text_of(kGaugeHigh) +
                                     "). Is unit under [load_cell] of the rig file wrong, or a "
                                     "column a thousand times off (kg for g)?"};
  }
  const std::string product = "gain x capacity is " + text_of(gain, 4) + " V/N x " +
                              text_of(calibration.capacity_N, 4) + " N = " + text_of(full, 4) +
                              " V";
  if (full > span.largest) {
    return CalibrationFault{
        key, product + ", above the span of the converter, " + span_text(span) +
                 ": it would reach its end at " + text_of(100.0 * span.largest / full, 2) +
                 " % of the capacity. " + kThousandTimes +
                 "Otherwise correct capacity, or state the span (span under [load_cell] of the "
                 "rig file; --span of viscard calibrate)"};
  }
  const double least = span.is_known ? kLeastShare * span.largest : kLeast_V;
  if (full >= least) return {};
  return CalibrationFault{
      key, product + ", " +
               (span.is_known ? "only " + text_of(100.0 * full / span.largest, 2) +
                                    " % of the span of the converter, " + span_text(span)
                              : "less than any bridge gives") +
               "; at least " + text_of(least, 2) + " V is expected. " + kThousandTimes +
               "Otherwise correct capacity or the span"};
}

}  // namespace

ReadingSpan reading_span(const LoadCellConfig& cell) {
  if (measures_force(cell)) return {.is_in_newton = true};
  if (cell.span_V > 0.0) return {.largest = cell.span_V, .is_known = true};
  const ReadingSpan usual;
  if (has_converter(cell) && cell.line_format != "volts" && cell.volts_per_count != 0.0) {
    const double counts_V = kHalfOfCodes * std::abs(cell.volts_per_count);
    // More than an amplifier can send: the converter has fewer than 24 bits, and how many is unknown.
    if (counts_V <= (1.0 + kRounding) * usual.largest) {
      return {.largest = counts_V, .is_known = true};
    }
  }
  return usual;
}

std::optional<CalibrationFault> calibration_fault(const LoadCellCalibration& calibration,
                                                  const ReadingSpan& span) {
  const double gain = calibration.volts_per_newton;
  if (gain < 0.0) {
    return CalibrationFault{
        "volts_per_newton",
        "the gain is negative, " + text_of(gain, 4) + (span.is_in_newton ? "" : " V/N") +
            ": the reading falls when the load rises. Swap the two signal wires of the cell, or "
            "turn the sign of the readings; a cell that the specimen presses to its negative side "
            "has a positive gain "
            "and compression_is_positive = false under [load_cell] of the rig file"};
  }
  if (calibration.largest_force_N > (1.0 + kRounding) * calibration.capacity_N) {
    return CalibrationFault{
        "largest_force",
        "the largest weight of the calibration, " + text_of(calibration.largest_force_N, 4) +
            " N, is above the capacity of the cell, " + text_of(calibration.capacity_N, 4) +
            " N. Are the masses in kg instead of g? Otherwise use smaller weights, or "
            "correct capacity"};
  }
  if (auto fault = fault_of_size(calibration, span)) return fault;
  if (!span.is_in_newton && !(std::abs(calibration.zero_volts) <= span.largest)) {
    return CalibrationFault{"zero_volts", "the reading without load, " +
                                              text_of(calibration.zero_volts, 4) +
                                              " V, is outside the span of the converter, " +
                                              span_text(span) + ". Is it in mV?"};
  }
  return {};
}

std::string frame_fault(const FrameConfig& frame) {
  constexpr double kSoftest_N_m = 100.0, kStiffest_N_m = 1e9;
  const double stiffness_N_m = frame.stiffness_N_m;
  if (stiffness_N_m == 0.0) return {};
  if (!(stiffness_N_m >= kSoftest_N_m && stiffness_N_m <= kStiffest_N_m)) {
    return "the stiffness of the frame is " + text_of(stiffness_N_m, 4) +
           " N/m; expected 100 N/m to 1e9 N/m, such as \"10 N/mm\". Is a column or a key a "
           "thousand times off (mm for m)?";
  }
  if (frame.stiffness_relative_u < 1.0) return {};
  return "the stiffness of the frame has a relative standard uncertainty of " +
         text_of(frame.stiffness_relative_u, 3) + "; expected a share below 1, such as 0.02";
}

std::string depth_fault(const StageConfig& stage) {
  if (stage.depth_relative_u < 1.0) return {};
  return "the relative standard uncertainty of the depth is " + text_of(stage.depth_relative_u, 3) +
         "; expected a share below 1, such as 0.005";
}

void require_believable(const RigConfig& rig) {
  validate(rig.calibration);
  if (const auto fault = calibration_fault(rig.calibration, reading_span(rig.load_cell))) {
    throw std::invalid_argument("calibration." + fault->key + ": " + fault->text);
  }
  const std::string depth = depth_fault(rig.stage);
  if (!depth.empty()) throw std::invalid_argument("stage.depth_relative_u: " + depth);
  const std::string frame = frame_fault(rig.frame);
  if (!frame.empty()) throw std::invalid_argument("frame: " + frame);
}

}  // namespace viscard
