#pragma once

#include "fit/intervals/fit_result.h"
#include "fit/master_segments.h"
#include "fit/master_shifts.h"

#include <vector>

namespace viscard {

// What a single record is checked for, for every isotherm of a master curve.
// The flag lack-of-fit, or the defect misfit: what the master curve leaves over of the isotherms, after each may
// have a level and a time shift of its own, is a smooth curve and no noise. Its size follows from the scatter of
// all rows beside that between neighbours.
// The flag storage-loss-contradict: the moduli of one isotherm contradict each other (Kramers-Kronig). Shift
// factors that are wrong can hide this on the master curve, because they follow the moduli as they are.
void check_isotherms(const std::vector<MasterSegment>& segments, const ShiftFits& shifts,
                     const std::vector<ShiftFactor>& factors, const FitOptions& options,
                     FitResult& result);

}  // namespace viscard
