#include "io/cards/targets/calculix_proof.h"

#include "io/cards/card.h"
#include "io/cards/one_element.h"
#include "io/cards/targets/calculix_run.h"
#include "io/cards/targets/card_targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

// ccx prints seven digits, 5e-7 relative; the weights of the extrapolation, (8, -6, 1)/3, multiply
// their rounding by up to 5.
constexpr double kPrintedDigits = 3e-6;

// The value at a time, if the run has an increment there. ccx prints seven digits of the time and
// takes an elastic step in one increment even if it should take more.
const SolverSample* sample_at(double time_s, const std::vector<SolverSample>& samples) {
  const double margin_s = 1e-6 * time_s;
  const auto at = std::lower_bound(
      samples.begin(), samples.end(), time_s - margin_s,
      [](const SolverSample& sample, double limit_s) { return sample.time_s < limit_s; });
  return at == samples.end() || at->time_s > time_s + margin_s ? nullptr : &*at;
}

// Richardson extrapolation of steps h, h/2 and h/4: the terms of first, then of second order.
StepError compare(const std::vector<SolverRun>& runs, const Material& material,
                  const ElementTest& test) {
  StepError error{.resolved = kPrintedDigits};
  for (const SolverSample& coarse : runs[0].samples) {
    // The response to the first increments of the ramp is close to zero.
    if (coarse.time_s < test.ramp_s * (1.0 - 1e-6)) continue;
    const SolverSample* half = sample_at(coarse.time_s, runs[1].samples);
    const SolverSample* quarter = sample_at(coarse.time_s, runs[2].samples);
    if (half == nullptr || quarter == nullptr) {
      throw std::runtime_error(
          fmt::format("ccx printed no result at {:g} s with a smaller step", coarse.time_s));
    }
    const double expected = exact_response(material, test, coarse.time_s);
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

// Largest relative change of the answer to a test if the relaxation time of a term were longer.
double change_with_tau(const Material& material, std::size_t term, const ElementTest& test) {
  constexpr double kLonger = 1.1;
  Material changed = material;
  changed.terms[term].tau_s *= kLonger;
  double largest = 0.0, from_s = 0.0;
  for (const TimeBlock& block : test.blocks) {
    constexpr int kPoints = 4;
    for (int i = 1; i <= kPoints; ++i) {
      const double time_s = from_s + (block.end_s - from_s) * i / kPoints;
      if (time_s < test.ramp_s) continue;
      const double ratio =
          exact_response(changed, test, time_s) / exact_response(material, test, time_s);
      largest = std::max(largest, std::abs(ratio - 1.0));
    }
    from_s = block.end_s;
  }
  return largest;
}

void note_terms(const Material& material, const ElementTest& test, const StepError& error,
                CalculixProof& proof) {
  proof.terms.resize(material.terms.size());
  for (std::size_t i = 0; i < material.terms.size(); ++i) {
    TermProof& term = proof.terms[i];
    term.g = material.terms[i].g;
    term.tau_s = material.terms[i].tau_s;
    const double change = change_with_tau(material, i, test);
    term.change = std::max(term.change, change);
    term.is_exercised = term.is_exercised || change >= 2.0 * error.resolved;
  }
}

// Whether the card that viscard writes for the material runs to the end of the same test.
bool does_right_card_run(const Material& material, const UnitSystem& units,
                         const ElementTest& test) {
  try {
    const Card right =
        write_card(material, calculix_target(),
                   {.units = units.name, .may_approximate = true, .accepts_flags = true});
    return !run_in_calculix({.text = right.text, .written = material}, units, test).diverged;
  } catch (const std::invalid_argument&) {
    return false;  // no right card exists
  }
}

// Runs one test at the three steps, and notes a divergence instead of the last of them.
std::vector<SolverRun> run_at_three_steps(const Card& card, const UnitSystem& units,
                                          const ElementTest& test, CalculixProof& proof) {
  std::vector<SolverRun> runs;
  ElementTest refined = test;
  for (int i = 0; i < 3; ++i) {
    runs.push_back(run_in_calculix(card, units, refined));
    const SolverRun& run = runs.back();
    if (run.diverged) {
      proof.divergence =
          SolverDivergence{.test = test.kind == ElementTestKind::kCreep ? "creep" : "relaxation",
                           .reached_s = run.samples.empty() ? 0.0 : run.samples.back().time_s,
                           .is_card_blamed = does_right_card_run(card.written, units, refined)};
      break;
    }
    for (TimeBlock& block : refined.blocks) block.increments *= 2;
  }
  return runs;
}

}  // namespace

bool CalculixProof::exercises_all_terms() const {
  return std::all_of(terms.begin(), terms.end(),
                     [](const TermProof& term) { return term.is_exercised; });
}

CalculixProof prove_in_calculix(const std::string& card_text, const Material& material,
                                const UnitSystem& units, int steps_per_tau) {
  CalculixProof proof;
  const Card card{.text = card_text, .written = material};
  for (const ElementTestKind kind : {ElementTestKind::kRelaxation, ElementTestKind::kCreep}) {
    ElementTestOptions options = calculix_target().deck->test;
    options.kind = kind;
    options.steps_per_tau = steps_per_tau;
    const ElementTest test = element_test(material, options);
    const std::vector<SolverRun> runs = run_at_three_steps(card, units, test, proof);
    proof.end_s = test.end_s();
    proof.increments = static_cast<int>(runs[0].samples.size());
    if (proof.divergence) return proof;
    const StepError error = compare(runs, material, test);
    (kind == ElementTestKind::kCreep ? proof.creep : proof.relaxation) = error;
    note_terms(material, test, error, proof);
  }
  return proof;
}

}  // namespace viscard
