#include "fit/intervals/flags.h"
#include "fit/laws/law_fit.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

using Index = Eigen::Index;

// E0 and its error from the covariance of (E_inf, E_i, ln tau_i).
double error_of_E0(const Eigen::MatrixXd& covariance, Index n_terms) {
  return std::sqrt(std::max(0.0, covariance.topLeftCorner(1 + n_terms, 1 + n_terms).sum()));
}

// The rows of terms that carry something, in the order E_inf, E_i, ln tau_i.
std::vector<Index> rows_in_use(const PronySeries& series) {
  constexpr double kNothing = 1e-9;
  const double least = kNothing * instantaneous_modulus_Pa(series);
  const auto count = static_cast<Index>(series.terms.size());
  std::vector<Index> rows{0};
  for (const Index offset : {Index{1}, 1 + count}) {
    for (Index i = 0; i < count; ++i) {
      if (series.terms[static_cast<std::size_t>(i)].modulus_Pa > least) rows.push_back(offset + i);
    }
  }
  return rows;
}

std::string text_of_law(const FittedLaw& law) {
  std::string text = "the law " + law.name + " (";
  for (const LawParameter& one : law.parameters) {
    if (&one != &law.parameters.front()) text += ", ";
    text += one.name + " " + text_of(one.value, 5) + ", 95 % " + text_of(one.interval_95.low, 5) +
            " to " + text_of(one.interval_95.high, 5);
  }
  return text + ")";
}

void take_series(const FittedLaw& law, FitResult& result) {
  const std::vector<Index> rows = rows_in_use(law.series);
  const auto n_terms = static_cast<Index>(rows.size() - 1) / 2;
  result.covariance = law.series_covariance(rows, rows);
  result.E_inf_Pa = law.series.equilibrium_modulus_Pa;
  result.E_inf_se_Pa = std::sqrt(std::max(0.0, result.covariance(0, 0)));
  result.terms.clear();
  result.E0_Pa = result.E_inf_Pa;
  for (Index i = 1; i <= n_terms; ++i) {
    const MaxwellTerm& from =
        law.series.terms[static_cast<std::size_t>(rows[static_cast<std::size_t>(i)] - 1)];
    result.terms.push_back({from.modulus_Pa, 0.0, from.relaxation_time_s});
    result.E0_Pa += from.modulus_Pa;
  }
  result.E0_se_Pa = error_of_E0(result.covariance, n_terms);
  const auto interval = [](double value, double se) {
    return Interval{std::max(0.0, value - kNormal95 * se), value + kNormal95 * se};
  };
  result.E0_interval_95 = interval(result.E0_Pa, result.E0_se_Pa);
  result.E_inf_interval_95 = interval(result.E_inf_Pa, result.E_inf_se_Pa);
  result.sum_g = 1.0 - result.E_inf_Pa / result.E0_Pa;
  const auto relative_se = [&](Index row, double value) {
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(result.covariance.rows());
    gradient.head(1 + n_terms).setConstant(-value / (result.E0_Pa * result.E0_Pa));
    gradient[row] += 1.0 / result.E0_Pa;
    return std::sqrt(std::max(0.0, gradient.dot(result.covariance * gradient)));
  };
  result.sum_g_95 = interval(result.sum_g, relative_se(0, result.E_inf_Pa));
  const std::string unit = result.is_stiffness ? "_N_m" : "_Pa";
  result.covariance_parameters = {"E_inf" + unit};
  for (Index i = 1; i <= n_terms; ++i) {
    FittedTerm& term = result.terms[static_cast<std::size_t>(i - 1)];
    term.g = term.modulus_Pa / result.E0_Pa;
    term.modulus_se_Pa = std::sqrt(std::max(0.0, result.covariance(i, i)));
    term.ln_tau_se = std::sqrt(std::max(0.0, result.covariance(n_terms + i, n_terms + i)));
    term.modulus_Pa_95 = interval(term.modulus_Pa, term.modulus_se_Pa);
    term.g_95 = interval(term.g, relative_se(i, term.modulus_Pa));
    const double factor = std::exp(kNormal95 * term.ln_tau_se);
    term.tau_s_95 = {term.tau_s / factor, term.tau_s * factor};
    result.covariance_parameters.push_back("E_" + std::to_string(i) + unit);
  }
  for (Index i = 1; i <= n_terms; ++i) {
    result.covariance_parameters.push_back("ln_tau_" + std::to_string(i));
  }
}

// True if the law describes the structure that the series left in the residual: what is left is less
// than half of it. Readings out of contact give a misfit of their own, which stays.
bool describes_structure(const FittedLaw& law, const FitResult& result) {
  constexpr double kShare = 0.75;  // of the sum of squares
  if (!result.lack_of_fit || result.contact_position_m) return false;
  const double square =
      std::pow(result.lack_of_fit->structure, 2) * static_cast<double>(result.n_samples);
  return square > 0.0 && result.rss - law.rss > kShare * square;
}

// Removes what was found out about the terms, the order and the E0 of the series.
void drop_answers_of_series(const FittedLaw& law, FitResult& result) {
  std::vector<std::string> names{"order-uncertain", "slower-relaxation", "faster-relaxation",
                                 "fewer-terms",     "E0-extrapolated",   "E0-unknown",
                                 "liquid",          "solid-or-liquid",   "slow-term-hidden"};
  if (describes_structure(law, result)) {
    names.insert(names.end(), {"misfit", "lack-of-fit"});
    result.lack_of_fit.reset();
  }
  const bool was_liquid = result.bic_liquid_minus_solid.value_or(0.0) < 0.0;
  std::erase_if(result.flags, [&](const MaterialFlag& flag) {
    return flag.term > 0 || std::find(names.begin(), names.end(), flag.name) != names.end();
  });
  result.bic_liquid_minus_solid.reset();
  // A law has an equilibrium modulus only if the series has one.
  if (was_liquid && law.series.equilibrium_modulus_Pa == 0.0) {
    result.flags.push_back({"liquid", 0,
                            "the law is fitted without an equilibrium modulus, because the series "
                            "describes the data better so: E_inf = 0. Use --solid to keep it"});
  }
  result.is_trustworthy = true;  // judge() decides again
}

}  // namespace

void take_law(const std::string& name, FitResult& result) {
  const auto found = std::find_if(result.laws.begin(), result.laws.end(),
                                  [&](const FittedLaw& law) { return law.name == name; });
  if (found == result.laws.end() || found->series.terms.empty()) {
    throw std::invalid_argument("the law " + name +
                                " does not describe these data: its amplitude is zero, or the kind "
                                "of test has no laws");
  }
  drop_answers_of_series(*found, result);
  take_series(*found, result);
  if (result.first) report_first_modulus(result.first->time_s, result);
  if (result.highest) report_highest_storage(result.highest->frequency_Hz, result);
  result.flags.push_back(
      {"law-as-series", 0,
       text_of_law(*found) + " is written as a Prony series: within " +
           text_of(100.0 * found->series_error, 2) + " % from " + text_of(found->t_min_s, 4) +
           " s to " + text_of(found->t_max_s, 4) +
           " s, and at the angular frequencies of these times. E0 and E_inf belong to the ends of "
           "this window, not to the law"});
  constexpr double kLargestError = 0.05;  // of a series that still stands for its law
  if (!(found->series_error <= kLargestError)) {
    add_defect(result, "law-not-a-series",
               "the Prony series misses the law " + name + " by up to " +
                   text_of(100.0 * found->series_error, 2) +
                   " %, so it does not stand for the law. Take the series of the fit (omit "
                   "--model) or another law");
  }
  if (found->is_at_bound) {
    result.flags.push_back({"law-at-bound", 0,
                            "an exponent or a time of the law ended at the end of its range: the "
                            "data do not determine it, or another law is nearer"});
  }
  constexpr double kVeryStrong = 10.0;  // Kass & Raftery, J. Am. Stat. Assoc. 90 (1995) 773
  if (found->bic_difference > kVeryStrong) {
    add_defect(result, "misfit",
               "a Prony series describes the data much better than the law " + name +
                   " (BIC lower by " + text_of(found->bic_difference, 3) + ")");
  }
  judge(result, "Take the series of the fit (omit --model) or another law");
}

}  // namespace viscard
