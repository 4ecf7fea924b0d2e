#include "fit/planning/protocol_study.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace viscard {
namespace {

void for_each_of(const ProtocolOptions& options, std::size_t n,
                 const std::function<void(std::size_t)>& work) {
  if (options.for_each) return options.for_each(n, work);
  for (std::size_t i = 0; i < n; ++i) work(i);
}

double systematic_half_width(const ErrorCauses& causes) {
  return kNormal95 * std::hypot(causes.frame, causes.calibration, causes.geometry);
}

// Half-width that counts against the tolerance.
double counted(const ErrorCauses& causes, bool is_beyond_reach) {
  return is_beyond_reach ? causes.without_systematic_95() : causes.half_width_95();
}

// Predicted errors of one run of a plan for one guess of the material.
struct Prediction {
  double total_s = 0.0, peak_force_N = 0.0;
  double weakest_term = 0.0;
  std::vector<ErrorCauses> errors;
};

double weakest_term_of(const PredictedFit& fit) {
  double weakest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < fit.series.terms.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i) + 1;  // of E_i
    weakest =
        std::min(weakest, fit.series.terms[i].modulus_Pa / std::sqrt(fit.covariance(row, row)));
  }
  return weakest;
}

Prediction prediction_of(const TestPlan& plan, const Bench& bench, const Material& guess,
                         const std::vector<WantedQuantity>& wanted) {
  const PredictedFit fit = predicted_fit(plan, bench, guess);
  Prediction prediction{fit.total_s, fit.peak_force_N, weakest_term_of(fit), {}};
  for (const WantedQuantity& one : wanted) prediction.errors.push_back(errors_of(one, fit));
  return prediction;
}

ProtocolRow row_of(const TestPlan& plan, int touches, const Bench& bench,
                   const Prediction& one_run) {
  ProtocolRow row{.plan = plan, .touches = touches, .peak_force_N = one_run.peak_force_N};
  row.weakest_term = one_run.weakest_term;
  row.total_s = touches * one_run.total_s + bench.performance.handling_s;
  for (const ErrorCauses& causes : one_run.errors) row.errors.push_back(causes.of_touches(touches));
  return row;
}

void add_guess(const std::vector<ErrorCauses>& errors, const ProtocolStudy& study,
               ProtocolRow& row) {
  row.worst_half_width.resize(errors.size(), 0.0);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double half_width = errors[i].half_width_95();
    row.worst_half_width[i] = std::max(row.worst_half_width[i], half_width);
    row.shortfall = std::max(
        row.shortfall, counted(errors[i], study.is_beyond_reach[i]) / study.wanted[i].tolerance);
  }
}

// More time is worth while only for a visible gain.
constexpr double kBetter = 0.02;

void mark_front(std::vector<ProtocolRow>& rows) {
  std::sort(rows.begin(), rows.end(), [](const ProtocolRow& a, const ProtocolRow& b) {
    return a.total_s != b.total_s ? a.total_s < b.total_s : a.shortfall < b.shortfall;
  });
  double least = std::numeric_limits<double>::infinity();
  for (ProtocolRow& row : rows) {
    row.is_on_front = row.shortfall < (1.0 - kBetter) * least;
    if (row.is_on_front) least = row.shortfall;
  }
}

// Rows that may belong to the front when the uncertainty of the guess is considered: within a fifth
// of it.
void keep_near_front(std::vector<ProtocolRow>& rows) {
  constexpr double kNear = 1.2;
  mark_front(rows);
  double least = std::numeric_limits<double>::infinity();
  std::vector<ProtocolRow> kept;
  for (const ProtocolRow& row : rows) {
    least = std::min(least, row.shortfall);
    const bool is_near = row.shortfall < kNear * least && row.touches == 1;
    if (row.is_given || row.is_on_front || is_near) kept.push_back(row);
  }
  rows = std::move(kept);
}

void add_doubt(const Bench& bench, const ProtocolOptions& options, ProtocolStudy& study) {
  for_each_of(options, study.rows.size(), [&](std::size_t r) {
    ProtocolRow& row = study.rows[r];
    for (std::size_t i = 1; i < options.guesses.size(); ++i) {
      const Prediction other = prediction_of(row.plan, bench, options.guesses[i], study.wanted);
      add_guess(row_of(row.plan, row.touches, bench, other).errors, study, row);
    }
  });
}

void advise(const ProtocolOptions& options, ProtocolStudy& study) {
  const ProtocolRow* given = nullptr;
  for (const ProtocolRow& row : study.rows) given = row.is_given ? &row : given;
  for (std::size_t i = 0; i < study.rows.size(); ++i) {
    const ProtocolRow& row = study.rows[i];
    if (given != nullptr && row.total_s <= given->total_s &&
        (!study.at_equal_time || row.shortfall < study.rows[*study.at_equal_time].shortfall)) {
      study.at_equal_time = i;
    }
    if (row.total_s > options.longest_s || study.meets_all) continue;
    if (!study.advised || row.shortfall < study.rows[*study.advised].shortfall) study.advised = i;
    study.meets_all = row.shortfall <= 1.0;
  }
}

std::vector<TestPlan> allowed_plans(const ProtocolOptions& options) {
  std::vector<TestPlan> plans;
  for (const TestPlan& plan : protocol_grid(options)) {
    if (!options.is_allowed || options.is_allowed(plan)) plans.push_back(plan);
  }
  if (plans.empty()) {
    throw std::invalid_argument(
        "the rig's checks before a run refuse every test that was tried; viscard capture with the "
        "test file reports why");
  }
  if (options.is_given) plans.push_back(options.base);
  return plans;
}

}  // namespace

ProtocolStudy study_protocols(const Bench& bench, const std::vector<WantedQuantity>& wanted,
                              const ProtocolOptions& options) {
  ProtocolStudy study{.wanted = wanted};
  if (wanted.empty() || options.guesses.empty()) {
    throw std::invalid_argument("a study of tests needs a wanted quantity and a guess");
  }
  const std::vector<TestPlan> plans = allowed_plans(options);
  const std::size_t n_grid = plans.size() - (options.is_given ? 1 : 0);
  std::vector<Prediction> predictions(plans.size());
  for_each_of(options, plans.size(), [&](std::size_t i) {
    predictions[i] = prediction_of(plans[i], bench, options.guesses.front(), wanted);
  });
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    study.is_beyond_reach.push_back(systematic_half_width(predictions.front().errors[i]) >
                                    wanted[i].tolerance);
  }
  study.loses_terms =
      std::none_of(predictions.begin(), predictions.begin() + static_cast<std::ptrdiff_t>(n_grid),
                   [](const Prediction& one) { return one.weakest_term >= kClearTerm; });
  double shortest_s = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const bool is_given = i >= n_grid;
    if (!is_given && !study.loses_terms && predictions[i].weakest_term < kClearTerm) continue;
    for (int touches = 1; touches <= (is_given ? 1 : options.most_touches); ++touches) {
      ProtocolRow row = row_of(plans[i], touches, bench, predictions[i]);
      row.is_given = is_given;
      shortest_s = std::min(shortest_s, row.total_s);
      if (row.total_s > options.longest_s && !is_given) break;
      add_guess(row.errors, study, row);
      study.rows.push_back(row);
    }
  }
  if (study.rows.empty()) {
    const auto seconds = [](double time_s) { return text_of(time_s, 7) + " s"; };
    throw std::runtime_error("no test fits into " + seconds(options.longest_s) +
                             "; the shortest takes " + seconds(std::ceil(shortest_s)) +
                             " at the rig. Allow at least that (--at-most)");
  }
  study.n_tried = study.rows.size();
  keep_near_front(study.rows);
  add_doubt(bench, options, study);
  mark_front(study.rows);
  advise(options, study);
  return study;
}

}  // namespace viscard
