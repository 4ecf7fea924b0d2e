#pragma once

#include "io/cards/proof/solver.h"
#include "io/cards/read_card.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

class ResultVisitor;

// Runs a card in a solver on one element and compares with the exact answer. Where the solver's test
// allows, the load rises in every block of a doubled time (one_element.h): then every term is loaded
// in its own decade, with increments that start again from the size of the block.

// Error of one test, relative to the exact answer, after the first ramp.
struct StepError {
  double at_step = 0.0;    // at the coarsest of the three steps
  double worst_s = 0.0;    // time of that error
  double remaining = 0.0;  // after extrapolation of the three steps to zero
  // The smallest error that the test can distinguish from that of the step: the last correction of
  // the extrapolation, or what its output and its strain resolve.
  double resolved = 0.0;
  // What backward Euler makes at the coarsest step, computed without the solver.
  std::optional<double> predicted;

  // The error of a right card vanishes with the step. That of a wrong card remains.
  bool vanishes_with_step() const { return remaining <= resolved; }
};

// Shows if the proof would have noticed a wrong term.
struct TermProof {
  double g = 0.0, tau_s = 0.0;
  double change = 0.0;        // largest relative change of an answer if tau were a tenth longer
  bool is_exercised = false;  // that change is at least twice what the test resolves
};
void show_keys(ResultVisitor& v, const TermProof& term);

// Any other constant of a card, and whether a tenth of it would have been noticed.
struct ConstantProof {
  std::string name;
  double value = 0.0;         // moduli in Pa
  double change = 0.0;        // largest relative change of an answer if it were a tenth larger
  bool is_exercised = false;  // that change is at least twice what the test resolves
  std::string seen_by;        // the test of that change; of the density "read back"
};
void show_keys(ResultVisitor& v, const ConstantProof& constant);
// "nu, tau_2": what no test exercised; empty if all were.
std::string not_exercised(const std::vector<ConstantProof>& constants,
                          const std::vector<TermProof>& terms);

// Relaxation at another temperature than the reference of the card's shift.
struct TemperatureProof {
  double at_C = 0.0;
  StepError error;
};

struct SolverDivergence {
  std::string test;  // "relaxation", "creep", "confined" or "temperature"
  double reached_s = 0.0;
  // True if the same test runs to the end with the card that viscard writes for this material: then
  // the numbers of the given card are wrong. Otherwise the cause may be a limit of the solver.
  bool is_card_blamed = false;
};

struct CardProof {
  StepError relaxation, creep;
  std::optional<StepError> confined;  // with held sides; absent at nu = 0.5
  // Absent if the material has no shift, or the solver does not read it from the card.
  std::optional<TemperatureProof> temperature;
  std::vector<TermProof> terms;
  std::vector<ConstantProof> constants;        // moduli, shares and density; times stand in `terms`
  std::optional<SolverDivergence> divergence;  // if set, the errors above are not filled
  double end_s = 0.0;                          // end of the tests
  int increments = 0;                          // of each test at the coarsest step
  std::vector<DeckFile> models;                // as run at the coarsest step, by test

  bool agrees() const {
    return !divergence && relaxation.vanishes_with_step() && creep.vanishes_with_step() &&
           (!confined || confined->vanishes_with_step()) &&
           (!temperature || temperature->error.vanishes_with_step());
  }
  bool exercises_all() const { return not_exercised().empty(); }
  std::string not_exercised() const { return viscard::not_exercised(constants, terms); }
  // Of a solver that reads the card: the card is proven. Of another one: its numbers are.
  bool holds() const { return agrees() && exercises_all(); }
};

// The error of backward Euler in simple tension at constant Poisson ratio: the largest one relative
// to the exact answer after the first ramp.
double backward_euler_error(const Material& material, const ElementTest& test);

// Whether the solver reads the text of cards for this target; others run the numbers that were read.
bool runs_text_of(const Solver& solver, const std::string& target);
// The first line about a run of another solver than the card's: "" if it is that.
std::string statement_of(const Solver& solver, const std::string& target);

// Runs all tests at three steps: steps_per_tau in the shortest relaxation time (0: as many as the
// solver's test has), twice and four times as many; a card with a shift also 10 K warmer. `material` is what the card should be, under
// the bulk rule of the card. Throws what run_solver() throws.
CardProof prove_card(const std::string& card_text, const ReadCard& read, const Material& material,
                     const FoundSolver& found, int steps_per_tau = 0);

}  // namespace viscard
