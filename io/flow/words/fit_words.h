#pragma once

#include "io/flow/fit_file.h"
#include "io/options/option.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// The options of `viscard fit` as a user gives them; `viscard fit --help` explains each. Quantities
// are texts with a unit ("0.1 mm"), or numbers in SI.
struct FitWords {
  // As typed; nothing: not given.
  using Text = std::optional<std::string>;
  // How to fit.
  Text kind, noise, model, constraints, vertical_shift;
  std::optional<int> terms, max_terms, bootstrap;
  bool liquid = false, solid = false, allow_negative = false, drift = false, no_drift = false;
  bool full_data = false, profiles = false, spectrum = false, diagnose = false;
  std::vector<std::string> fix, bound;
  // What the data are.
  std::vector<std::string> column, segment, start_shift;
  Text sheet, time_zero, from, to, crop, depth, modulus_kind, gauge_length, area, youngs_modulus;
  std::optional<int> hold, skip, table;
  Text plausible, specimen, punch_diameter, layer_thickness, frame_stiffness, reference_temperature,
      density;
  std::optional<double> poisson_ratio;
  // Several files.
  std::vector<double> ratio;
  std::vector<std::string> specimen_id, share;
  bool joint = false, own_terms = false;
  bool unverified = false;
};
// Its options.
OptionList options_of(FitWords& words);

// Names of the laws that --model takes: of viscoelasticity and of rubber.
std::vector<std::string> all_model_names();

// Which table of a file. Throws OptionError.
TableChoice table_choice(const FitWords& words);

// Gauge length and area. Throws OptionError.
SpecimenSize specimen_size(const FitWords& words);

// What to fit and how. Throws OptionError for a value that is not allowed, and std::runtime_error
// for a bad specimen or constraint file.
FitRequest fit_request(const FitWords& words);

// command: the whole command line, for the provenance of the material. Throws OptionError.
MaterialRequest material_request(const FitWords& words, const std::string& command);

// The options of a joint fit of these files; the caller adds `progress` and `note`. Throws OptionError.
JointRequest joint_request(const FitWords& words, const std::vector<std::string>& files,
                           const std::string& command);

// Throws OptionError if options exclude each other, or do not belong to that many files. tests: of one
// material, from the words of the command; empty: plain files.
void refuse_contradictions(const FitWords& words, const std::vector<TestFile>& tests,
                           std::size_t n_files, bool has_out);

}  // namespace viscard
