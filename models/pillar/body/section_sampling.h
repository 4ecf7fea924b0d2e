#pragma once

#include "models/pillar/body/pillar_model.h"
#include "models/pillar/body/section_grid.h"

#include <string>
#include <vector>

namespace viscard {

// The grid of a model, and the element of every point.
struct Sampling {
  SectionGrid grid;
  std::vector<const SectionElement*> element;
};
Sampling sampling_of(const PillarModel& model);

// Fields of a solution on that grid.
SectionField displacement_field(const PillarModel& model, const Sampling& at,
                                const std::string& name, const Eigen::VectorXd& solution);
SectionField stress_field(const PillarModel& model, const Sampling& at, const PillarState& state);
SectionField potential_field(const PillarModel& model, const Sampling& at,
                             const PillarState& state);

// Scales a displacement so that its largest value over all angles is 1. A field has a cosine and a
// sine part; only one of them is nonzero at the angle of the largest value.
void normalise(int harmonic, SectionField& field);

}  // namespace viscard
