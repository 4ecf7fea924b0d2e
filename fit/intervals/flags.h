#pragma once

#include "fit/intervals/fit_result.h"
#include "fit/samples/check_record.h"
#include "fit/samples/end_rows.h"
#include "fit/search/separable.h"
#include "models/material/material.h"

#include <optional>
#include <stdexcept>
#include <string>

namespace viscard {

// Limits of the test, with which each term is judged.
struct TestWindow {
  double sampling_s = 0.0;          // shortest interval between samples; 0: unknown
  double ramp_s = 0.0;              // duration of loading; 0: a step
  double from_s = 0.0, to_s = 0.0;  // since the start of loading
};

// Adds the identifiability flags of FitResult (fit/intervals/README.md): tau-below-sampling,
// tau-below-ramp, tau-beyond-window, modulus-may-be-zero, terms-correlated, on-bound,
// confused-with-drift, not-converged. Only the last makes a result untrustworthy.
void add_identifiability_flags(const SpectralModel& model, const SpectralState& state,
                               const Eigen::MatrixXd& covariance, const TestWindow& window,
                               FitResult& result);

// Checks that apply to every kind of fit: an interval of E0 that reaches zero makes the result
// untrustworthy (E0-unknown), and so do notes that are defects.
// advice: what to do about an unknown E0.
void judge(FitResult& result, const std::string& advice = "Use fewer terms");

// Fills the modulus at the first sample, and adds the flag E0-extrapolated if it is below the interval
// of E0.
void report_first_modulus(double time_s, FitResult& result);

// The same for an oscillation: the storage modulus at the highest frequency.
void report_highest_storage(double frequency_Hz, FitResult& result);

// Adds the flag with the number of samples left out as spikes, if there are any.
void add_spikes(FitResult& result, std::size_t count);

// Adds the flags first-row-left-out and last-row-left-out for rows that were left out, and counts them
// as spikes. Call it after add_spikes().
void add_end_rows(FitResult& result, const EndRows& ends, const std::string& unit);

// Adds what the check of the record found and left out (fit/samples/check_record.h), and widens the
// interval of E0 where t = 0 is uncertain. Call it after judge().
void add_record_notes(const RecordNotes& notes, FitResult& result);

// The defect time-zero-doubtful for a record that begins late.
void flag_time_zero(const RecordNotes& notes, FitResult& result);

// A fit of a record. If it begins late and its beginning decides E0, it is flagged, and if t = 0 is far from
// it, the times count from its first row.
template <typename Fit>
FitResult fit_from_begin(CheckedRecord& record, const Fit& fit);

// True if E0 is so far above the modulus at the first row that the beginning of a late record matters.
bool is_zero_decisive(const RecordNotes& notes, const FitResult& result);

// One of the flags that make the whole result untrustworthy (models/material/material.h).
inline constexpr const char* kContradictsData = "contradicts-data";

// Adds a flag that makes the whole result untrustworthy.
void add_defect(FitResult& result, const std::string& name, const std::string& text);

// Adds the defect misfit if the model does not describe the record: its residual is many times the
// noise out of contact and not small against the force. sigma: residual of one sample; quiet_sigma:
// noise out of contact, from n_quiet samples; peak: largest force. All in one unit.
void flag_misfit(double sigma, double quiet_sigma, std::size_t n_quiet, double peak,
                 FitResult& result);

// Adds the flag step-before-record if the record begins under load, at first_s.
void flag_step_before(std::optional<double> step_s, double first_s, FitResult& result);

template <typename Fit>
FitResult fit_from_begin(CheckedRecord& record, const Fit& fit) {
  // Above this times the modulus at the first row, an extrapolation to t = 0 has no meaning.
  constexpr double kFar = 3.0;
  RecordNotes& notes = record.notes;
  if (!notes.late_s) return fit();
  if (!notes.counts_from_first) {
    try {
      FitResult result = fit();
      if (!is_zero_decisive(notes, result)) return result;
      if (result.E0_Pa <= kFar * result.first->modulus_Pa) {
        flag_time_zero(notes, result);
        return result;
      }
    } catch (const std::runtime_error&) {
      // E0 may be infinite (creep); with the times from the first row it is not.
    }
    count_from_first(record.clean, notes);
  }
  FitResult result = fit();
  flag_time_zero(notes, result);
  return result;
}

}  // namespace viscard
