#pragma once

#include "models/array/inverse/load_reader.h"
#include "models/array/space/space_scene.h"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// How the pressures on an array are found from its voltages (models/array/inverse).
struct InverseOptions {
  std::optional<double> noise_V;  // rms of each reading; nothing: found from the frames
  double gain_spread = 0.0;       // relative standard deviation of the gains of the electrodes
  double shear_Pa = 0.0;  // standard deviation of the shear on a top that one voltage cannot tell
  ReadingChoice choice;
  bool at_centre = false;  // a sampled electrode is read in the middle instead of on average
};

// Prepares for frames of rows x columns x readings of the scene's array, whose own loads are left out: the mean over
// the electrode (or its middle), the voltage of an equipotential one, or four quarters. Readings that are NaN in any of the
// examples do not work. The errors of the answer are those of the kernel: its change between two accuracies, eq. S7, S8
// and S17. Throws SceneMistake for arrays that are not answered.
LoadReader load_reader(const SpaceScene& scene, const VoltageFrames& examples,
                       const InverseOptions& options);

// Readings and loads of each pillar: pressure, with quarters also shear_x and shear_y.
Eigen::Index inverse_readings(const SpaceScene& scene);
Eigen::Index inverse_loads(const SpaceScene& scene);

}  // namespace viscard
