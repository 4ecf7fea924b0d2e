#pragma once

#include "fit/intervals/fit_result.h"
#include "fit/laws/shift_law.h"
#include "fit/samples/fit_data.h"

#include <string>
#include <vector>

namespace viscard {

class ResultVisitor;

// The spectrum at the reference temperature, and the shift of time with temperature.
struct MasterCurve {
  FitResult fit;
  double T_ref_C = 0.0;
  std::vector<ShiftFactor> factors;       // as taken, ascending temperature; the reference has 0
  std::vector<ShiftFactor> free_factors;  // one free value for each temperature
  std::string form;                       // of the factors taken: arrhenius, wlf, smooth or free
  bool has_vertical_shift = false;        // ShiftFactor::ln_b
  // Relative rms of the residuals with the factors taken and with the free ones, equal terms.
  double residual = 0.0, free_residual = 0.0;  // relative rms, taken and free, equal terms
  std::vector<std::string> left_out;           // isotherms with the reason
  std::vector<StartShift> start_given;         // MasterData::start_shifts
  bool is_start_as_given = false;  // the fit started from these; false: the rows led elsewhere
  ShiftLaws laws;
};

// Shows all keys of it to a visitor.
void show_keys(ResultVisitor& v, const MasterCurve& curve);

// Fits all segments together: one spectrum and one factor on time for each temperature. The factors
// are fitted free, as WLF and Arrhenius laws and as a smooth curve over 1/T; the smoother ones are
// taken unless they describe the data significantly worse (fit/master_shifts.h). Flags
// shifts-differ or shifts-not-smooth if the free ones differ. Isotherms without overlap or with
// fewer than three rows are left out and named (isotherms-left-out). Throws std::runtime_error if
// fewer than two remain, naming the temperatures, and for no segment at the reference. Given start shifts also keep
// isotherms without overlap (flags isotherms-apart, shifts-not-determined); they throw as master_start() does.
MasterCurve fit_master_curve(const MasterData& data, const FitOptions& options = {});

// Throws std::invalid_argument for a shift that is not finite or beyond any that polymers have.
void validate(const std::vector<StartShift>& shifts);

// True if the temperatures form more than one segment.
bool has_several_temperatures(const std::vector<double>& temperature_C);

}  // namespace viscard
