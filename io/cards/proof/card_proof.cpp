#include "io/cards/proof/card_proof.h"

#include "io/cards/card.h"
#include "io/cards/card_numbers.h"
#include "io/cards/one_element.h"
#include "io/cards/targets/card_targets.h"
#include "models/material/series_band.h"
#include "models/maths/result_visitor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

// The value at a time, if the run has an increment there. ccx prints seven digits of the time and
// takes an elastic step in one increment even if it should take more.
const SolverSample* sample_at(double time_s, const std::vector<SolverSample>& samples) {
  const double margin_s = 1e-6 * time_s;
  const auto at = std::lower_bound(
      samples.begin(), samples.end(), time_s - margin_s,
      [](const SolverSample& sample, double limit_s) { return sample.time_s < limit_s; });
  return at == samples.end() || at->time_s > time_s + margin_s ? nullptr : &*at;
}

constexpr int kSteps = 3;  // each half the one before

// A solver may stop in the middle with exit status 0; what it printed before would prove nothing.
void require_whole_run(const SolverRun& run, const ElementTest& test, const Solver& solver) {
  if (sample_at(test.end_s(), run.samples) != nullptr) return;
  throw std::runtime_error(
      fmt::format("{} stopped at {:g} s of {:g} s; run the model of --deck to see why", solver.code,
                  run.samples.empty() ? 0.0 : run.samples.back().time_s, test.end_s()));
}

// Richardson extrapolation of steps h, h/2 and h/4: the terms of first, then of second order.
StepError compare(const SolverRun* runs, const Material& material, const ElementTest& test,
                  const Solver& solver) {
  StepError error{.resolved = solver.resolves, .predicted = std::nullopt};
  if (solver.is_backward_euler && !test.is_confined())
    error.predicted = backward_euler_error(material, test);
  for (int i = 0; i < kSteps; ++i) require_whole_run(runs[i], test, solver);
  for (const SolverSample& coarse : runs[0].samples) {
    // The response to the first increments of the ramp is close to zero.
    if (coarse.time_s < test.ramp_s * (1.0 - 1e-6)) continue;
    const SolverSample* half = sample_at(coarse.time_s, runs[1].samples);
    const SolverSample* quarter = sample_at(coarse.time_s, runs[2].samples);
    if (half == nullptr || quarter == nullptr) {
      throw std::runtime_error(fmt::format("{} printed no result at {:g} s with a smaller step",
                                           solver.code, coarse.time_s));
    }
    const double expected = exact_response(material, test, coarse.time_s);
    if (solver.has_finite_strain) {
      // Of a soft solid in creep the strain is far above the amplitude.
      const double strain = test.amplitude * (test.is_creep() ? expected : 1.0);
      error.resolved = std::max(error.resolved, 2.0 * strain);
    }
    const double at_step = std::abs(coarse.value / expected - 1.0);
    if (!(at_step <= error.at_step)) {
      error.at_step = at_step;
      error.worst_s = coarse.time_s;
    }
    const double first = 2.0 * half->value - coarse.value;
    const double finer_first = 2.0 * quarter->value - half->value;
    const double second = (4.0 * finer_first - first) / 3.0;
    error.resolved = std::max(error.resolved, std::abs((second - finer_first) / expected));
    const double remaining = std::abs(second / expected - 1.0);
    if (!(remaining <= error.remaining)) error.remaining = remaining;  // NaN counts as the largest
  }
  return error;
}

// Largest relative change of the answer to a test between two materials.
double change_between(const Material& material, const Material& changed, const ElementTest& test) {
  double largest = 0.0, from_s = 0.0;
  for (const TimeBlock& block : test.blocks) {
    constexpr int kPoints = 4;
    for (int i = 1; i <= kPoints; ++i) {
      const double time_s = from_s + (block.end_s - from_s) * i / kPoints;
      if (time_s < test.ramp_s) continue;
      // Creep is loaded by a stress, relaxation by a strain: both relative to one E0.
      const double to_E0 = changed.E0_Pa / material.E0_Pa;
      const double ratio = exact_response(changed, test, time_s) /
                           exact_response(material, test, time_s) *
                           (test.is_creep() ? 1.0 / to_E0 : to_E0);
      largest = std::max(largest, std::abs(ratio - 1.0));
    }
    from_s = block.end_s;
  }
  return largest;
}

struct ChangedConstant {
  std::string name;
  double value = 0.0;
  Material changed;
};

// Each number of the material but its times, a tenth off; of Poisson's ratio the bulk modulus is.
std::vector<ChangedConstant> changed_constants(const Material& material, BulkRule rule) {
  constexpr double kMore = 1.1;
  std::vector<ChangedConstant> out;
  const auto add = [&](const std::string& name, double value) -> Material& {
    return out.emplace_back(ChangedConstant{name, value, material}).changed;
  };
  add("E0_Pa", material.E0_Pa).E0_Pa *= kMore;
  if (material.nu < 0.5) add("nu", material.nu).nu = 0.5 - (0.5 - material.nu) / kMore;
  for (std::size_t i = 0; i < material.terms.size(); ++i) {
    const MaterialTerm& term = material.terms[i];
    Material& share = add(fmt::format("g_{}", i + 1), term.g);
    share.terms[i].g /= kMore;  // a larger one might leave nothing after all relaxation
    if (rule == BulkRule::kConstantPoisson) share.terms[i].k /= kMore;
    if (rule == BulkRule::kOwnNumbers && term.k != 0.0)
      add(fmt::format("k_{}", i + 1), term.k).terms[i].k /= kMore;
  }
  return out;
}

void note_constants(const Material& material, BulkRule rule, const char* name,
                    const ElementTest& test, const StepError& error, CardProof& proof) {
  const std::vector<ChangedConstant> all = changed_constants(material, rule);
  proof.constants.resize(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    ConstantProof& constant = proof.constants[i];
    constant.name = all[i].name;
    constant.value = all[i].value;
    const double change = change_between(material, all[i].changed, test);
    const bool is_seen = change >= 2.0 * error.resolved;
    // The test that shows it best, of those that show it.
    if (change > constant.change && (is_seen || !constant.is_exercised)) {
      constant.change = change;
      constant.seen_by = is_seen ? name : "";
    }
    constant.is_exercised = constant.is_exercised || is_seen;
  }
}

// No static test shows a density, so it is compared as it was read.
void note_density(const ReadCard& read, const Material& material, CardProof& proof) {
  if (!(read.material.rho_kg_m3 > 0.0) || !read.understood.states_density) return;
  constexpr double kColumns = 1e-4;
  const double off = std::abs(read.material.rho_kg_m3 / material.rho_kg_m3 - 1.0);
  proof.constants.push_back({.name = "rho_kg_m3",
                             .value = read.material.rho_kg_m3,
                             .change = 0.0,
                             .is_exercised = off <= kColumns,
                             .seen_by = off <= kColumns ? "read back" : ""});
}

void note_terms(const Material& material, const ElementTest& test, const StepError& error,
                CardProof& proof) {
  proof.terms.resize(material.terms.size());
  for (std::size_t i = 0; i < material.terms.size(); ++i) {
    TermProof& term = proof.terms[i];
    term.g = material.terms[i].g;
    term.tau_s = material.terms[i].tau_s;
    constexpr double kLonger = 1.1;
    Material changed = material;
    changed.terms[i].tau_s *= kLonger;
    const double change = change_between(material, changed, test);
    term.change = std::max(term.change, change);
    term.is_exercised = term.is_exercised || change >= 2.0 * error.resolved;
  }
}

// A run, and the material that the card should be at the temperature of the run.
struct PlannedTest {
  ElementTest test;
  Material material;
  std::optional<double> at_C = std::nullopt;  // besides the reference temperature of the shift

  const char* name() const {
    if (at_C) return "temperature";
    if (test.is_confined()) return "confined";
    return test.is_creep() ? "creep" : "relaxation";
  }
};

// What all runs of one proof have in common.
struct Proving {
  const std::string& card_text;
  const ReadCard& read;
  const Material& material;
  const FoundSolver& found;

  Card card(const std::string& text) const {
    return {.name = read.name, .text = text, .written = material};
  }
  std::vector<SolverTask> tasks(const Card& of, const std::vector<PlannedTest>& tests) const {
    std::vector<SolverTask> out;
    for (const PlannedTest& planned : tests) {
      out.push_back({{of, planned.test, read.units, planned.at_C}, read.material});
    }
    return out;
  }
  // Whether the solver reads the shift from the card.
  bool runs_shift() const {
    return material.shift && !found.solver.targets.empty() &&
           takes_shift(read.understood, material);
  }
};

// A test at its three steps.
void plan(PlannedTest planned, std::vector<PlannedTest>& out) {
  for (int i = 0; i < kSteps; ++i) {
    out.push_back(planned);
    for (TimeBlock& block : planned.test.blocks) block.increments *= 2;
  }
}

std::vector<PlannedTest> tests_of(const Proving& proving, int steps_per_tau) {
  std::vector<PlannedTest> out;
  ElementTestOptions options = proving.found.solver.test;
  if (steps_per_tau > 0) options.steps_per_tau = steps_per_tau;
  const Solver& solver = proving.found.solver;
  if (solver.most_ramps != nullptr) options.most_ramps = solver.most_ramps(proving.material);
  for (const ElementTestKind kind :
       {ElementTestKind::kRelaxation, ElementTestKind::kCreep, solver.confined}) {
    if (kind == solver.confined && !(proving.material.nu < 0.5)) continue;
    options.kind = kind;
    plan({element_test(proving.material, options), proving.material}, out);
  }
  if (!proving.runs_shift()) return out;
  constexpr double kWarmer_K = 10.0;  // changes the times of a polymer severalfold
  const double at_C = proving.material.shift->T_ref_C + kWarmer_K;
  const Material warm = material_at_temperature(proving.material, at_C);
  options.kind = ElementTestKind::kRelaxation;
  plan({element_test(warm, options), warm, at_C}, out);
  return out;
}

// Whether the card that viscard writes for the material runs to the end of the same test.
bool does_right_card_run(const Proving& proving, const PlannedTest& test) {
  try {
    const Card right = write_card(
        proving.material, proving.read.understood,
        {.units = proving.read.units.name, .may_approximate = true, .accepts_flags = true});
    const Card card = proving.card(right.text);
    return !run_solver(proving.found, proving.tasks(card, {test})).front().diverged;
  } catch (const std::invalid_argument&) {
    return false;  // no right card exists
  }
}

// The models at the coarsest step, in a folder for each test.
void note_models(const Proving& proving, const Card& card, const std::vector<PlannedTest>& tests,
                 CardProof& proof) {
  const std::vector<SolverTask> tasks = proving.tasks(card, tests);
  const Solver& solver = proving.found.solver;
  if (solver.runs_together) {
    proof.models = solver.model(tasks);
    return;
  }
  for (std::size_t i = 0; i < tasks.size(); i += kSteps) {
    for (DeckFile& file : solver.model({tasks[i]})) {
      file.name = std::string(tests[i].name()) + "/" + file.name;
      proof.models.push_back(std::move(file));
    }
  }
}

// Stress of a branch s' = e' - s/tau after an increment: (s + de)/(1 + dt/tau).
struct EulerBranch {
  double share = 0.0, tau_s = 0.0, stress = 0.0;
  double weight(double step_s) const { return 1.0 / (1.0 + step_s / tau_s); }
};

}  // namespace

void show_keys(ResultVisitor& v, const TermProof& term) {
  v("g", term.g, "share of the modulus at once");
  v("tau_s", term.tau_s, "relaxation time");
  v("change_with_tau", term.change, "change of the answer if tau is 10 % off");
  v("exercised", term.is_exercised, "whether the tests would show that");
}

void show_keys(ResultVisitor& v, const ConstantProof& constant) {
  v("name", constant.name, "its name");
  v("value", constant.value, "its value, moduli in Pa");
  v("change", constant.change, "change of an answer if the constant is 10 % off");
  v("exercised", constant.is_exercised, "whether the run would show that");
  v("seen_by", constant.seen_by, "the test of that change; empty: none");
}

std::string not_exercised(const std::vector<ConstantProof>& constants,
                          const std::vector<TermProof>& terms) {
  std::string out;
  const auto add = [&](const std::string& name) { out += (out.empty() ? "" : ", ") + name; };
  for (const ConstantProof& constant : constants) {
    if (!constant.is_exercised) add(constant.name);
  }
  for (std::size_t i = 0; i < terms.size(); ++i) {
    if (!terms[i].is_exercised) add(fmt::format("tau_{}", i + 1));
  }
  return out;
}

bool runs_text_of(const Solver& solver, const std::string& target) {
  return std::find(solver.targets.begin(), solver.targets.end(), target) != solver.targets.end();
}

std::string statement_of(const Solver& solver, const std::string& target) {
  if (runs_text_of(solver, target)) return "";
  return solver.code +
         " ran the numbers that viscard read from the card, by its own law; the card itself was "
         "not run in " +
         target;
}

double backward_euler_error(const Material& given, const ElementTest& test) {
  const Material material = with_bulk_rule(given, BulkRule::kConstantPoisson);
  double lasting = 1.0, strain = 0.0, load = 0.0, from_s = 0.0, worst = 0.0;
  std::vector<EulerBranch> branches;
  for (const MaterialTerm& term : material.terms) {
    branches.push_back({term.g, term.tau_s, 0.0});
    lasting -= term.g;
  }
  for (const TimeBlock& block : test.blocks) {
    const double step_s = (block.end_s - from_s) / block.increments, load_before = load;
    for (int i = 1; i <= block.increments; ++i) {
      load = load_before + (block.load - load_before) * i / block.increments;
      double stiffness = lasting, known = lasting * strain;
      for (const EulerBranch& branch : branches) {
        stiffness += branch.share * branch.weight(step_s);
        known += branch.share * branch.weight(step_s) * branch.stress;
      }
      const bool is_creep = test.is_creep();
      const double rise = is_creep ? (load - known) / stiffness : load - strain;
      for (EulerBranch& branch : branches) {
        branch.stress = branch.weight(step_s) * (branch.stress + rise);
      }
      strain += rise;
      const double time_s = from_s + i * step_s;
      if (time_s < test.ramp_s * (1.0 - 1e-6)) continue;
      const double value = is_creep ? strain : known + stiffness * rise;
      worst = std::max(worst, std::abs(value / exact_response(material, test, time_s) - 1.0));
    }
    from_s = block.end_s;
  }
  return worst;
}

CardProof prove_card(const std::string& card_text, const ReadCard& read, const Material& material,
                     const FoundSolver& found, int steps_per_tau) {
  const Proving proving{card_text, read, material, found};
  const Card card = proving.card(card_text);
  const std::vector<PlannedTest> tests = tests_of(proving, steps_per_tau);
  CardProof proof{.end_s = tests.front().test.end_s()};
  note_models(proving, card, tests, proof);
  const std::vector<SolverRun> runs = run_solver(found, proving.tasks(card, tests));
  proof.increments = static_cast<int>(runs.front().samples.size());
  if (runs.back().diverged) {
    const PlannedTest& test = tests[runs.size() - 1];
    const auto& samples = runs.back().samples;
    proof.divergence = SolverDivergence{.test = test.name(),
                                        .reached_s = samples.empty() ? 0.0 : samples.back().time_s,
                                        .is_card_blamed = does_right_card_run(proving, test)};
    return proof;
  }
  for (std::size_t i = 0; i < tests.size(); i += kSteps) {
    const PlannedTest& planned = tests[i];
    const StepError error = compare(&runs[i], planned.material, planned.test, found.solver);
    if (planned.at_C) {
      proof.temperature = TemperatureProof{*planned.at_C, error};
      continue;
    }
    if (planned.test.is_confined()) {
      proof.confined = error;
    } else {
      (planned.test.is_creep() ? proof.creep : proof.relaxation) = error;
    }
    note_terms(material, planned.test, error, proof);
    note_constants(material, read.understood.bulk, planned.name(), planned.test, error, proof);
  }
  note_density(read, material, proof);
  return proof;
}

}  // namespace viscard
