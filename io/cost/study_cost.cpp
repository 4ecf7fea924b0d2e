#include "io/cost/study_cost.h"

#include "io/cost/study_trials.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>

namespace viscard {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Largest relative error of what the reference is asked for.
double relative_error(const SceneAnswer& answer, const SceneAnswer& reference) {
  double largest = 0.0;
  for (const SceneResult& exact : reference.results) {
    if (!exact.is_wanted) continue;
    const auto found = std::find_if(answer.results.begin(), answer.results.end(),
                                    [&](const SceneResult& r) { return r.name == exact.name; });
    if (found == answer.results.end()) return 1.0;
    const double size = std::max(std::abs(exact.value), exact.scale);
    if (size > 0.0) largest = std::max(largest, std::abs(found->value - exact.value) / size);
  }
  for (std::size_t m = 0; m < reference.maps.size(); ++m) {
    const SceneMap& exact = reference.maps[m];
    if (m >= answer.maps.size() || answer.maps[m].value.size() != exact.value.size()) return 1.0;
    const double size = size_of(exact);
    for (std::size_t i = 0; i < exact.value.size() && size > 0.0; ++i) {
      largest = std::max(largest, std::abs(answer.maps[m].value[i] - exact.value[i]) / size);
    }
  }
  for (std::size_t i = 0; i < reference.modes.size(); ++i) {
    if (i >= answer.modes.size()) return 1.0;
    const double exact_Hz = reference.modes[i].frequency_Hz;
    largest = std::max(largest, std::abs(answer.modes[i].frequency_Hz / exact_Hz - 1.0));
  }
  return largest;
}

// A line of /proc/self/status in bytes; 0 if it is not there.
double status_B(const std::string& key) {
  std::ifstream status("/proc/self/status");
  std::string word;
  double kB = 0.0;
  while (status >> word) {
    if (word == key && status >> kB) return 1024.0 * kB;
  }
  return 0.0;
}

constexpr double kQuick_s = 0.3;  // rows that take less are repeated

// What a row will take at most, from the last of its kind: the factors of direct solvers in the
// plane, unknowns^1.5, on meshes of half the size (8) and one degree or layer more.
double expected_s(const Discretisation& mesh, const std::vector<CostRow>& rows, int repeats) {
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
    const Discretisation& last = row->mesh;
    if ((last.uniform_m > 0.0) != (mesh.uniform_m > 0.0)) continue;
    const double finer = mesh.uniform_m > 0.0 ? last.uniform_m / mesh.uniform_m : 1.0;
    const double higher = static_cast<double>(mesh.degree) / last.degree;
    const double layers = static_cast<double>(mesh.layers) / last.layers;
    const double once_s = row->wall_s * std::pow(std::max(finer * higher * layers, 0.0), 3.0);
    return once_s < kQuick_s ? once_s * repeats : once_s;
  }
  return 0.0;
}

// Runs once or, if that was quick, a few times.
CostRow measured(const CostTrial& trial, const SceneAnswer& reference, int repeats) {
  CostRow row{trial.discretisation, trial.effects, trial.mesh};
  std::vector<double> wall_s;
  do {
    malloc_trim(0);                                 // what earlier rows left behind
    std::ofstream("/proc/self/clear_refs") << "5";  // the peak starts anew
    const double before_B = status_B("VmRSS:");
    const Clock::time_point start = Clock::now();
    const SceneAnswer answer = trial.run();
    wall_s.push_back(seconds_since(start));
    row.memory_B = std::max(row.memory_B, status_B("VmHWM:") - before_B);
    row.unknowns = answer.unknowns;
    row.error = relative_error(answer, reference);
  } while (wall_s.back() < kQuick_s && static_cast<int>(wall_s.size()) < repeats);
  std::sort(wall_s.begin(), wall_s.end());
  row.wall_s = wall_s[wall_s.size() / 2];
  return row;
}

void mark_front(std::vector<CostRow>& rows) {
  for (CostRow& row : rows) {
    row.is_on_front = std::none_of(rows.begin(), rows.end(), [&](const CostRow& other) {
      return other.wall_s < row.wall_s && other.error <= row.error;
    });
  }
}

// Half the tolerance is for the row, half for what the reference itself does not know.
CostAdvice advice_for(double tolerance, const CostStudy& study) {
  const std::vector<CostRow>& rows = study.rows;
  CostAdvice advice{tolerance, fmt::format("{:g}: none of these is accurate enough", tolerance)};
  if (study.reference_error > 0.5 * tolerance) {
    advice.text = fmt::format("{:g}: the reference itself is known to {:.1e} only", tolerance,
                              study.reference_error);
    return advice;
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].error > 0.5 * tolerance) continue;
    if (advice.row >= 0 && rows[static_cast<std::size_t>(advice.row)].wall_s <= rows[i].wall_s) {
      continue;
    }
    advice.row = static_cast<int>(i);
  }
  if (advice.row < 0) return advice;
  const CostRow& row = rows[static_cast<std::size_t>(advice.row)];
  advice.text = fmt::format("{:g}: {}, {} ({:.2g} ms, error {:.1e})", tolerance, row.discretisation,
                            row.effects, 1e3 * row.wall_s, row.error);
  return advice;
}

}  // namespace

CostStudy study_cost(const Scene& scene, const CostOptions& options) {
  const CostTrials trials = trials_of(scene);
  const Clock::time_point start = Clock::now();
  if (options.progress) options.progress(0.0, "reference");
  const SceneAnswer reference = trials.reference();
  CostStudy study;
  study.reference_error = relative_error(trials.coarser_reference(), reference);
  for (std::size_t i = 0; i < trials.rows.size(); ++i) {
    const bool is_cheap = i < 4;  // something is always shown
    const double left_s = options.budget_s - seconds_since(start);
    if (!is_cheap && expected_s(trials.rows[i].mesh, study.rows, options.repeats) > left_s) {
      ++study.left_out;
      continue;
    }
    if (options.progress) {
      options.progress(static_cast<double>(i + 1) / static_cast<double>(trials.rows.size() + 1),
                       trials.rows[i].discretisation);
    }
    study.rows.push_back(measured(trials.rows[i], reference, options.repeats));
  }
  mark_front(study.rows);
  for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5}) {
    study.advice.push_back(advice_for(tolerance, study));
  }
  return study;
}

std::optional<LinearFactor> factor_over_linear(const CostStudy& study, double error) {
  const CostRow* quickest = nullptr;
  std::vector<const CostRow*> linear;
  for (const CostRow& row : study.rows) {
    if (row.effects != "all on") continue;
    if (row.discretisation.rfind("h1 ", 0) == 0) linear.push_back(&row);
    const bool reaches = row.error <= error && row.wall_s > 0.0;
    if (reaches && (quickest == nullptr || row.wall_s < quickest->wall_s)) quickest = &row;
  }
  if (quickest == nullptr || linear.size() < 2) return std::nullopt;
  std::sort(linear.begin(), linear.end(),
            [](const CostRow* a, const CostRow* b) { return a->error > b->error; });
  std::size_t fine = 1;
  while (fine + 1 < linear.size() && linear[fine]->error > error) ++fine;
  const CostRow &coarser = *linear[fine - 1], &finer = *linear[fine];
  const double fall = std::log(coarser.error / finer.error);
  const double rise = std::log(finer.wall_s / coarser.wall_s);
  // Errors that hardly fall with the mesh come from something else, and no line leads to zero.
  constexpr double kSteepest = 5.0;  // time goes with the error to the -3 at the most
  if (!(fall > 0.0 && rise > 0.0 && rise < kSteepest * fall)) return std::nullopt;
  const double log_time = std::log(finer.wall_s) + std::log(finer.error / error) * rise / fall;
  return LinearFactor{.error = error,
                      .factor = std::exp(log_time) / quickest->wall_s,
                      .is_extrapolated = error < linear.back()->error,
                      .quickest = quickest->discretisation};
}

}  // namespace viscard
