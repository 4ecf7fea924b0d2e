#pragma once

#include "io/report/report.h"

#include <functional>
#include <string>
#include <vector>

namespace viscard {

// The options of `viscard report`.
struct ReportWords {
  std::vector<std::string> files;  // captures, tables and material files
  // One per capture or table, in their order. Empty: the truth files beside the captures, if any.
  std::vector<std::string> truth_files;
  std::vector<std::string> card_targets;
  std::string card_units;
  std::string created_at;  // ISO 8601
  std::string command;
};

// Reads and fits captures and tables, reads material files, runs the pillar and writes the cards in
// memory, on all cores. A material file that was made from one of the captures (by the hash of the
// raw file) becomes part of its specimen. A file that cannot be fitted stops the command; a pillar
// that cannot be run or a card that is refused only adds a note. progress is called with the
// fraction done and the name of the last finished step. Throws std::runtime_error naming the file;
// UsageError if the number of truth files differs from that of the captures and tables.
std::vector<SpecimenReport> read_specimens(
    const ReportWords& words, const std::function<void(double, const std::string&)>& progress);

}  // namespace viscard
