#pragma once

#include "fit/intervals/fit_result.h"
#include "fit/laws/shift_law.h"
#include "fit/samples/fit_data.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace viscard {

// Rows at several temperatures: relaxation (time_s and modulus_Pa) or storage and loss moduli over
// frequency. Rows whose temperatures lie within 1 K of each other are one segment.
struct MasterData {
  std::vector<double> temperature_C;
  std::vector<double> argument;    // s, or Hz when loss_Pa is there
  std::vector<double> modulus_Pa;  // relaxation or storage modulus
  std::vector<double> loss_Pa;
  std::optional<double> T_ref_C;  // that of a segment; none: the middle one
};

// The spectrum at the reference temperature, and how time shifts with temperature.
struct MasterCurve {
  FitResult fit;
  double T_ref_C = 0.0;
  std::vector<ShiftFactor> factors;  // ascending temperature, the reference with 0
  ShiftLaws laws;
};

// All segments together: one spectrum and one factor on time for each temperature, estimated
// jointly; no vertical shift. Starts come from where neighbouring segments take the same values, so
// they must overlap. Throws std::runtime_error naming the temperatures that do not, or when there
// are fewer than two segments of three rows, or no segment at the reference.
MasterCurve fit_master_curve(const MasterData& data, const FitOptions& options = {});

// True if the temperatures make more than one segment.
bool has_several_temperatures(const std::vector<double>& temperature_C);

}  // namespace viscard
