#pragma once

#include "fit/laws/fit_mixing_ratio.h"
#include "io/flow/fit_request.h"
#include "models/material/material.h"

#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

class ResultVisitor;

// Reads a capture or a table and fits it. Throws std::runtime_error naming the file.
FittedFile fit_file(const std::string& path, const FitRequest& request);

// The same for a table in memory. Its `file` stands for it in messages; no file of that name is read.
FittedFile fit_values(const CsvTable& table, const FitRequest& request);

// "indentation", "relaxation" ...
const char* name_of_kind(FitKind kind);

// Called with the fraction done and the name of the step that was finished last; may be empty.
using FlowProgress = std::function<void(double fraction, const std::string& step)>;

// The result for one of several files: its fit, or the reason why there is none.
struct FileOutcome {
  std::string path;
  std::optional<FittedFile> fitted;
  std::exception_ptr error;
};

// The keys of `viscard fit --json`; with a failure "file" and "error" alone.
void show_keys(ResultVisitor& v, const FittedFile& fitted);
void show_keys(ResultVisitor& v, const FileOutcome& outcome);

// Data and fit of one file as keys, for those who draw them: the columns of csv_from_fit().
void show_curves(ResultVisitor& v, const FittedFile& fitted);

// A fit as a table: for each row (averages of neighbours where samples are dense) the measured and the fitted value,
// their difference, the standard deviation of the value and its weight in the fit, over the largest. Storage and loss modulus
// have these columns each.
std::string csv_from_fit(const FittedFile& fitted, const std::string& command);

// One row for each file: moduli with their intervals, number of terms, samples, trust and flags, or the error.
std::string csv_from_fits(const std::vector<FileOutcome>& outcomes, const std::string& command);

// Fits all files on all cores. If one file fails, the others are fitted nevertheless.
std::vector<FileOutcome> fit_each_file(const std::vector<std::string>& files,
                                       const FitRequest& request, const FlowProgress& progress);

// Fits all files on all cores. If some fail, rethrows the exception of the first such file.
std::vector<FittedFile> fit_files(const std::vector<std::string>& files, const FitRequest& request,
                                  const FlowProgress& progress);

// Fits several tests of one material together. A captured run counts as the table that `viscard
// export` writes. Throws what fit_file() and fit_together() throw, and std::runtime_error for a file
// that is given twice or whose columns are of another kind of test.
FittedFile fit_tests(const std::vector<TestFile>& tests, const FitRequest& request,
                     const FlowProgress& progress);

// Properties of the material that the fit does not determine.
struct MaterialRequest {
  std::optional<double> nu;         // none: that of the specimen, or 0.495 without punch geometry
  std::optional<double> rho_kg_m3;  // none: that of the specimen
  std::string command;
  std::string created_at;  // ISO 8601, empty in reproducible mode
};

// Makes the material of one fitted capture or table, with its name, validity window and provenance
// (including the SHA-256 of the raw file, unless it was a table in memory). Throws std::invalid_argument if the fit gave
// stiffnesses, std::runtime_error if the raw file cannot be read.
Material material_from_fitted(const FittedFile& fitted, const MaterialRequest& request);

// Specimens of one material at several mixing ratios.
struct JointRequest {
  std::vector<std::string> files;  // captures, tables, material files
  std::vector<double> ratios;      // one for each file; empty: the files state them
  // Id of the specimen of each file; empty: the files state it.
  std::vector<std::string> specimen_ids;
  FitRequest fit;
  MaterialRequest material;
  MixingOptions options;
  FlowProgress progress;
  std::function<void(const std::string&)> note;  // called for each specimen that is fitted again
};

// Fits the measured records with one common number of terms (with options.own_terms: one for each
// ratio), then the law in the mixing ratio. Records of one specimen are repeated touches. Throws what
// fit_file(), read_material() and fit_mixing_ratio() throw; std::runtime_error for a record that is
// given twice, a specimen with two ratios, and files with repeats and others that do not state their
// specimen.
RatioFit fit_jointly(const JointRequest& request);

}  // namespace viscard
