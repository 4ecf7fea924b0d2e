#include "fit/joint_tests.h"

#include "fit/assembly/assemble_result.h"
#include "fit/curves/dma_model.h"
#include "fit/curves/history_model.h"
#include "fit/curves/step_model.h"
#include "fit/intervals/kept_rows.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace viscard {
namespace {

using Index = Eigen::Index;

double fastest_s(const KeptRows& rows) {
  if (rows.shape == KeptRows::Shape::kOscillation) return rows.window.from_s;
  return std::max({rows.window.from_s, rows.window.ramp_s, rows.window.sampling_s});
}

// The first test with moduli has the factor one; if there is none, the first test.
std::size_t fixed_test(const std::vector<MaterialTest>& tests) {
  const auto found = std::find_if(tests.begin(), tests.end(),
                                  [](const MaterialTest& test) { return !test.own.is_stiffness; });
  return found == tests.end() ? 0 : static_cast<std::size_t>(found - tests.begin());
}

// Ratio of the values of both single fits in the middle of the window that both cover.
double scale_between(const FitResult& test, const FitResult& reference) {
  const TestWindow &a = test.kept->window, &b = reference.kept->window;
  const double from_s = std::max(fastest_s(*test.kept), fastest_s(*reference.kept));
  const double to_s = std::min(a.to_s, b.to_s);
  const double at_s = std::sqrt(std::max(from_s, 1e-300) * std::max(to_s, 1e-300));
  return relaxation_modulus_Pa(fitted_series(test), at_s) /
         relaxation_modulus_Pa(fitted_series(reference), at_s);
}

// A dashpot stands for relaxation too fast for a sweep; a faster test resolves it as terms.
bool is_fastest(const MaterialTest& test, const std::vector<MaterialTest>& tests) {
  return std::all_of(tests.begin(), tests.end(), [&](const MaterialTest& other) {
    return fastest_s(*other.own.kept) >= fastest_s(*test.own.kept);
  });
}

JointMember member_of(const MaterialTest& test, const std::vector<MaterialTest>& tests,
                      FitOptions options) {
  const KeptRows& rows = *test.own.kept;
  JointMember member;
  switch (rows.shape) {
    case KeptRows::Shape::kStep:
      options.drift = rows.with_drift ? TableDrift::kFitted : TableDrift::kNone;
      member.model =
          std::make_unique<StepModel>(rows.at, rows.value, StepShape::kRelaxation, options);
      break;
    case KeptRows::Shape::kCreep: {
      auto creep =
          std::make_unique<CreepRows>(rows.at, rows.value, fitted_series(test.own), options);
      member.creep = creep.get();
      member.model = std::move(creep);
      break;
    }
    case KeptRows::Shape::kHistory:
      member.model = std::make_unique<HistoryModel>(rows.history, options);
      break;
    case KeptRows::Shape::kOscillation:
      member.model = std::make_unique<DmaModel>(rows.at, rows.value, rows.loss, options,
                                                rows.with_dashpot && is_fastest(test, tests));
      break;
  }
  return member;
}

std::vector<double> row_times_s(const KeptRows& rows, const SpectralModel& model) {
  std::vector<double> time_s;
  if (const auto* step = dynamic_cast<const StepModel*>(&model)) {
    time_s = step->row_time_s();
  } else if (const auto* creep = dynamic_cast<const CreepRows*>(&model)) {
    time_s = creep->step().row_time_s();
  } else if (const auto* history = dynamic_cast<const HistoryModel*>(&model)) {
    time_s = history->row_time_s();
    for (double& t_s : time_s) t_s -= rows.zero_s;
  } else {
    for (int part = 0; part < 2; ++part) {  // storage, then loss
      for (const double f_Hz : rows.at) time_s.push_back(1.0 / (2.0 * std::numbers::pi * f_Hz));
    }
  }
  return time_s;
}

// Rows before the load or at its very beginning have the log time of the shortest step.
Eigen::VectorXd ln_times(const std::vector<double>& time_s, const KeptRows& rows) {
  const double least_s = std::max(rows.window.sampling_s, 1e-300);
  Eigen::VectorXd ln_time(static_cast<Index>(time_s.size()));
  for (Index i = 0; i < ln_time.size(); ++i) {
    ln_time[i] = std::log(std::max(time_s[static_cast<std::size_t>(i)], least_s));
  }
  return ln_time;
}

// Blocks of one test; storage and loss of one frequency share a block.
std::vector<int> blocks_of_test(const KeptRows& rows, std::vector<double> time_s) {
  const bool is_oscillation = rows.shape == KeptRows::Shape::kOscillation;
  if (is_oscillation) time_s.assign(rows.at.begin(), rows.at.end());
  const std::size_t shortest = rows.shape == KeptRows::Shape::kHistory ? 2 : 1;
  std::vector<int> blocks = log_time_blocks(time_s, 0.0, shortest);
  if (is_oscillation) blocks.insert(blocks.end(), blocks.begin(), blocks.end());
  return blocks;
}

}  // namespace

PronySeries starting_series(const std::vector<MaterialTest>& tests) {
  for (const MaterialTest& test : tests) {
    if (test.own.kept->shape == KeptRows::Shape::kCreep) return fitted_series(test.own);
  }
  return fitted_series(tests.front().own);
}

void set_sigma(std::size_t k, double sigma, JointTests& joint) {
  const double inflation = joint.groups[k].noise.inflation();
  joint.sigma[k] = sigma;
  joint.model->set_weight(k, 1.0 / (sigma * std::sqrt(inflation)));
  joint.groups[k].variance = 1.0 / inflation;
}

JointTests joint_tests(const std::vector<MaterialTest>& tests, const FitOptions& options) {
  const std::size_t reference = fixed_test(tests);
  std::vector<JointMember> members;
  JointTests joint;
  int n_blocks = 0;
  Index first_row = 0;
  for (std::size_t k = 0; k < tests.size(); ++k) {
    const KeptRows& rows = *tests[k].own.kept;
    JointMember member = member_of(tests[k], tests, options);
    if (k != reference && tests[k].own.is_stiffness) {
      member.has_scale = true;
      member.scale_start = scale_between(tests[k].own, tests[reference].own);
    } else if (tests[k].own.systematic_relative > 0.0) {
      member.has_scale = true;  // prior width: uncertainty of its geometry and calibration
      member.scale_prior_sd = tests[k].own.systematic_relative;
    }
    const std::vector<double> time_s = row_times_s(rows, *member.model);
    joint.ln_time.push_back(ln_times(time_s, rows));
    for (const int block : blocks_of_test(rows, time_s)) joint.blocks.push_back(n_blocks + block);
    n_blocks = joint.blocks.back() + 1;
    joint.groups.push_back({first_row,
                            member.model->n_rows(),
                            member.model->row_begins(),
                            member.model->n_samples(),
                            1.0,
                            rows.noise,
                            rows.slow,
                            {}});
    if (rows.row_scale.size() == member.model->n_rows()) {
      joint.groups.back().row_scale = rows.row_scale;
    }
    first_row += member.model->n_rows();
    members.push_back(std::move(member));
  }
  joint.model = std::make_unique<JointModel>(std::move(members), options.is_liquid);
  joint.sigma.resize(tests.size());
  for (std::size_t k = 0; k < tests.size(); ++k) {
    set_sigma(k, std::sqrt(std::max(tests[k].own.kept->variance, 1e-300)), joint);
  }
  return joint;
}

}  // namespace viscard
