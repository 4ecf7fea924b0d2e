#include "io/study_cost.h"

#include "models/pillar/analysis.h"
#include "models/pillar/effects.h"
#include "models/pillar/error_control.h"
#include "models/pillar/plan.h"
#include "models/pillar/relaxed_modes.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <vector>

namespace viscard {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// One row to come: a scene as it is solved, and its mesh.
struct Trial {
  std::string discretisation, effects;
  Scene scene;
  Discretisation mesh;
};

SceneAnswer run_on(const Scene& scene, const Discretisation& mesh) {
  SceneAnswer answer;
  answer.discretisation = mesh;
  analysis_of(scene.kind).run(scene, answer);
  if (scene.kind == AnalysisKind::kModal) relax_modes(scene, answer);
  return answer;
}

double relative_error(const Scene& scene, const SceneAnswer& answer, const SceneAnswer& reference) {
  double largest = 0.0;
  for (const SceneResult& exact : reference.results) {
    if (!asks_for(scene, exact.name)) continue;
    const auto found = std::find_if(answer.results.begin(), answer.results.end(),
                                    [&](const SceneResult& r) { return r.name == exact.name; });
    if (found == answer.results.end()) return 1.0;
    const double size = std::max(std::abs(exact.value), exact.scale);
    if (size > 0.0) largest = std::max(largest, std::abs(found->value - exact.value) / size);
  }
  for (std::size_t i = 0; i < reference.modes.size(); ++i) {
    if (i >= answer.modes.size()) return 1.0;
    const double exact_Hz = reference.modes[i].frequency_Hz;
    largest = std::max(largest, std::abs(answer.modes[i].frequency_Hz / exact_Hz - 1.0));
  }
  return largest;
}

// A line of /proc/self/status in bytes; 0 where there is none.
double status_B(const std::string& key) {
  std::ifstream status("/proc/self/status");
  std::string word;
  double kB = 0.0;
  while (status >> word) {
    if (word == key && status >> kB) return 1024.0 * kB;
  }
  return 0.0;
}

// Runs once or, if that was quick, a few times.
CostRow measured(const Trial& trial, const SceneAnswer& reference, const Scene& asked,
                 int repeats) {
  constexpr double kQuick_s = 0.3;
  CostRow row{trial.discretisation, trial.effects};
  std::vector<double> wall_s;
  do {
    malloc_trim(0);                                 // what earlier rows left behind
    std::ofstream("/proc/self/clear_refs") << "5";  // the peak starts anew
    const double before_B = status_B("VmRSS:");
    const Clock::time_point start = Clock::now();
    const SceneAnswer answer = run_on(trial.scene, trial.mesh);
    wall_s.push_back(seconds_since(start));
    row.memory_B = std::max(row.memory_B, status_B("VmHWM:") - before_B);
    row.unknowns = answer.unknowns;
    row.error = relative_error(asked, answer, reference);
  } while (wall_s.back() < kQuick_s && static_cast<int>(wall_s.size()) < repeats);
  std::sort(wall_s.begin(), wall_s.end());
  row.wall_s = wall_s[wall_s.size() / 2];
  return row;
}

Discretisation graded(const Scene& scene, int degree, int layers) {
  Discretisation mesh = mesh_sequence(scene.geometry).front();
  mesh.degree = degree;
  mesh.layers = layers;
  return mesh;
}

// Cheap meshes first, so that a short budget still shows something of each kind.
std::vector<Trial> mesh_trials(const Scene& scene) {
  std::vector<Trial> trials;
  for (const auto& [degree, layers] : {std::pair{2, 1}, {3, 1}, {4, 2}, {5, 2}, {6, 3}, {7, 3}}) {
    trials.push_back({fmt::format("graded p{}, {} layers", degree, layers), "all on", scene,
                      graded(scene, degree, layers)});
  }
  for (int degree = 2; degree <= 8; ++degree) {
    Discretisation mesh = graded(scene, degree, 1);
    mesh.uniform_m = 0.5 * scene.geometry.diameter_m;  // one element across the radius
    trials.push_back({fmt::format("p{}", degree), "all on", scene, mesh});
  }
  // The sizes of the seed's study of a pillar of 40 um: a fourth, an eighth and a fortieth of it.
  for (const int degree : {1, 2}) {
    for (const int across : {4, 8, 40}) {
      Discretisation mesh = graded(scene, degree, 1);
      mesh.uniform_m = scene.geometry.diameter_m / across;
      trials.push_back(
          {fmt::format("h{} {:g} um", degree, mesh.uniform_m * 1e6), "all on", scene, mesh});
    }
  }
  return trials;
}

Scene with_all_on(const Scene& scene) {
  return plan_effects(with_all_effects_on(scene)).reduced;
}

std::vector<Trial> effect_trials(const Scene& scene, const Discretisation& mesh) {
  std::vector<Trial> trials;
  const std::string name = fmt::format("graded p{}, {} layers", mesh.degree, mesh.layers);
  for (const Effect& effect : effects()) {
    if (effect.leave_out == nullptr) continue;
    const EffectEstimate estimate = effect.estimate(scene);
    if (estimate.role != EffectRole::kOptional || estimate.error == 0.0) continue;
    Trial trial{name, std::string("without ") + effect.name, with_all_on(scene), mesh};
    effect.leave_out(trial.scene);
    if (!trial.scene.film) trial.mesh.film_elements = 1;
    trials.push_back(trial);
  }
  return trials;
}

// Fewer terms of the Prony series, the strongest kept; and coarser steps in time.
std::vector<Trial> time_trials(const Scene& scene, const Discretisation& mesh) {
  std::vector<Trial> trials;
  if (scene.history.empty()) return trials;
  const std::string name = fmt::format("graded p{}, {} layers", mesh.degree, mesh.layers);
  std::vector<MaterialTerm> strongest = scene.pillar.terms;
  std::sort(strongest.begin(), strongest.end(),
            [](const MaterialTerm& a, const MaterialTerm& b) { return a.g > b.g; });
  for (std::size_t count = 1; count < strongest.size(); ++count) {
    Trial trial{name, fmt::format("{} of {} Prony terms", count, strongest.size()),
                with_all_on(scene), mesh};
    trial.scene.pillar.terms.assign(strongest.begin(),
                                    strongest.begin() + static_cast<std::ptrdiff_t>(count));
    trials.push_back(trial);
  }
  for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-4}) {
    Trial trial{fmt::format("{}, steps to {:g}", name, 0.1 * tolerance), "all on",
                with_all_on(scene), mesh};
    trial.scene.tolerance = tolerance;
    trials.push_back(trial);
  }
  return trials;
}

void mark_front(std::vector<CostRow>& rows) {
  for (CostRow& row : rows) {
    row.is_on_front = std::none_of(rows.begin(), rows.end(), [&](const CostRow& other) {
      return other.wall_s < row.wall_s && other.error <= row.error;
    });
  }
}

CostAdvice advice_for(double tolerance, const std::vector<CostRow>& rows) {
  CostAdvice advice{tolerance, fmt::format("{:g}: none of these is accurate enough", tolerance)};
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
  const Clock::time_point start = Clock::now();
  const ScenePlan plan = plan_effects(scene);
  Scene all_on = with_all_on(scene);
  Scene fine = all_on;
  fine.tolerance = std::min(1e-6, scene.tolerance);  // of time steps
  if (options.progress) options.progress(0.0, "reference");
  const SceneAnswer reference = run_on(fine, graded(fine, 9, 4));
  CostStudy study;
  study.reference_error = relative_error(scene, run_on(fine, graded(fine, 8, 4)), reference);
  all_on.tolerance = 1e-5;
  std::vector<Trial> trials = mesh_trials(all_on);
  const Discretisation usual = graded(all_on, 5, 2);
  for (Trial& trial : effect_trials(scene, usual)) trials.push_back(trial);
  for (Trial& trial : time_trials(scene, usual)) trials.push_back(trial);
  trials.push_back({"graded p5, 2 layers", "as planned", plan.reduced, usual});
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const bool is_cheap = i < 4;  // something is always shown
    if (!is_cheap && seconds_since(start) > options.budget_s) {
      study.left_out = static_cast<int>(trials.size() - i);
      break;
    }
    if (options.progress) {
      options.progress(static_cast<double>(i + 1) / static_cast<double>(trials.size() + 1),
                       trials[i].discretisation);
    }
    study.rows.push_back(measured(trials[i], reference, scene, options.repeats));
  }
  mark_front(study.rows);
  for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5}) {
    study.advice.push_back(advice_for(tolerance, study.rows));
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
  if (!(fall > 0.0 && rise > 0.0)) return std::nullopt;
  const double log_time = std::log(finer.wall_s) + std::log(finer.error / error) * rise / fall;
  return LinearFactor{.error = error,
                      .factor = std::exp(log_time) / quickest->wall_s,
                      .is_extrapolated = error < linear.back()->error,
                      .quickest = quickest->discretisation};
}

}  // namespace viscard
