#include "io/cards/proof/law_proof.h"

#include "io/basics/words.h"
#include "io/cards/hyperelastic/rubber_card.h"
#include "io/cards/law_numbers.h"
#include "io/cards/proof/cube_stress.h"
#include "io/cards/proof/solvers.h"
#include "io/cards/unit_system.h"
#include "models/hyperelastic/law_stability.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <stdexcept>

namespace viscard {
namespace {

// What the card should be, as the cubes are compared with it.
struct WantedLaw {
  HyperelasticLaw law;
  std::vector<RubberTerm> terms;
  double bulk_Pa = 0.0;
  VolumeRule rule = VolumeRule::kUnitVolume;

  double stress_Pa(const CubeTest& test, double stretch) const {
    return test.is_confined ? confined_stress_Pa(law, bulk_Pa, stretch, rule)
                            : cube_stress_Pa(law, bulk_Pa, test.deformation, stretch, rule);
  }
};

constexpr double kUsualTop = 1.8;

// Between 10 and 80 steps.
int steps_to(double top, double step) {
  return static_cast<int>(std::clamp(std::ceil(std::abs(top - 1.0) / step), 10.0, 80.0));
}

CubeProof compared(const CubeTest& test, const std::vector<CubeRow>& rows, const WantedLaw& wanted,
                   const UnitSystem& units, double resolves) {
  CubeProof out{.test = test, .resolved = resolves};
  if (static_cast<int>(rows.size()) < test.steps)
    throw std::runtime_error("the run of the " + test.name + " cube ended after " +
                             counted(rows.size(), "step") + " of " + std::to_string(test.steps));
  for (const CubeRow& row : rows) {
    if (row.unbalanced > resolves) continue;
    ++out.compared;
    const double exact_Pa = wanted.stress_Pa(test, row.at);
    const double error = std::abs(from_card(row.stress, units.stress_exponent) / exact_Pa - 1.0);
    if (error <= out.error) continue;  // nan counts as the largest
    out.error = error;
    out.at_stretch = row.at;
  }
  return out;
}

// The cube that shows a change best, relative to what it resolves.
ConstantProof change_of(const std::string& name, double value, const WantedLaw& wanted,
                        const WantedLaw& changed, const std::vector<CubeProof>& cubes) {
  constexpr double kTwice = 2.0;
  ConstantProof out{.name = name, .value = value, .change = 0.0};
  double best = 0.0;
  for (const CubeProof& cube : cubes) {
    for (int i = 1; i <= cube.test.steps; ++i) {
      const double s = 1.0 + (cube.test.top - 1.0) * i / cube.test.steps;
      const double off =
          std::abs(changed.stress_Pa(cube.test, s) / wanted.stress_Pa(cube.test, s) - 1.0);
      if (!std::isfinite(off) || off / cube.resolved <= best) continue;
      best = off / cube.resolved;
      out.change = off;
      out.is_exercised = best >= kTwice;
      out.seen_by = out.is_exercised ? cube.test.name : "";
    }
  }
  return out;
}

// Each modulus, shape, and the bulk modulus a tenth larger.
void note_constants(const WantedLaw& wanted, LawProof& proof) {
  constexpr double kMore = 1.1;
  const auto note = [&](const std::string& name, double value, const WantedLaw& changed) {
    proof.constants.push_back(change_of(name, value, wanted, changed, proof.cubes));
  };
  const auto moduli = modulus_names(wanted.law.form), shapes = shape_names(wanted.law.form);
  for (std::size_t i = 0; i < moduli.size() + shapes.size(); ++i) {
    WantedLaw changed = wanted;
    const bool is_modulus = i < moduli.size();
    const auto k = static_cast<Eigen::Index>(is_modulus ? i : i - moduli.size());
    double& value = is_modulus ? changed.law.moduli_Pa[k] : changed.law.shapes[k];
    const double old = value;
    value *= kMore;
    note(is_modulus ? moduli[i] : shapes[i - moduli.size()], old, changed);
  }
  WantedLaw changed = wanted;
  changed.bulk_Pa *= kMore;
  note("bulk modulus", wanted.bulk_Pa, changed);
}

// A ramp of half the shortest time, and four holds per decade to five times the longest. Stretches rise by less
// than 0.02 a step, so that nominal_stress_Pa() divides no step, and both integrate the same polygon.
CubeTest hold_of(const std::vector<RubberTerm>& terms, double top) {
  constexpr double kStep = 0.0199, kMost = 1.4, kPerDecade = 4.0, kLast = 5.0;
  const auto by_tau = [](const RubberTerm& a, const RubberTerm& b) { return a.tau_s < b.tau_s; };
  const auto [least, most] = std::minmax_element(terms.begin(), terms.end(), by_tau);
  CubeTest hold{.name = "relaxation", .top = std::min(top, kMost), .ramp = 0.5 * least->tau_s};
  hold.steps = static_cast<int>(std::ceil(std::abs(hold.top - 1.0) / kStep));
  const int n =
      static_cast<int>(std::ceil(kPerDecade * std::log10(kLast * most->tau_s / hold.ramp)));
  for (int i = 1; i <= n; ++i)
    hold.until.push_back(hold.ramp * std::pow(kLast * most->tau_s / hold.ramp, double(i) / n));
  return hold;
}

Course history_of(const CubeTest& hold) {
  Course history{{0.0, 1.0}};
  for (int i = 1; i <= hold.steps; ++i) {
    history.push_back({hold.ramp * i / hold.steps, 1.0 + (hold.top - 1.0) * i / hold.steps});
  }
  for (const double end_s : hold.until) history.push_back({end_s, hold.top});
  return history;
}

using StressOfTerms = std::function<std::vector<double>(const std::vector<RubberTerm>&)>;

// `stresses_of` gives the exact answer behind the start of the history for any terms.
HoldProof compared_hold(const Course& history, const std::vector<CubeRow>& rows,
                        const std::vector<RubberTerm>& terms, const StressOfTerms& stresses_of,
                        const UnitSystem& units, double resolves) {
  const auto exact_Pa = stresses_of(terms);
  if (rows.size() != exact_Pa.size())
    throw std::runtime_error("the run of the relaxing cube ended after " +
                             counted(rows.size(), "step"));
  HoldProof out{.end_s = history.back().time_s, .resolved = resolves};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double found_Pa = from_card(rows[i].stress, units.stress_exponent);
    const double error = std::abs(found_Pa / exact_Pa[i] - 1.0);
    if (rows[i].coarser != 0.0)
      out.resolved = std::max(out.resolved, std::abs(rows[i].coarser / rows[i].stress - 1.0));
    if (error <= out.error) continue;
    out.error = error;
    out.at_s = history[i + 1].time_s;
  }
  const auto change_with = [&](const std::vector<RubberTerm>& changed) {
    const auto changed_Pa = stresses_of(changed);
    double change = 0.0;
    for (std::size_t i = 0; i < changed_Pa.size(); ++i)
      change = std::max(change, std::abs(changed_Pa[i] / exact_Pa[i] - 1.0));
    return change;
  };
  constexpr double kMore = 1.1, kTwice = 2.0;
  for (std::size_t k = 0; k < terms.size(); ++k) {
    std::vector<RubberTerm> longer = terms, less = terms;
    longer[k].tau_s *= kMore;
    less[k].g /= kMore;
    const double change = change_with(longer), of_share = change_with(less);
    out.terms.push_back({terms[k].g, terms[k].tau_s, change, change >= kTwice * out.resolved});
    const bool is_seen = of_share >= kTwice * out.resolved;
    out.shares.push_back({.name = "g_" + std::to_string(k + 1),
                          .value = terms[k].g,
                          .change = of_share,
                          .is_exercised = is_seen,
                          .seen_by = is_seen ? "relaxation" : ""});
  }
  return out;
}

WantedLaw wanted_of(const ReadRubber& read, const HyperelasticFile* file,
                    const std::string& elastic_only) {
  WantedLaw out{read.law, read.terms, read.bulk_Pa};
  if (file != nullptr) {
    out.law = file->law;
    out.terms = file->terms;
    if (file->bulk_Pa) out.bulk_Pa = *file->bulk_Pa;
    if (!elastic_only.empty()) {
      out.law = law_without_terms(file->law, file->terms, elastic_only);
      out.terms.clear();
    }
  }
  constexpr double kUsual = 1000.0;
  if (out.bulk_Pa == 0.0) out.bulk_Pa = kUsual * youngs_modulus_Pa(out.law) / 3.0;
  return out;
}

double shortest_s(const std::vector<RubberTerm>& terms) {
  double out = HUGE_VAL;
  for (const RubberTerm& term : terms) out = std::min(out, term.tau_s);
  return out;
}

// The rows of one test; none if it diverged.
std::vector<CubeRow> rows_of(const std::string& card, const CubeTest& test,
                             const FoundSolver& found, LawProof& proof) {
  const CubeRunner& runner = *found.solver.cubes;
  const auto files = runner.files(card, test);
  proof.models.push_back({test.name + "/" + files[0].name, files[0].text});
  std::vector<CubeRow> rows;
  const bool has_finished =
      run_files(found, files, [&](const auto& folder) { rows = runner.rows(folder, test); });
  if (!has_finished) proof.diverged = test.name;
  return rows;
}

void run_each(const std::string& card, const std::vector<CubeTest>& tests, const WantedLaw& wanted,
              const ReadRubber& read, const FoundSolver& found, LawProof& proof) {
  const UnitSystem& units = *read.units;
  // Cubes of a card with terms are stretched so fast that no more than this relaxes.
  constexpr double kRelaxed = 1e-6;
  const bool relaxes = found.solver.cubes->has_memory && !wanted.terms.empty();
  double resolves = found.solver.resolves;
  if (relaxes) resolves = std::max(resolves, kRelaxed);
  for (CubeTest test : tests) {
    if (relaxes) test.ramp = to_card(kRelaxed * shortest_s(wanted.terms), units.time_exponent);
    test.stress = to_card(wanted.stress_Pa(test, test.top), units.stress_exponent);
    const auto rows = rows_of(card, test, found, proof);
    if (!proof.diverged.empty()) return;
    proof.cubes.push_back(compared(test, rows, wanted, units, resolves));
  }
  if (!relaxes) return;
  CubeTest hold = hold_of(wanted.terms, tests.front().top);
  const Course history = history_of(hold);
  hold.ramp = to_card(hold.ramp, units.time_exponent);
  for (double& end : hold.until) end = to_card(end, units.time_exponent);
  hold.stress = to_card(wanted.stress_Pa(hold, hold.top), units.stress_exponent);
  const auto rows = rows_of(card, hold, found, proof);
  if (!proof.diverged.empty()) return;
  const auto stresses_of = [&](bool is_projected) {
    return [&wanted, &history, is_projected](const std::vector<RubberTerm>& terms) {
      return relaxing_stress_Pa(wanted.law, terms, wanted.bulk_Pa, history, wanted.rule,
                                is_projected);
    };
  };
  // Versions of FEBio may push the branches forward either way.
  if (found.solver.name == "febio") {
    const auto one = stresses_of(false)(wanted.terms), other = stresses_of(true)(wanted.terms);
    for (std::size_t i = 0; i < one.size(); ++i)
      resolves = std::max(resolves, std::abs(other[i] / one[i] - 1.0));
  }
  proof.hold = compared_hold(history, rows, wanted.terms, stresses_of(false), units, resolves);
}

// All tests by one run.
void run_sfepy(const std::string& card, const std::string& target,
               const std::vector<CubeTest>& tests, const WantedLaw& wanted, const ReadRubber& read,
               const FoundSolver& found, LawProof& proof) {
  const std::string module =
      target == "sfepy"
          ? card
          : rubber_card(read.law, read.terms,
                        {.target = "sfepy", .units = read.units->name, .bulk_Pa = wanted.bulk_Pa});
  CubeTest hold;
  if (!read.terms.empty()) {
    hold = hold_of(read.terms, tests.front().top);
    const int exponent = read.units->time_exponent;
    CubeTest in_card = hold;
    in_card.ramp = to_card(hold.ramp, exponent);
    for (double& end : in_card.until) end = to_card(end, exponent);
    proof.models = sfepy_cubes(module, tests, &in_card);
  } else {
    proof.models = sfepy_cubes(module, tests, nullptr);
  }
  std::vector<std::vector<CubeRow>> rows;
  run_files(found, proof.models, [&](const auto& folder) {
    for (std::size_t i = 0; i <= tests.size(); ++i) rows.push_back(sfepy_rows(folder, i));
  });
  const double resolves = found.solver.resolves;
  for (std::size_t i = 0; i < tests.size(); ++i)
    proof.cubes.push_back(compared(tests[i], rows[i], wanted, *read.units, resolves));
  if (read.terms.empty()) return;
  const Course history = history_of(hold);
  const auto stresses_of = [&](const std::vector<RubberTerm>& terms) {
    auto all = nominal_stress_Pa(wanted.law, terms, Deformation::kUniaxial, history);
    all.erase(all.begin());
    return std::vector<double>(all.begin(), all.end());
  };
  proof.hold =
      compared_hold(history, rows.back(), wanted.terms, stresses_of, *read.units, resolves);
}

}  // namespace

bool LawProof::agrees() const {
  return diverged.empty() && (!hold || hold->agrees()) &&
         std::all_of(cubes.begin(), cubes.end(),
                     [](const CubeProof& cube) { return cube.agrees(); });
}

std::string LawProof::not_exercised() const {
  return viscard::not_exercised(constants, hold ? hold->terms : std::vector<TermProof>{});
}

std::vector<CubeTest> cube_tests(const HyperelasticLaw& law, const HyperelasticFile* file,
                                 double step) {
  std::vector<CubeTest> out;
  constexpr double kLeast = 0.02, kShare = 0.95;
  const auto add = [&](const std::string& name, Deformation deformation, double top) {
    const StableRange stable = stable_range(law, deformation);
    const double edge =
        top > 1.0 ? 1.0 + kShare * (stable.high - 1.0) : 1.0 - kShare * (1.0 - stable.low);
    top = top > 1.0 ? std::min(top, edge) : std::max(top, edge);
    if (std::abs(top - 1.0) > kLeast) out.push_back({name, deformation, top, steps_to(top, step)});
  };
  for (std::size_t d = 0; d < deformation_names().size(); ++d) {
    HyperelasticFile::Range measured;
    if (file != nullptr && file->measured[d]) measured = *file->measured[d];
    const bool is_pulled = measured.high > 1.0 + kLeast;
    add(deformation_names()[d], static_cast<Deformation>(d), is_pulled ? measured.high : kUsualTop);
    if (d == 0 && measured.low < 1.0 - kLeast)
      add("compression", Deformation::kUniaxial, measured.low);
  }
  constexpr double kConfinedTop = 1.05;
  if (!out.empty()) {
    out.push_back({.name = "confined",
                   .top = kConfinedTop,
                   .steps = steps_to(kConfinedTop, step),
                   .is_confined = true});
  }
  return out;
}

bool runs_law_of(const Solver& solver, const std::string& target) {
  return solver.cubes && (solver.name == target || runs_text_of(solver, target));
}

const Solver& law_solver_for(const std::string& name, const std::string& target) {
  std::vector<std::string> names;
  for (const Solver& solver : solvers()) {
    if (!solver.cubes) continue;
    const bool runs_text = runs_law_of(solver, target);
    if (solver.name == name && !runs_text && solver.cubes->files != nullptr) {
      throw std::invalid_argument("--solver " + name + " does not read cards of rubber for " +
                                  target + "; --solver sfepy runs the numbers of any card");
    }
    if (solver.name == name || (name.empty() && runs_text)) return solver;
    names.push_back(solver.name);
  }
  throw std::invalid_argument(
      name.empty() ? "viscard runs no solver that reads cards of rubber for " + target +
                         "; --solver sfepy runs the numbers that are read from the card"
                   : "--solver " + name + " runs no cards of rubber; " + listed(names) + " do");
}

std::string statement_of_law(const Solver& solver, const std::string& target) {
  return runs_law_of(solver, target) ? "" : statement_of(solver, target);
}

LawProof prove_law_card(const std::string& card, const std::string& target, const ReadRubber& read,
                        const HyperelasticFile* file, const std::string& elastic_only,
                        const FoundSolver& found) {
  WantedLaw wanted = wanted_of(read, file, elastic_only);
  if (read.terms.empty() && !wanted.terms.empty())
    throw std::runtime_error(
        "the card has no terms of relaxation and the law has " +
        std::to_string(wanted.terms.size()) +
        "; --elastic-only instantaneous or long-term states which law without them it should be");
  if (read.foam || (file != nullptr && file->foam)) {
    throw std::runtime_error(
        "the law is a foam, whose cubes viscard does not run, so that nothing would be proven of "
        "it; --check compares its constants");
  }
  if (read.damage || (file != nullptr && file->damage)) {
    throw std::runtime_error(std::string("the law has the damage by the first loading ") +
                             kMullinsName +
                             ", which no solver that viscard runs has, so that nothing would be "
                             "proven of it; --check compares its constants");
  }
  const CubeRunner& runner = *found.solver.cubes;
  wanted.rule = runner.rule;
  if (found.solver.name == "calculix" && wanted.law.form == HyperelasticForm::kArrudaBoyce)
    wanted.rule = VolumeRule::kLogarithmic;
  LawProof proof{.bulk_Pa = wanted.bulk_Pa};
  if (!runner.has_run) {
    proof.caution = found.solver.code +
                    " itself has never run these cubes here: running and reading were tested with "
                    "a stand-in, from its published source";
  }
  const std::vector<CubeTest> tests = cube_tests(wanted.law, file, runner.step);
  if (tests.empty())
    throw std::runtime_error("the law is not stable at any stretch that could be run");
  if (runner.files == nullptr) {
    run_sfepy(card, target, tests, wanted, read, found, proof);
  } else {
    run_each(card, tests, wanted, read, found, proof);
  }
  if (proof.diverged.empty()) {
    note_constants(wanted, proof);
    if (proof.hold)
      proof.constants.insert(proof.constants.end(), proof.hold->shares.begin(),
                             proof.hold->shares.end());
  }
  return proof;
}

}  // namespace viscard
