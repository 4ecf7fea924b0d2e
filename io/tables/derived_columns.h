#pragma once

#include "io/tables/column_map.h"

namespace viscard {

// What the person at the machine knows beside the table; 0: not known.
struct SpecimenSize {
  double gauge_length_m = 0.0;  // length at rest
  double area_m2 = 0.0;         // cross-section at rest
  double E0_Pa = 0.0;           // the modulus by which a relative relaxation was divided
};

// Adds to a table the columns of the known quantities that follow from what an instrument wrote: storage
// and loss modulus from the magnitude |E*| or |G*| with the phase or tan delta, from one of them with
// tan delta, or from a complex viscosity (eta* = G*/(i omega)); stress and nominal strain from true ones
// (incompressible) or from load and extension; a modulus from its ratio to E0. Ferry, Viscoelastic
// Properties of Polymers (1980), ch. 1. The notes of the table state each. Quantities that the table
// has stay. Returns the sizes that it used, and 0 for the others. Throws std::runtime_error if a quantity that is needed is missing (the text names its
// option), or if a phase is none.
SpecimenSize derive_columns(CsvTable& table, const ColumnMap& map, const SpecimenSize& size);

// Refuses sizes that were given and not used, by their options: the user expects them to have an effect.
void refuse_unused(const SpecimenSize& given, const SpecimenSize& used);

// The sizes that lines of notes above a table state, "Gauge length (mm);25", "Width: 6 mm"; for those
// that `known` lacks. Each that was read is noted.
SpecimenSize size_from_notes(CsvTable& table, SpecimenSize known);

}  // namespace viscard
