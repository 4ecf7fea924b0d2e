#pragma once

#include "fit/assembly/spectral_fit.h"
#include "fit/curves/master_model.h"
#include "fit/laws/shift_law.h"
#include "fit/master_start.h"

#include <memory>
#include <vector>

namespace viscard {

// The shifts of a master curve in the form that was chosen, beside the free ones.
struct ShiftFits {
  std::unique_ptr<MasterModel> model;  // of the form that was taken
  SpectralFit fit;
  double noise = 1.0;  // by which the model divides its rows
  ShiftFormKind form = ShiftFormKind::kFree;
  bool has_vertical = false;
  double taken_rms = 0.0, free_rms = 0.0;  // relative residuals with one number of terms
  double smooth_rms = 0.0;                 // of the smooth curve
  std::vector<ShiftFactor> free_factors;   // of all segments
  ShiftLaws laws;
};

// Fits the shifts in four forms, all with the number of terms of the smooth fit: as a smooth curve
// over 1/T (penalised second differences, with the weight by cross-validation), free, and by the
// WLF and Arrhenius laws. A form is accepted if its sum of squares is not significantly and visibly
// above that of free shifts. The accepted law with the lower BIC is chosen, else the smooth curve
// if it is accepted, else the free shifts. Vertical shifts are used if BIC prefers them clearly;
// the options can force or forbid them.
ShiftFits fit_shifts(const std::vector<MasterSegment>& segments, const MasterStart& start,
                     const std::vector<int>& blocks, const FitOptions& options);

// ln a, ln b of all segments with their standard errors, from a state and its covariance.
std::vector<ShiftFactor> shift_factors(const MasterModel& model,
                                       const std::vector<MasterSegment>& segments,
                                       const SpectralState& state,
                                       const Eigen::MatrixXd& covariance);

}  // namespace viscard
