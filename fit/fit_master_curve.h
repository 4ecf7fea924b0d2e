#pragma once

#include "fit/intervals/fit_result.h"
#include "fit/laws/shift_law.h"
#include "fit/samples/fit_data.h"

#include <optional>
#include <vector>

namespace viscard {

// Rows at several temperatures: relaxation modulus over time, or storage and loss moduli over
// frequency. Rows whose temperatures lie within 1 K of each other form one segment.
struct MasterData {
  std::vector<double> temperature_C;
  std::vector<double> argument;    // s, or Hz if loss_Pa is given
  std::vector<double> modulus_Pa;  // relaxation or storage modulus
  std::vector<double> loss_Pa;
  std::optional<double> T_ref_C;  // temperature of a segment; none: the middle one
};

// The spectrum at the reference temperature, and the shift of time with temperature.
struct MasterCurve {
  FitResult fit;
  double T_ref_C = 0.0;
  std::vector<ShiftFactor> factors;  // ascending temperature; the reference has 0
  ShiftLaws laws;
};

// Fits all segments together: one spectrum and one factor on time for each temperature, without
// vertical shift. The start values of the factors come from equal moduli of neighbouring segments,
// so these must overlap. Throws std::runtime_error that names the temperatures that do not overlap,
// and for fewer than two segments of three rows or no segment at the reference.
MasterCurve fit_master_curve(const MasterData& data, const FitOptions& options = {});

// True if the temperatures form more than one segment.
bool has_several_temperatures(const std::vector<double>& temperature_C);

}  // namespace viscard
