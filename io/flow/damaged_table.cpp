#include "io/flow/damaged_table.h"

#include "io/capture/capture_export.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace viscard {

bool is_exported(const CsvTable& table) {
  const auto is_head = [](const std::string& line) { return line.starts_with(kExportedHead); };
  return std::any_of(table.comments.begin(), table.comments.end(), is_head);
}

std::vector<IntegrityNote> damage_of_table(const CsvTable& table) {
  std::vector<IntegrityNote> notes;
  if (!is_exported(table)) return notes;
  for (const std::string& line : table.comments) {
    if (auto note = note_in_head(line)) notes.push_back(std::move(*note));
  }
  return notes;
}

std::vector<IntegrityNote> accepted_damage(const CsvTable& table, bool accepts_damage) {
  std::vector<IntegrityNote> notes = damage_of_table(table);
  // Readings that were left out are a flag of the capture, too.
  const auto is_refused = [](const IntegrityNote& note) { return note.name == "unverified"; };
  const auto refused = std::find_if(notes.begin(), notes.end(), is_refused);
  if (refused == notes.end() || accepts_damage) return notes;
  throw std::runtime_error(
      table.file + ": was exported from a damaged capture: " + refused->text +
      ". Export another copy of that capture; to use this table as it is, add --unverified, which "
      "the result will state");
}

void flag_damage(const std::vector<IntegrityNote>& notes, FitResult& result) {
  for (const IntegrityNote& note : notes) {
    result.flags.push_back({note.name, 0, note.text});
    if (is_defect(note.name)) result.is_trustworthy = false;
  }
}

}  // namespace viscard
