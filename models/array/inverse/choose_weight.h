#pragma once

#include "models/array/inverse/patch_estimate.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace viscard {

// What makes a reading differ from the voltage of the loads.
struct ReadingErrors {
  std::optional<double> noise_V;  // rms of each reading; nothing: found from the frames
  double gain_spread = 0.0;       // relative standard deviation of the gains of the electrodes
  double disturbing_Pa = 0.0;     // standard deviation of each disturbing load
  // Bounds on the errors of the kernel: of the own voltage, of all others over that of the largest load, and by pillar
  // over the same (empty: none).
  double own_model = 0.0, other_model = 0.0;
  std::vector<double> pillar_model;
};

// How loads are kept from following the noise. Nothing: the data decide.
struct ReadingChoice {
  std::optional<Penalty> penalty;  // kSize where the noise is stated, kSlope where not
  std::optional<double> weight;
};

// How the weight was found (eq. I4, I5).
enum class WeightRule { kDiscrepancy, kCrossValidation, kStated };

struct Regularisation {
  Penalty penalty = Penalty::kSize;
  WeightRule rule = WeightRule::kDiscrepancy;
  double weight = 0.0;       // over the mean square of the gains
  bool is_at_limit = false;  // the data ask for a weight beyond the largest or smallest one
  double noise_V = 0.0;      // rms of a reading, as stated or found
  double total_V = 0.0;      // the same with what gains and disturbing loads add on average
  double prior_Pa =
      0.0;  // standard deviation of a load, or of a difference, that the weight stands for
};

// Voltages of some frames, kLanes at a time in the order of StencilSums; 0 where a reading does not work and where
// there are no more frames.
struct ExampleFrames {
  std::vector<std::vector<double>> lanes;
  std::size_t count = 0;
};

// The weight that the frames ask for, or the stated one, and the noise. Throws std::runtime_error if they cannot show
// the noise.
Regularisation choose_weight(OffsetKernels& kernels, const ReadingErrors& errors,
                             const ReadingChoice& choice, const ExampleFrames& frames);

}  // namespace viscard
