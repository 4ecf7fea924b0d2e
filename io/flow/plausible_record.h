#pragma once

#include "io/tables/column_map.h"
#include "models/material/material.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// What a record says beyond the range of each column: strains that a linear law does not describe, a
// punch that is deeper than the layer, a modulus that no material has. Each returns a flag for what is
// doubtful, and throws BadNumber, with what to write instead, for what is refused.

// Of a table's strains, for a linear law.
std::optional<MaterialFlag> strain_flag(const CsvTable& table, const ColumnMap& columns,
                                        Plausible judged);
// Of any strain, such as a predicted one.
std::optional<MaterialFlag> strain_flag(double largest);

// Throws BadNumber for a depth that no tip reaches.
void refuse_depth(const CsvTable& table, double deepest_m, Plausible judged,
                  const std::string& remedy);

// Of depths below the surface of a layer; nothing for a half-space (thickness 0). `remedy`: what to
// write if the unit of the depths is another ("write --column 'depth_m=1e-3*depth'").
std::optional<MaterialFlag> depth_flag(double deepest_m, double layer_m, Plausible judged,
                                       const std::string& remedy);

// Throws BadNumber for a fitted modulus that is not plausible. table: where it comes from, if
// from one.
void refuse_modulus(double E0_Pa, const CsvTable* table, const ColumnMap& columns,
                    Plausible judged);

// The columns among `names` that state no unit and were read in SI, as the flag unit-assumed.
std::optional<MaterialFlag> assumed_units(const CsvTable& table, const ColumnMap& columns,
                                          const std::vector<std::string>& names);

}  // namespace viscard
