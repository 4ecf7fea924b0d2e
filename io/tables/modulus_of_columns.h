#pragma once

#include "io/tables/column_map.h"
#include "models/quantities/modulus_kind.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// The kind of modulus that a header names: "G'", "J(t)" and "Shear stress" belong to shear, "E(t)",
// "D(t)" and "Tensile stress" to tension (the letters of ISO 6721-1). Nothing if it names none.
std::optional<ModulusKind> modulus_kind_of_header(const CsvColumn& column);

// The kind of the moduli, compliances, stresses and strains of a table, and what states it.
struct TableModulusKind {
  ModulusKind kind = ModulusKind::kTension;
  std::string from;         // "the header 'G(t) (MPa)'", "RepTate"
  bool is_assumed = false;  // nothing states it, so the column was taken as of tension
  std::string header;       // then: of the column that does not state it
};

// names: the columns that are used. viscard's own names (modulus_Pa, stress_Pa) mean tension. Throws
// std::runtime_error if the headers of two columns contradict each other.
TableModulusKind modulus_kind_of(const CsvTable& table, const ColumnMap& map,
                                 const std::vector<std::string>& names);

}  // namespace viscard
