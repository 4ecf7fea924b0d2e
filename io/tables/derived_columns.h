#pragma once

#include "io/basics/option_use.h"
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

// Which of their options are given, and which have an effect on the table that used these.
OptionUses uses_of(const SpecimenSize& given, const SpecimenSize& used);

// The sizes that lines of notes above a table state, "Gauge length (mm);25", "Width: 6 mm"; for those
// that `known` lacks. Each that was read is noted.
SpecimenSize size_from_notes(CsvTable& table, SpecimenSize known);

}  // namespace viscard
