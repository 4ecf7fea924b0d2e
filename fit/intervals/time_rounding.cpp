#include "fit/intervals/time_rounding.h"

#include "models/material/prony_series.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace viscard {

namespace {

constexpr double kVisible = 0.25;  // of the interval; what widens it by less needs no words

std::string percent_of_E0(double change_Pa, const FitResult& result) {
  return text_of(50.0 * change_Pa / result.E0_Pa, 2) + " %";
}

}  // namespace

double widen_for_zero(double half_s, FitResult& result) {
  // The same curve with its time counted from half_s earlier or later.
  const auto moved = [&](double by_s) {
    PronySeries series{result.E_inf_Pa, {}};
    for (const FittedTerm& term : result.terms) {
      series.terms.push_back({term.modulus_Pa * std::exp(by_s / term.tau_s), term.tau_s});
    }
    return series;
  };
  const PronySeries early = moved(-half_s), late = moved(half_s);
  const double early_Pa = instantaneous_modulus_Pa(early), late_Pa = instantaneous_modulus_Pa(late);
  const auto widen = [](Interval& interval, double value, double one, double other) {
    interval.low += std::min({0.0, one - value, other - value});
    interval.high += std::max({0.0, one - value, other - value});
  };
  for (std::size_t i = 0; i < result.terms.size(); ++i) {
    FittedTerm& term = result.terms[i];
    const double at_early = early.terms[i].modulus_Pa, at_late = late.terms[i].modulus_Pa;
    widen(term.modulus_Pa_95, term.modulus_Pa, at_early, at_late);
    widen(term.g_95, term.g, at_early / early_Pa, at_late / late_Pa);
  }
  widen(result.sum_g_95, result.sum_g, 1.0 - result.E_inf_Pa / early_Pa,
        1.0 - result.E_inf_Pa / late_Pa);
  widen(result.E0_interval_95, result.E0_Pa, early_Pa, late_Pa);
  if (result.first) {
    const double t_s = result.first->time_s;
    widen(result.first->interval_95, relaxation_modulus_Pa(moved(0.0), t_s),
          relaxation_modulus_Pa(early, t_s), relaxation_modulus_Pa(late, t_s));
  }
  return late_Pa - early_Pa;
}

void report_time_rounding(const TimeRounding& rounding, FitResult& result) {
  const double before = result.E0_interval_95.high - result.E0_interval_95.low;
  const double change_Pa = widen_for_zero(rounding.unsure_s, result);
  const bool is_spread = !rounding.time_s.empty();
  if (!is_spread && !(change_Pa > kVisible * before)) return;
  const std::string step = text_of(rounding.step_s, 3), half = text_of(0.5 * rounding.step_s, 3);
  const std::string unsure = text_of(rounding.unsure_s, 3) + " s";
  const std::string included = " changes E0 by " + percent_of_E0(change_Pa, result) +
                               ", which its interval and those of the terms include. Export more "
                               "digits of the time";
  if (!is_spread && rounding.unsure_s > 0.75 * rounding.step_s) {
    result.flags.push_back(
        {"times-rounded", 0,
         "the times lack a row at equal distances: rows are missing, or the times were cut off "
         "to " +
             step + " s at a rate a little below. As the latter they are wrong by up to " + unsure +
             ", which" + included});
    return;
  }
  const std::string how =
      is_spread ? ": they were spread evenly again" : ", which is coarse for this record";
  result.flags.push_back({"times-rounded", 0,
                          "the times are rounded to " + step + " s" + how +
                              ". If the instrument cuts times off, all rows are " + half +
                              " s late (--time-zero -" + half +
                              " corrects that). A zero that is wrong by " + unsure + included});
}

void report_rise(double begin_s, double end_s, FitResult& result) {
  const double change_Pa = widen_for_zero(0.5 * (end_s - begin_s), result);
  result.flags.push_back(
      {"time-zero-chosen", 0,
       "the load rose from t = " + text_of(begin_s, 4) + " to " + text_of(end_s, 4) +
           " s and counts as a step at t = " + text_of(0.5 * (begin_s + end_s), 4) +
           " s, where the fit begins its time (--time-zero moves that); half the rise changes E0 "
           "by " +
           percent_of_E0(change_Pa, result) +
           ", which its interval includes. With a column of depth the rise itself is fitted"});
}

void report_jump(const std::string& load, double jump_s, FitResult& result) {
  constexpr double kHalf =
      0.55;  // and a little more: the ramp between the rows is not quite the step
  const double before = result.E0_interval_95.high - result.E0_interval_95.low;
  const double change_Pa = widen_for_zero(kHalf * jump_s, result);
  if (!(change_Pa > kVisible * before)) return;
  result.flags.push_back(
      {"time-zero-chosen", 0,
       "the " + load + " changes at once between two rows, " + text_of(jump_s, 3) +
           " s apart, and counts as a ramp between them; half of that time changes E0 by " +
           percent_of_E0(change_Pa, result) +
           ", which its interval includes. More rows at the changes would tell"});
}

}  // namespace viscard
