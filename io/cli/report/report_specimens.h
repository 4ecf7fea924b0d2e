#pragma once

#include "io/report/report.h"

#include <functional>
#include <string>
#include <vector>

namespace viscard {

// What `viscard report` was asked to show.
struct ReportWords {
  std::vector<std::string> files;  // captures, tables and material files
  std::vector<std::string>
      truth_files;  // one per capture or table, in their order; empty: those beside captures
  std::vector<std::string> card_targets;
  std::string card_units;
  std::string created_at;  // ISO 8601
  std::string command;
};

// Reads and fits captures and tables, reads material files (one that came from a capture among the
// files joins it, by the hash of the raw file), runs the pillar, and writes the cards in memory;
// all cores share the files. A file that cannot be fitted stops the command; a pillar that cannot
// be run or a card that is refused only leaves a note. progress gets the fraction done and what was
// finished last. Throws std::runtime_error naming the file; UsageError when the truth files do not
// match the captures.
std::vector<SpecimenReport> read_specimens(
    const ReportWords& words, const std::function<void(double, const std::string&)>& progress);

}  // namespace viscard
