#include "fit/fit_together.h"

#include "fit/assembly/assemble_result.h"
#include "fit/assembly/joint_spectrum.h"
#include "fit/assembly/slow_doubt.h"
#include "fit/assembly/solid_or_liquid.h"
#include "fit/compare_tests.h"
#include "fit/intervals/flags.h"
#include "fit/intervals/kept_rows.h"
#include "fit/intervals/left_out.h"
#include "fit/intervals/positive_intervals.h"
#include "fit/joint_tests.h"
#include "models/maths/distributions.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

using Index = Eigen::Index;

// Number of independent values of each test minus the number of parameters that it determines.
Eigen::VectorXd noise_freedom(const JointTests& joint, const Eigen::VectorXd& used) {
  constexpr double kLeast = 2.0;
  Eigen::VectorXd freedom(used.size());
  for (Index k = 0; k < used.size(); ++k) {
    const NoiseGroup& group = joint.groups[static_cast<std::size_t>(k)];
    freedom[k] = std::max(kLeast, group.n_samples / group.noise.inflation() - used[k]);
  }
  return freedom;
}

// Sum of squares over all samples of one test, in its own unit.
double own_unit_rss(const JointTests& joint, std::size_t k, const SpectralState& state) {
  const JointModel& model = *joint.model;
  const NoiseGroup& group = joint.groups[k];
  const Eigen::VectorXd left =
      (model.data() - model.fitted(state)).segment(group.first_row, group.n_rows);
  const JointMember& member = model.member(k);
  return left.squaredNorm() / std::pow(member.weight, 2) +
         member.model->hidden_rss(model.member_state(k, state));
}

// The standard deviation of each test from the fit of all tests. If it is significantly larger than
// that of the test's own fit, the tests differ, and the value of its own fit is used.
double larger_change_of_sigma(const std::vector<MaterialTest>& tests, const SpectralState& state,
                              JointTests& joint) {
  constexpr double kChance = 1e-3;
  const Eigen::VectorXd used = leverage_by_group(*joint.model, state, joint.groups);
  const Eigen::VectorXd freedom = noise_freedom(joint, used);
  double largest = 0.0;
  std::vector<double> next = joint.sigma;
  for (std::size_t k = 0; k < tests.size(); ++k) {
    const KeptRows& rows = *tests[k].own.kept;
    const auto at = static_cast<Index>(k);
    const NoiseGroup& group = joint.groups[k];
    const double variance =
        own_unit_rss(joint, k, state) / std::max(1.0, group.n_samples - used[at]);
    const double own_freedom =
        std::max(2.0, group.n_samples / group.noise.inflation() - rows.n_parameters);
    const double ratio = variance / std::max(rows.variance, 1e-300);
    const bool is_chance = f_upper_tail(ratio, freedom[at], own_freedom) > kChance;
    const double sigma = std::sqrt(std::max(is_chance ? variance : rows.variance, 1e-300));
    largest = std::max(largest, std::abs(std::log(sigma / joint.sigma[k])));
    next[k] = sigma;
  }
  constexpr double kSame = 0.05;
  if (largest < kSame) return 0.0;
  for (std::size_t k = 0; k < tests.size(); ++k) set_sigma(k, next[k], joint);
  return largest;
}

// The curves of a test's own fit, with the fitted values replaced by those of the fit of all tests.
FitCurves curves_of(const MaterialTest& test, const JointTests& joint, std::size_t k,
                    const SpectralState& state) {
  const JointMember& member = joint.model->member(k);
  const SpectralState part = joint.model->member_state(k, state);
  const Eigen::VectorXd rows =
      member.creep != nullptr ? member.creep->compliance_of(part) : member.model->fitted(part);
  const Eigen::VectorXd sigma = member.model->row_sigma();
  const std::vector<std::size_t>& begins = joint.groups[k].begins;
  FitCurves curves = test.own.curves;
  const std::size_t count = curves.fitted.size();
  const double change = joint.sigma[k] / std::max(test.own.noise.sigma, 1e-300);
  for (std::size_t i = 0; i < count; ++i) {
    const auto row = static_cast<Index>(i);
    curves.sigma[i] *= change;
    if (curves.loss_fitted.empty()) {
      curves.fitted[i] = rows[row] / std::sqrt(static_cast<double>(begins[i + 1] - begins[i]));
      continue;
    }
    const Index of_loss = static_cast<Index>(count) + row;
    curves.fitted[i] = rows[row] * sigma[row];
    curves.loss_fitted[i] = rows[of_loss] * sigma[of_loss];
    curves.loss_sigma[i] *= change;
  }
  return curves;
}

// Range of times that a test covers, from the begin of its load: as in the window of a material.
Interval shown_window(const FitResult& own) {
  if (own.kind == FitKind::kIndentation) return {own.fastest_s, own.fit_to_s - own.fit_from_s};
  return {std::max(0.0, own.fit_from_s), own.fit_to_s - std::min(0.0, own.fit_from_s)};
}

FittedTest fitted_test(const MaterialTest& test, const JointTests& joint, std::size_t k,
                       const SpectralFit& fit) {
  const FitResult& own = test.own;
  FittedTest one;
  one.name = test.name;
  one.kind = own.kind;
  one.is_stiffness = own.is_stiffness;
  one.n_samples = own.n_samples;
  one.noise = {joint.sigma[k], joint.groups[k].noise.inflation()};
  one.rss = own_unit_rss(joint, k, fit.state);
  const Interval window = shown_window(own);
  one.from_s = window.low;
  one.to_s = window.high;
  one.own_terms = static_cast<int>(own.terms.size());
  one.own_E0_Pa = own.E0_Pa;
  one.own_E_inf_Pa = own.E_inf_Pa;
  one.own_E0_95 = own.E0_interval_95;
  one.own_E_inf_95 = own.E_inf_interval_95;
  one.own_rss = own.evidence.rss;
  one.has_scale = joint.model->scale_nuisance(k) >= 0;
  if (one.has_scale) {
    const Index at = joint.model->scale_nuisance(k);
    const Index column = fit.state.coefficients.size() + fit.state.n_terms() + at;
    const double error = std::sqrt(std::max(0.0, fit.covariance(column, column)));
    one.scale = std::exp(fit.state.nuisance[at]);
    one.scale_95 = {one.scale * std::exp(-kNormal95 * error),
                    one.scale * std::exp(kNormal95 * error)};
  }
  if (!own.curves.fitted.empty()) one.curves = curves_of(test, joint, k, fit.state);
  return one;
}

// Flags of a test's own fit about its record, and about rows that no curve of it describes.
void carry_flags(const MaterialTest& test, FitResult& result) {
  for (const MaterialFlag& flag : test.own.flags) {
    const bool is_misfit =
        flag.name == "misfit" || flag.name == "lack-of-fit" || flag.name == "slow-noise";
    if (is_misfit || is_about_record(flag.name))
      result.flags.push_back({flag.name, 0, test.name + ": " + flag.text});
  }
  for (const LeftOutRows& rows : test.own.left_out) add_left_out(result, rows.reason, rows.count);
  result.n_spikes += test.own.n_spikes;
}

void report_window(const std::vector<MaterialTest>& tests, const SpectralModel& model,
                   const SpectralFit& fit, FitResult& result) {
  TestWindow window;
  result.fit_from_s = result.tests.front().from_s;
  double fastest_s = tests.front().own.kept->window.sampling_s;
  for (std::size_t k = 0; k < tests.size(); ++k) {
    const TestWindow& own = tests[k].own.kept->window;
    fastest_s = std::min(fastest_s, own.sampling_s);
    window.to_s = std::max(window.to_s, own.to_s);
    result.fit_from_s = std::min(result.fit_from_s, result.tests[k].from_s);
    result.fit_to_s = std::max(result.fit_to_s, result.tests[k].to_s);
  }
  window.sampling_s = fastest_s;  // 0 for an oscillation: its range of times is sufficient
  add_identifiability_flags(model, fit.state, fit.covariance, window, result);
}

// Tests of few rows know their own noise badly, and the weights of the tests take it as known. Intervals
// are widened by Student's t: with two tests of 10 or 20 rows 93 to 96 % of those of E0 and E_inf held.
void flag_few_rows(const JointTests& joint, const std::vector<MaterialTest>& tests,
                   FitResult& result) {
  constexpr std::size_t kEnough = 40;
  for (std::size_t k = 0; k < tests.size(); ++k) {
    const auto rows = static_cast<std::size_t>(joint.groups[k].n_samples);
    if (rows >= kEnough) continue;
    result.flags.push_back(
        {"few-rows", 0,
         "the " + tests[k].name + " has " + std::to_string(rows) +
             " rows, too few to know its noise well, so that its weight beside the other tests is "
             "rough; the intervals are wider for it. Measure more rows"});
  }
}

FitResult fit_as(const std::vector<MaterialTest>& tests, const FitOptions& options) {
  constexpr int kRounds = 3;
  JointTests joint = joint_tests(tests, options);
  PronySeries start = starting_series(tests);
  SpectralFit fit;
  for (int round = 0; round < kRounds; ++round) {
    fit = fit_joint_spectrum(*joint.model, joint.groups, joint.blocks, start, options);
    start = joint.model->series_of(fit.state);
    if (round + 1 == kRounds || larger_change_of_sigma(tests, fit.state, joint) == 0.0) break;
  }
  FitResult result;
  result.kind = FitKind::kSeveral;
  result.is_stiffness = std::all_of(tests.begin(), tests.end(),
                                    [](const MaterialTest& test) { return test.own.is_stiffness; });
  fill_result(*joint.model, fit, relaxation_series_of(*joint.model, options.is_liquid), result);
  // Creep may determine a small E_inf so precisely that it seems to differ from zero; BIC decides.
  constexpr double kSmallShare = 0.01;
  result.may_flow |= result.E_inf_Pa < kSmallShare * result.E0_Pa;
  double independent = 0.0;
  for (const NoiseGroup& group : joint.groups) {
    independent += group.n_samples / group.noise.inflation();
  }
  result.evidence.inflation = result.evidence.n_samples / independent;
  result.noise = {1.0, result.evidence.inflation};
  result.n_samples = 0;
  for (std::size_t k = 0; k < tests.size(); ++k) {
    result.tests.push_back(fitted_test(tests[k], joint, k, fit));
    result.n_samples += tests[k].own.n_samples;
  }
  report_window(tests, *joint.model, fit, result);
  const bool are_sweeps = std::all_of(tests.begin(), tests.end(), [](const MaterialTest& test) {
    return test.own.kind == FitKind::kDma;
  });
  if (are_sweeps) carry_slow_doubt(*joint.model, fit, 1.0 / result.fit_to_s, result);
  flag_few_rows(joint, tests, result);
  const Eigen::VectorXd used = leverage_by_group(*joint.model, fit.state, joint.groups);
  compare_tests(joint, fit, noise_freedom(joint, used), result);
  return result;
}

void check(const std::vector<MaterialTest>& tests, const FitOptions& options) {
  if (tests.size() < 2) throw std::invalid_argument("a fit of several tests needs at least two");
  if (!options.constraints.empty() || options.with_profiles || options.n_bootstrap > 0 ||
      options.allow_negative || options.with_laws) {
    throw std::invalid_argument(
        "constraints, profiles, bootstrap, negative terms and laws are for single tests; omit "
        "them for several");
  }
  for (const MaterialTest& test : tests) {
    if (test.own.kept) continue;
    throw std::runtime_error("the " + test.name +
                             " cannot be fitted together with other tests: its rows are not those "
                             "of one temperature and one course of depth");
  }
}

}  // namespace

FitResult fit_together(const std::vector<MaterialTest>& tests, const FitOptions& options) {
  check(tests, options);
  FitResult result =
      fit_solid_or_liquid(options, [&](const FitOptions& as) { return fit_as(tests, as); });
  for (const MaterialTest& test : tests) carry_flags(test, result);
  for (const MaterialFlag& flag : result.flags) result.is_trustworthy &= !is_defect(flag.name);
  keep_intervals_positive(options, result);
  return result;
}

}  // namespace viscard
