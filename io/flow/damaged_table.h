#pragma once

#include "fit/intervals/fit_result.h"
#include "io/capture/integrity_notes.h"
#include "io/tables/csv_table.h"

#include <vector>

namespace viscard {

// True for a table that viscard exported from a capture.
bool is_exported(const CsvTable& table);

// What the head of a table that viscard exported says against the capture it came from ("# damage:");
// empty for every other table.
std::vector<IntegrityNote> damage_of_table(const CsvTable& table);

// The same for a use of the numbers. Throws std::runtime_error if there is damage that is not accepted
// (--unverified): otherwise an export would make trusted numbers of a capture that is refused.
std::vector<IntegrityNote> accepted_damage(const CsvTable& table, bool accepts_damage);

// Adds flags as the capture itself would have them.
void flag_damage(const std::vector<IntegrityNote>& notes, FitResult& result);

}  // namespace viscard
