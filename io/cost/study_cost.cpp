#include "io/cost/study_cost.h"

#include "io/cost/cost_model.h"
#include "io/cost/study_trials.h"
#include "models/maths/failure_text.h"
#include "models/maths/may_stop.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace viscard {
namespace {

// Largest relative error of the reference's results.
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
    if (!exact.is_watched) continue;
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

// Relative error that every mesh has: of steps in time, reduced bases, modes left out and the film.
double error_on_all_meshes(const SceneAnswer& answer) {
  double largest = 0.0;
  for (const SceneResult& result : answer.results) {
    if (!result.is_wanted) continue;
    const double size = std::max(std::abs(result.value), result.scale);
    const auto curve = std::find_if(answer.curves.begin(), answer.curves.end(),
                                    [&](const SceneCurve& c) { return c.name == result.curve; });
    double left_out = result.left_out;
    if (curve != answer.curves.end() && !curve->left_out.empty()) {
      left_out =
          std::max(left_out, *std::max_element(curve->left_out.begin(), curve->left_out.end()));
    }
    if (size > 0.0) largest = std::max(largest, left_out / size);
  }
  return largest + answer.step_error;
}

constexpr double kQuick_s = 0.3;  // rows that take less time are repeated
// The first rows run although the budget is spent, if they are as quick as this.
constexpr std::size_t kShown = 3;
constexpr double kShown_s = 0.1;
constexpr double kReferenceShare = 0.5;  // of the budget, at most
// What runs when the budget is over is ended this much later, so that quick rows are shown.
constexpr double kOver = 0.08, kOver_s = 0.3;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

struct Ran {
  CostRow row;
  SceneAnswer answer;
};

// Runs trials within a budget of wall time and learns their cost.
class CostRunner {
 public:
  CostRunner(const CostOptions& options, std::size_t count)
      : options_(options),
        count_(count),
        start_wall_s_(options.clock.wall_s()),
        start_cpu_s_(options.clock.cpu_s()) {}

  double spent_s() const { return options_.clock.wall_s() - start_wall_s_; }
  // Of the wall time, and of the processor time at the share that the machine gives.
  double left_s() const {
    double left = options_.budget_s - spent_s();
    if (options_.cpu_budget_s) {
      const double cpu_s = *options_.cpu_budget_s - (options_.clock.cpu_s() - start_cpu_s_);
      left = std::min(left, cpu_s / std::clamp(share(), 1e-3, 1.0));
    }
    return left;
  }
  // Processor time of this program over the wall time since the start.
  double share() const {
    const double wall_s = spent_s();
    return wall_s > 0.0 ? (options_.clock.cpu_s() - start_cpu_s_) / wall_s : 1.0;
  }
  // Wall time that a trial will take with its repeats, on a machine as busy as it was so far.
  double expected_s(const CostTrial& trial, int repeats) const {
    const double once_s = model_.cpu_s(trial.kind, trial.size);
    const double all_s = once_s < kQuick_s ? once_s * repeats : once_s;
    return all_s / std::clamp(share(), 1e-3, 1.0);
  }
  const CostModel& model() const { return model_; }

  const std::vector<FailedRow>& failed() const { return failed_; }
  // Whether this trial was ended because its time was over.
  bool was_ended(const CostTrial& trial) const {
    const std::string name = trial.discretisation + ", " + trial.effects;
    return std::find(ended_.begin(), ended_.end(), name) != ended_.end();
  }

  // Runs once or, if that was quick, a few times. Keeps the reason of a mesh that has no answer.
  std::optional<Ran> run(const CostTrial& trial, int repeats) {
    if (options_.progress) {  // may throw, to end the study
      options_.progress(static_cast<double>(done_) / static_cast<double>(count_),
                        trial.discretisation);
    }
    ++done_;
    const StopCheck stop([this] {
      if (left_s() < -std::max(kOver * options_.budget_s, kOver_s)) throw OutOfTime();
    });
    try {
      return run_to_end(trial, repeats);
    } catch (const OutOfTime&) {
      ended_.push_back(trial.discretisation + ", " + trial.effects);
      return std::nullopt;
    } catch (const std::runtime_error& error) {
      const bool is_too_large = dynamic_cast<const NotEnoughMemory*>(&error) != nullptr;
      if (!is_too_large && !is_refusal(error)) throw;  // no property of this mesh
      failed_.push_back({trial.discretisation, trial.effects, error.what()});
      return std::nullopt;
    }
  }

 private:
  Ran run_to_end(const CostTrial& trial, int repeats) {
    Ran ran{{trial.discretisation, trial.effects, trial.mesh}, {}};
    std::vector<double> wall_s, cpu_s;
    do {
      forget_peak();
      const double before_B = resident_B();
      const double wall_before_s = options_.clock.wall_s();
      const double cpu_before_s = options_.clock.cpu_s();
      ran.answer = trial.run();
      cpu_s.push_back(options_.clock.cpu_s() - cpu_before_s);
      wall_s.push_back(options_.clock.wall_s() - wall_before_s);
      ran.row.memory_B = std::max(ran.row.memory_B, peak_resident_B() - before_B);
    } while (cpu_s.back() < kQuick_s && static_cast<int>(cpu_s.size()) < repeats &&
             wall_s.back() < left_s());
    ran.row.unknowns = ran.answer.unknowns;
    ran.row.cpu_s = median(cpu_s);
    ran.row.wall_s = median(wall_s);
    model_.add(trial.kind, {.unknowns = static_cast<double>(ran.row.unknowns),
                            .cpu_s = ran.row.cpu_s,
                            .memory_B = ran.row.memory_B,
                            .size = trial.size});
    return ran;
  }

  const CostOptions& options_;
  std::size_t count_;
  std::size_t done_ = 0;
  double start_wall_s_, start_cpu_s_;
  CostModel model_;
  std::vector<FailedRow> failed_;
  std::vector<std::string> ended_;
};

// The finest reference that half of the budget allows, and one of a lower degree to estimate its
// error. Starts with the coarsest and jumps to the best pair whose predicted time fits.
struct References {
  Ran finest;
  std::optional<SceneAnswer> coarser;
  std::string why_alone;  // without a coarser one
};

// Whether meshes failed, or the budget ended the search, or both.
std::string why_alone(const std::string& failure, bool is_out_of_budget) {
  if (failure.empty()) return "the budget allowed no second one";
  return "no second one has an answer (" + failure + ")" +
         (is_out_of_budget ? ", and the budget allowed no other" : "");
}

References references_within(double share_s, const std::vector<CostTrial>& ladder,
                             CostRunner& runner) {
  const double stop_s = runner.spent_s() + share_s;
  std::size_t at = 0;
  std::optional<Ran> first_answer = runner.run(ladder.front(), 1);
  while (!first_answer && runner.left_s() > 0.0 && ++at < ladder.size())
    first_answer = runner.run(ladder[at], 1);
  if (!first_answer) {
    throw std::runtime_error("no mesh of the reference has an answer" +
                             (runner.failed().empty()
                                  ? std::string(" within the budget; --budget gives more time")
                                  : ": " + runner.failed().back().reason));
  }
  References found{std::move(*first_answer), std::nullopt, ""};
  std::string failure = runner.failed().empty() ? "" : runner.failed().back().reason;
  std::size_t end = ladder.size();  // of those that may have an answer
  while (at + 1 < end) {
    std::size_t next = at;
    for (std::size_t top = end - 1; top > at && next == at; --top) {
      const std::size_t first = std::max(top - 1, at + 1);
      double needed_s = runner.expected_s(ladder[top], 1);
      if (first < top) needed_s += runner.expected_s(ladder[first], 1);
      if (runner.spent_s() + needed_s <= stop_s) next = first;
    }
    if (next == at) break;
    std::optional<Ran> finer = runner.run(ladder[next], 1);
    if (!finer) {
      if (!runner.failed().empty()) failure = runner.failed().back().reason;
      end = next;
      continue;
    }
    at = next;
    found.coarser = std::move(found.finest.answer);
    found.finest = std::move(*finer);
  }
  if (!found.coarser) found.why_alone = why_alone(failure, at + 1 < end);
  return found;
}

PredictedRow predicted(const CostTrial& trial, const CostModel& model) {
  PredictedRow row{.discretisation = trial.discretisation, .effects = trial.effects};
  row.unknowns = model.unknowns(trial.kind, trial.size);
  if (const auto power = model.power(trial.kind)) {
    row.cpu_s = power->cpu_s_of(row.unknowns);
    row.memory_B = power->memory_B_of(row.unknowns);
  }
  return row;
}

// Laws of the kinds that rows were left out of.
std::vector<CostLaw> laws_of(const CostTrials& trials, const CostModel& model) {
  std::vector<CostLaw> laws;
  for (const CostTrial& trial : trials.rows) {
    const bool is_known = std::any_of(laws.begin(), laws.end(),
                                      [&](const CostLaw& law) { return law.kind == trial.kind; });
    const auto power = model.power(trial.kind);
    if (is_known || !power) continue;
    laws.push_back({trial.kind, power->fixed_s, power->seconds(), power->exponent});
  }
  return laws;
}

std::size_t first_linear(const CostTrials& trials) {
  const auto found =
      std::find_if(trials.rows.begin(), trials.rows.end(),
                   [](const CostTrial& trial) { return trial.kind == kLinearElements; });
  return static_cast<std::size_t>(found - trials.rows.begin());
}

}  // namespace

CostStudy study_of(const CostTrials& trials, const CostOptions& options) {
  CostStudy study;
  study.tolerance = trials.tolerance;
  study.budget_s = options.budget_s;
  study.machine = this_machine();
  CostRunner runner(options, trials.rows.size() + 3);
  std::vector<std::optional<Ran>> ran(trials.rows.size());
  std::vector<bool> was_tried(trials.rows.size(), false);
  const auto run_row = [&](std::size_t i, int repeats) {
    was_tried[i] = true;
    ran[i] = runner.run(trials.rows[i], repeats);
  };
  const std::size_t linear = first_linear(trials);
  if (linear < ran.size()) run_row(linear, options.repeats);
  const References references =
      references_within(kReferenceShare * runner.left_s(), trials.references, runner);
  for (std::size_t i = 0; i < ran.size(); ++i) {
    if (was_tried[i]) continue;
    const bool fits = runner.expected_s(trials.rows[i], options.repeats) <= runner.left_s();
    const bool is_shown = i < kShown && runner.expected_s(trials.rows[i], 1) < kShown_s;
    if (fits || is_shown) run_row(i, fits ? options.repeats : 1);
  }
  for (std::size_t i = 0; i < ran.size(); ++i) {
    if (!was_tried[i] || runner.was_ended(trials.rows[i])) {
      study.predicted.push_back(predicted(trials.rows[i], runner.model()));
      continue;
    }
    if (!ran[i]) continue;
    ran[i]->row.error = relative_error(ran[i]->answer, references.finest.answer);
    study.rows.push_back(ran[i]->row);
  }
  study.failed = runner.failed();
  if (study.rows.empty() && !study.failed.empty()) {
    throw std::runtime_error("no mesh has an answer: " + study.failed.front().reason);
  }
  if (!study.predicted.empty()) study.laws = laws_of(trials, runner.model());
  study.left_out = static_cast<int>(study.predicted.size());
  study.reference = references.finest.row.discretisation;
  study.reference_error = references.coarser
                              ? relative_error(*references.coarser, references.finest.answer) +
                                    error_on_all_meshes(references.finest.answer)
                              : std::numeric_limits<double>::infinity();
  study.why_alone = references.why_alone;
  rank_by_processor_time(study);
  study.machine.share = runner.share();
  study.wall_s = runner.spent_s();
  return study;
}

CostStudy study_cost(const Scene& scene, const CostOptions& options) {
  return study_of(trials_of(scene), options);
}

}  // namespace viscard
