#pragma once

#include "io/cards/hyperelastic/read_rubber.h"
#include "io/cards/proof/card_proof.h"
#include "io/cards/proof/solver_cubes.h"
#include "io/materials/hyperelastic_file.h"

#include <string>
#include <vector>

namespace viscard {

// One stretched cube, beside the closed form (cube_stress.h).
struct CubeProof {
  CubeTest test;
  int compared = 0;         // steps; the others were out of balance by more than is resolved
  double error = 0.0;       // largest, relative to the exact stress
  double at_stretch = 1.0;  // where
  double resolved = 0.0;    // the smallest error that the run shows

  bool agrees() const { return error <= resolved && 2 * compared > test.steps; }  // false for nan
};

// The memory of a card: a ramp and a hold beside nominal_stress_Pa() of finite_viscoelasticity.h.
struct HoldProof {
  double end_s = 0.0;
  double error = 0.0, at_s = 0.0, resolved = 0.0;
  std::vector<TermProof> terms;       // their times
  std::vector<ConstantProof> shares;  // their g

  bool agrees() const { return error <= resolved; }
};

// What a run showed.
struct LawProof {
  std::vector<CubeProof> cubes;
  std::optional<HoldProof> hold;  // if the card has terms that the solver runs
  std::vector<ConstantProof> constants;
  double bulk_Pa = 0.0;  // of the cubes
  std::string caution;   // what to know before trusting a run of this solver; ""
  std::string diverged;  // the test that did not converge; the numbers above are not filled then
  std::vector<DeckFile> models;

  bool agrees() const;
  bool exercises_all() const { return not_exercised().empty(); }
  std::string not_exercised() const;  // "bulk modulus, tau_2"; empty if all were
  bool holds() const { return agrees() && exercises_all(); }
};

// Stretches that are run, and a confined cube to 1.05:
// those that `file` has measured, else up to 1.8, but not beyond 0.95 of the stable
// range of the law; in steps of `step`, but at least 10 and at most 80.
std::vector<CubeTest> cube_tests(const HyperelasticLaw& law, const HyperelasticFile* file,
                                 double step);

// True if the solver runs the text of cards of laws of rubber for this target; SfePy runs the numbers of others.
bool runs_law_of(const Solver& solver, const std::string& target);
// The solver of that name, or if it is empty the one that runs the text of these cards. Throws std::invalid_argument
// naming those that there are.
const Solver& law_solver_for(const std::string& name, const std::string& target);
// The first line about a run of another solver than the card's: "" if it is that.
std::string statement_of_law(const Solver& solver, const std::string& target);

// Runs a card. calculix, febio and mtest read the text of theirs; sfepy imports those of sfepy, and a module with the
// numbers that were read from any other. `file` is what the card should be; without it the card is compared with
// its own numbers. Throws std::invalid_argument for a solver that cannot run the card, and what run_files() throws.
LawProof prove_law_card(const std::string& card, const std::string& target, const ReadRubber& read,
                        const HyperelasticFile* file, const std::string& elastic_only,
                        const FoundSolver& found);

}  // namespace viscard
