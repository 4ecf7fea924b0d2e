#pragma once

#include "models/pillar/body/pillar_model.h"

#include <array>
#include <string>
#include <vector>

namespace viscard {

// A solution on a fine grid of the meridian section (x = r) or of the half x >= 0 of a strip, for
// pictures. The elements are divided into quadrilaterals, and each element has its own points.
struct SectionField {
  std::string name;
  std::string unit;
  // Displacement: amplitudes along r, theta, z; a scalar uses the first.
  bool is_vector = false;
  std::vector<std::array<double, 3>> value;  // per point
};

// Points and quadrilaterals of a section with fields on them.
struct SectionGrid {
  std::string name;  // name of the field, such as "static" or "lateral"
  bool is_round = true;
  // Fields vary as cos(m theta), the theta component as sin(m theta). A strip has 0 (symmetric) or
  // 1 (antisymmetric), because theta = 0 and pi are its two halves.
  int harmonic = 0;
  std::vector<double> x_m, z_m;
  std::vector<std::array<int, 4>> quads;  // corners in order around the quadrilateral
  std::vector<bool> is_film;              // per quad
  std::vector<SectionField> fields;
};

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
// The potential of the film, V.
SectionField potential_field(const PillarModel& model, const Sampling& at,
                             const PillarState& state);

// Scales a displacement so that its largest value over all angles is 1. A field has a cosine and a
// sine part; only one of them is nonzero at the angle of the largest value.
void normalise(int harmonic, SectionField& field);

}  // namespace viscard
