#pragma once

#include "fit/assembly/spectral_fit.h"
#include "models/material/material.h"

#include <vector>

namespace viscard {

// The causes that systematic_parts_from() knows.
inline constexpr const char* kFrameCause = "frame";
inline constexpr const char* kLoadCellCause = "load cell";
inline constexpr const char* kGeometryCause = "geometry";
inline constexpr const char* kStageCause = "stage";

// Uncertainties of a bench: relative standard uncertainties, and the frame.
struct BenchDoubt {
  double frame_stiffness_N_m = 0.0;  // 0: rigid, or no frame in between
  double frame_relative_u = 0.0;
  double force_relative_u = 0.0;     // of the load cell's gain
  double depth_relative_u = 0.0;     // of the travel that the stage counts
  double geometry_relative_u = 0.0;  // of the force for a modulus: punch, layer, Poisson ratio
};

// Changes of the fitted series by one standard deviation of each uncertainty. The stage feels
// specimen and frame in series, and this does not depend on the assumed frame. The specimen's
// series is the remainder when another frame is taken away, or when all forces are larger. With s
// the stiffness of the specimen over that of the frame, right after loading,
//   frame softer by u:  d ln E0 = s u,  d ln g = s (1 - sum g) u for one slow term;
//   forces larger by u: d ln E0 = (1 + s) u, d ln g as for the frame;
//   travel shorter by u: as forces larger by u, because the fit knows only their ratio.
// specimen_N_m: relaxation of the force per depth, N/m. Causes without an effect are left out.
std::vector<SystematicPart> systematic_parts_from(const PronySeries& specimen_N_m,
                                                  const BenchDoubt& doubt);

// What one standard deviation of the possible drift of the gain before contact (gain_drift_relative_u()) changes in the
// specimen's series. The gain at contact stands in all forces of the record, so it acts as a wrong calibration
// does (above): through the frame it changes shares and times too. Drift during the record is fitted.
SystematicPart gain_drift_part(const SpectralModel& model, const SpectralFit& fit,
                               const IndentationData& data, const FitResult& result);

}  // namespace viscard
