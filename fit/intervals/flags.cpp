#include "fit/intervals/flags.h"

#include "fit/intervals/left_out.h"
#include "fit/intervals/time_rounding.h"
#include "fit/intervals/viscosity.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

namespace viscard {
namespace {

using Index = Eigen::Index;

std::string number(double value) {
  return text_of(value, 3);
}

void flag_time(const FittedTerm& term, int n, const TestWindow& window, FitResult& result) {
  const auto add = [&](const char* name, const std::string& text) {
    result.flags.push_back({name, n, "term " + std::to_string(n) + ": " + text});
  };
  const std::string tau = "relaxation time " + number(term.tau_s) + " s ";
  if (window.sampling_s > 0.0 && term.tau_s < 3.0 * window.sampling_s) {
    add("tau-below-sampling", tau + "is below three sampling intervals (" +
                                  number(3.0 * window.sampling_s) +
                                  " s): time and modulus are not reliable");
  }
  if (window.ramp_s > 0.0 && term.tau_s < 0.2 * window.ramp_s) {
    add("tau-below-ramp", tau + "is below a fifth of the ramp (" + number(0.2 * window.ramp_s) +
                              " s): most of this term relaxed while the load rose");
  }
  if (window.to_s > 0.0 && term.tau_s > window.to_s / 3.0) {
    add("tau-beyond-window",
        tau + "is above a third of the record (" + number(window.to_s / 3.0) + " s): " +
            (is_liquid(result) ? "the slowest time is known roughly only"
                               : "the equilibrium modulus is an upper bound only"));
  }
  if (term.modulus_Pa_95.low <= 0.0 && term.modulus_Pa_95.high >= 0.0) {
    add("modulus-may-be-zero", "the 95 % interval of its modulus contains zero");
  }
}

double correlation(const Eigen::MatrixXd& covariance, Index i, Index j) {
  const double scale = std::sqrt(covariance(i, i) * covariance(j, j));
  return scale > 0.0 && std::isfinite(scale) ? covariance(i, j) / scale : 0.0;
}

// The part of a term's modulus that a test shows at one point, and its derivative by ln tau.
struct TermShare {
  double share = 0.0, slope = 0.0;
};

struct SumOfTerms {
  double modulus_Pa = 0.0, se_Pa = 0.0;
};

// E_inf + sum E_i share(tau_i) with its standard error. Nothing for a result without covariance.
std::optional<SumOfTerms> value_of_terms(const FitResult& result,
                                         const std::function<TermShare(double)>& share_of) {
  const auto n_terms = static_cast<Index>(result.terms.size());
  if (result.covariance.rows() != 1 + 2 * n_terms) return std::nullopt;
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(1 + 2 * n_terms);  // by E_inf, E_i, ln tau_i
  gradient[0] = 1.0;
  SumOfTerms sum{result.E_inf_Pa, 0.0};
  for (Index i = 0; i < n_terms; ++i) {
    const FittedTerm& term = result.terms[static_cast<std::size_t>(i)];
    const TermShare part = share_of(term.tau_s);
    gradient[1 + i] = part.share;
    gradient[1 + n_terms + i] = term.modulus_Pa * part.slope;
    sum.modulus_Pa += term.modulus_Pa * part.share;
  }
  sum.se_Pa = std::sqrt(std::max(0.0, gradient.dot(result.covariance * gradient)));
  return sum;
}

Interval interval_of(const SumOfTerms& sum) {
  return {sum.modulus_Pa - kNormal95 * sum.se_Pa, sum.modulus_Pa + kNormal95 * sum.se_Pa};
}

// Adds the flag E0-extrapolated if the modulus where the test ends is below the interval of E0.
void flag_extrapolated(double modulus_Pa, const std::string& what, const std::string& to_where,
                       FitResult& result) {
  if (modulus_Pa >= result.E0_interval_95.low) return;
  result.flags.push_back({"E0-extrapolated", 0,
                          what + " is " + number(100.0 * (1.0 - modulus_Pa / result.E0_Pa)) +
                              " % below E0, more than the interval of E0: E0 is an extrapolation " +
                              to_where});
}

}  // namespace

void judge(FitResult& result, const std::string& advice) {
  if (!(result.E0_interval_95.low > 0.0) || !std::isfinite(result.E0_interval_95.high)) {
    add_defect(result, "E0-unknown",
               "the 95 % interval of E0 (" + number(result.E0_interval_95.low) + " to " +
                   number(result.E0_interval_95.high) +
                   ") reaches zero: the data do not determine E0. " + advice);
  }
  for (const MaterialFlag& flag : result.flags) {
    if (is_defect(flag.name)) result.is_trustworthy = false;
  }
}

void add_defect(FitResult& result, const std::string& name, const std::string& text) {
  result.flags.push_back({name, 0, text});
  result.is_trustworthy = false;
}

void flag_misfit(double sigma, double quiet_sigma, std::size_t n_quiet, double peak,
                 FitResult& result) {
  constexpr double kTimes = 10.0;        // a cell's noise under load is never this much larger
  constexpr double kShareOfPeak = 1e-3;  // steps and backlash of a good stage leave less than this
  constexpr std::size_t kFewest = 10;
  if (n_quiet < kFewest || sigma <= kTimes * quiet_sigma || sigma <= kShareOfPeak * peak) return;
  add_defect(result, "misfit",
             "the residual is " + number(sigma) +
                 " N per sample, but the noise out of contact is " + number(quiet_sigma) +
                 " N: the record contains something that the model does not describe (lost steps, "
                 "slip, a wrong depth). Look at the curve, then repeat the run");
}

void report_first_modulus(double time_s, FitResult& result) {
  if (!(time_s >= 0.0)) return;
  const auto value = value_of_terms(result, [&](double tau_s) {
    const double x = time_s / tau_s;
    return TermShare{std::exp(-x), x * std::exp(-x)};
  });
  if (!value) return;
  result.first = FirstModulus{time_s, value->modulus_Pa, value->se_Pa, interval_of(*value)};
  if (!(time_s > 0.0)) return;
  flag_extrapolated(value->modulus_Pa,
                    "the modulus at the first sample (t = " + number(time_s) + " s)", "to t = 0",
                    result);
}

void report_highest_storage(double frequency_Hz, FitResult& result) {
  if (!(frequency_Hz > 0.0)) return;
  const auto value = value_of_terms(result, [&](double tau_s) {
    const double x = 2.0 * std::numbers::pi * frequency_Hz * tau_s;
    const double loss = 1.0 / (x + 1.0 / x);  // x/(1 + x^2)
    return TermShare{x * loss, 2.0 * loss * loss};
  });
  if (!value) return;
  result.highest =
      HighestStorage{frequency_Hz, value->modulus_Pa, value->se_Pa, interval_of(*value)};
  flag_extrapolated(
      value->modulus_Pa,
      "the storage modulus at the highest frequency (" + number(frequency_Hz) + " Hz)",
      "to infinite frequency", result);
}

void flag_step_before(std::optional<double> step_s, double first_s, FitResult& result) {
  if (!step_s) return;
  result.flags.push_back({"step-before-record", 0,
                          "the record begins under load, at t = " + number(first_s) +
                              " s: the load counts as a step at t = " + number(*step_s) +
                              " s (--time-zero moves that)"});
}

void add_spikes(FitResult& result, std::size_t count) {
  result.n_spikes = count;
  add_left_out(result, left_out::kSpike, count);
  if (count == 0) return;
  result.flags.push_back(
      {"spikes-left-out", 0,
       counted(count, "sample") + " far from both neighbours " +
           (count == 1 ? "was left out as a spike" : "were left out as spikes")});
}

void add_end_rows(FitResult& result, const EndRows& ends, const std::string& unit) {
  const auto add = [&](const EndRow& row, const std::string& name, const std::string& beside) {
    if (!row.is_wrong) return;
    ++result.n_spikes;
    add_left_out(result, left_out::kSpike, 1);
    result.flags.push_back({name + "-row-left-out", 0,
                            "the " + name + " row (t = " + number(row.time_s) + " s, " +
                                number(row.value) + " " + unit + ") was left out: the rows " +
                                beside + " it lead to " + number(row.expected) + " " + unit +
                                ". Look at it, and correct it or delete it in the table"});
  };
  add(ends.first, "first", "after");
  add(ends.last, "last", "before");
}

void add_record_notes(const RecordNotes& notes, FitResult& result) {
  for (const auto& [reason, count] : notes.left_out) add_left_out(result, reason, count);
  for (const RecordFault& fault : notes.faults) {
    result.flags.push_back({fault.flag, 0, fault.text});
    if (is_defect(fault.flag)) result.is_trustworthy = false;
  }
  if (notes.rise_s) report_rise(notes.rise_s->first, notes.rise_s->second, result);
  if (notes.clock_step_s) widen_for_zero(0.5 * *notes.clock_step_s, result);
  if (notes.counts_from_first) widen_for_zero(0.5 * notes.late_step_s, result);
}

bool is_zero_decisive(const RecordNotes& notes, const FitResult& result) {
  constexpr double kVisible = 1.02;
  return notes.late_s && result.first && result.E0_Pa > kVisible * result.first->modulus_Pa &&
         result.E0_interval_95.high > kVisible * result.first->modulus_Pa;
}

void flag_time_zero(const RecordNotes& notes, FitResult& result) {
  const double late_s = notes.late_s.value_or(0.0), step_s = notes.late_step_s;
  const auto seconds = [](double value) { return text_of(value, 6); };
  const std::string begin = "the record begins at t = " + seconds(late_s) + " s, " +
                            std::to_string(std::llround(late_s / step_s)) +
                            " sampling steps after 0, and does not contain its loading, so that "
                            "the time of the load is not sure. ";
  const std::string answer =
      notes.counts_from_first
          ? "E0 is the modulus at the first row; the times count from half a step before it. If "
            "the record was cropped, the modulus at t = 0 is higher, and unknown"
          : "The modulus at the first row is " + number(result.first->modulus_Pa) +
                ". If the record was cropped, E0 is an extrapolation from it";
  add_defect(result, "time-zero-doubtful",
             begin + answer +
                 ": fit the record with its first rows. If the clock began earlier than the load, "
                 "add --time-zero " +
                 seconds(late_s - step_s) + "; if the load was at t = 0, add --time-zero 0");
}

void add_identifiability_flags(const SpectralModel& model, const SpectralState& state,
                               const Eigen::MatrixXd& covariance, const TestWindow& window,
                               FitResult& result) {
  constexpr double kStrong = 0.99;
  const Index first = model.n_common();
  const Index n_terms = state.n_terms();
  for (std::size_t i = 0; i < result.terms.size(); ++i) {
    flag_time(result.terms[i], static_cast<int>(i) + 1, window, result);
  }
  for (Index i = 0; i < n_terms; ++i) {
    const int n = static_cast<int>(i) + 1;
    const double ln_tau = state.ln_tau[i];
    if (model.is_shortest(ln_tau) || model.is_longest(ln_tau)) {
      result.flags.push_back({"on-bound", n,
                              "term " + std::to_string(n) +
                                  ": its time is at the end of the range that the record can show, "
                                  "so neither time nor modulus is determined"});
    }
    for (Index j = i + 1; j < n_terms; ++j) {
      const bool strong = std::abs(correlation(covariance, first + i, first + j)) > kStrong;
      if (!strong) continue;
      result.flags.push_back(
          {"terms-correlated", n,
           "terms " + std::to_string(n) + " and " + std::to_string(j + 1) +
               ": only their moduli together are determined (correlation above 0.99)"});
    }
    for (Index c = 0; c < first; ++c) {
      const std::string& name = model.common()[static_cast<std::size_t>(c)].name;
      const bool is_drift = name.starts_with("drift") || name.starts_with("creep");
      if (!is_drift || std::abs(correlation(covariance, first + i, c)) <= kStrong) continue;
      result.flags.push_back(
          {"confused-with-drift", n,
           "term " + std::to_string(n) + ": cannot be separated from drift of the force"});
    }
  }
  if (!result.is_converged) {
    add_defect(result, "not-converged",
               "the search for the best times did not converge; try fewer terms with --terms");
  }
}

}  // namespace viscard
