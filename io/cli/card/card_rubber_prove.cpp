#include "io/basics/atomic_file.h"
#include "io/basics/words.h"
#include "io/cards/hyperelastic/proof/rubber_certificate.h"
#include "io/cards/hyperelastic/rubber_card.h"
#include "io/cards/proof/solvers.h"
#include "io/cli/card/card_words.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/output_paths.h"
#include "io/materials/hyperelastic_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <stdexcept>

namespace viscard {
namespace {

// What was done to the law, by the header of a card by viscard.
std::string stated_elastic_only(const std::string& text) {
  if (text.find("left out, the law after all relaxation kept") != std::string::npos)
    return "long-term";
  return text.find("left out, the law at once kept") != std::string::npos ? "instantaneous" : "";
}

const Solver& rubber_solver(const CardWords& words) {
  const auto& known = rubber_solvers();
  std::string name = words.solver;
  for (const std::string& solver : known) {
    if (name.empty() && runs_text_of(solver, words.target)) name = solver;
  }
  if (name.empty()) {
    throw UsageError("viscard runs no solver that reads cards of rubber for " + words.target +
                     "; --solver sfepy runs the numbers that are read from the card");
  }
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw UsageError("--solver " + name + " runs no cards of rubber; " + listed(known) + " do");
  if (name == "sfepy") return solver_for(name, "");
  if (!runs_text_of(name, words.target)) {
    throw UsageError("--solver " + name + " does not read cards of rubber for " + words.target +
                     "; --solver sfepy runs the numbers of any card");
  }
  return solver_for(name, words.target);
}

std::string verdict_of(const RubberProof& proof, bool ran_card, const std::string& target) {
  if (!proof.diverged.empty()) {
    return "nothing is proven: the " + proof.diverged + " cube did not converge\n";
  }
  if (!proof.agrees()) return "the card does not hold: its stress is not that of the law\n";
  if (!proof.exercises_all()) {
    return "the stresses agree, but nothing is proven of " + proof.not_exercised() +
           ", not exercised: an error there would be smaller than what the run resolves\n";
  }
  if (!ran_card) {
    return "the numbers hold: every stress is that of the law, and every constant was exercised; "
           "how " +
           target + " computes them is not proven\n";
  }
  return "the card holds: every stress is that of the law, and every constant was exercised\n";
}

void print_rubber_proof(const CardWords& words, const FoundSolver& found, const RubberProof& proof,
                        const CardChain& chain, std::ostream& out) {
  const std::string statement = statement_of_rubber(found.solver, words.target);
  if (!statement.empty()) out << words.prove << ": " << statement << "\n";
  out << fmt::format(
      "{}: {} {} on one cube, bulk modulus {:.6g} Pa, against the closed form of {}\n", words.prove,
      found.solver.code, found.version, proof.bulk_Pa,
      words.material.empty() ? "the card as read" : words.material);
  for (const CubeProof& cube : proof.cubes) {
    out << fmt::format(
        "  {:<12} to a stretch of {:.4g}, {} of {} steps compared: {:.1e} at {:.4g} (resolves "
        "{:.1e})\n",
        cube.test.name, cube.test.top, cube.compared, cube.test.steps, cube.error, cube.at_stretch,
        cube.resolved);
  }
  if (proof.hold) {
    out << fmt::format("  {:<12} ramp and hold to {:g} s: {:.1e} at {:g} s (resolves {:.1e})\n",
                       "relaxation", proof.hold->end_s, proof.hold->error, proof.hold->at_s,
                       proof.hold->resolved);
  }
  out << rows_of(proof.constants) << (proof.hold ? rows_of(proof.hold->terms) : "")
      << verdict_of(proof, statement.empty(), words.target);
  if (!proof.caution.empty()) out << "  " << proof.caution << "\n";
  out << chain_in_words(chain);
}

}  // namespace

DescribedResult result_of_rubber_proof() {
  const auto show = [](ResultVisitor& v) {
    show_certificate(v, CertificateRequest{}, CardChain{}, {solvers().front(), "", ""},
                     RubberProof{});
  };
  return {"card-rubber-prove",
          "viscard card --prove of a card of rubber; the certificate has the same keys",
          {show}};
}

int prove_rubber_file(const CardWords& words, Streams& streams) {
  const Solver& solver = rubber_solver(words);
  const std::string path =
      words.out.empty() ? words.prove + "." + solver.name + ".proof.json" : words.out;
  refuse_existing(path, words.force);
  const std::string text = card_text_of(words.prove, words);
  std::optional<HyperelasticFile> file;
  if (!words.material.empty()) file = read_hyperelastic(words.material, words.plausible);
  const std::string elastic_only =
      words.elastic_only.empty() ? stated_elastic_only(text) : words.elastic_only;
  const FoundSolver found = find_solver(solver, words.solver_path);
  const RubberProof proof = [&] {
    try {
      const ReadRubber read = read_rubber_card(text, words.target, words.units);
      return prove_rubber_card(text, words.target, read, file ? &*file : nullptr, elastic_only,
                               found);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(words.prove + ": " + error.what());
    }
  }();
  const CertificateRequest request{words.prove, text, words.material, words.target};
  const CardChain chain = chain_of(request);
  return finish_proof(
      words, path, "viscard-card-rubber-prove/1", proof.holds(),
      [&](ResultVisitor& v) { show_certificate(v, request, chain, found, proof); },
      [&](std::ostream& out) { print_rubber_proof(words, found, proof, chain, out); }, streams);
}

}  // namespace viscard
