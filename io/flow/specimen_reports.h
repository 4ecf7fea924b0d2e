#pragma once

#include "io/flow/fit_file.h"
#include "io/report/report.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// What a report is made of.
struct ReportRequest {
  std::vector<std::string> files;    // captures, tables and material files
  std::vector<std::string> rubbers;  // files of laws of rubber, beside them
  // Instead of files: several tests of one material, which make one specimen.
  std::vector<TestFile> tests;
  // One per capture or table, in their order. Empty: the truth files beside the captures, if any.
  std::vector<std::string> truth_files;
  std::vector<std::string> card_targets;
  std::string card_units;
  std::string logo;        // a picture above the heading; empty: none
  std::string created_at;  // ISO 8601
  std::string command;
  Plausible plausible = Plausible::kMeasured;  // kOff accepts any value
  bool accepts_unverified = false;             // read damaged captures (FitRequest)
};

// Reads and fits captures and tables, reads material files, runs the pillar and writes the cards in
// memory, on all cores. A material file that was made from one of the captures (by the hash of the
// raw file) becomes part of its specimen. A file that cannot be fitted stops the command; a pillar
// that cannot be run or a card that is refused only adds a note. progress is called with the
// fraction done and the name of the last finished step. Throws std::runtime_error naming the file;
// std::invalid_argument if the number of truth files differs from measured_count().
std::vector<SpecimenReport> read_specimens(const ReportRequest& request,
                                           const FlowProgress& progress);

// The specimen of several tests that are fitted together.
SpecimenReport specimen_of_tests(const ReportRequest& request, const FlowProgress& progress);

// How many of the files are captures or tables. Throws std::runtime_error if a file does not exist.
std::size_t measured_count(const std::vector<std::string>& files);

// E0 over mixing ratio for the report: from the joint file among the inputs or, without one, fitted
// to E0 of the specimens if there are at least four at two or more ratios. Nothing otherwise.
std::optional<MixingLaw> mixing_law_of(const std::vector<std::string>& files,
                                       const std::vector<SpecimenReport>& specimens);

}  // namespace viscard
