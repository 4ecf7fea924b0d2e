#include "io/basics/atomic_file.h"
#include "io/basics/words.h"
#include "io/cards/card.h"
#include "io/cards/card_numbers.h"
#include "io/cards/deck.h"
#include "io/cards/proof/certificate.h"
#include "io/cards/proof/solvers.h"
#include "io/cards/read_card.h"
#include "io/cards/targets/card_targets.h"
#include "io/cli/card/card_words.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/output_paths.h"
#include "io/cli/words/stop_on_signal.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <filesystem>
#include <ostream>

namespace viscard {
namespace {

std::string row_of(const char* test, const StepError& error) {
  return fmt::format(
      "  {:<11} {:.2e} at {:g} s{}; {:.2e} extrapolated to no step (resolves {:.1e})\n", test,
      error.at_step, error.worst_s,
      error.predicted ? fmt::format(" (backward Euler makes {:.2e})", *error.predicted) : "",
      error.remaining, error.resolved);
}

std::string text_of(const SolverDivergence& divergence, const std::string& code) {
  return fmt::format(
      "  {}: {} diverged after {:g} s\n{}", divergence.test, code, divergence.reached_s,
      divergence.is_card_blamed
          ? "the card does not hold: the card that viscard writes for this material runs to the "
            "end of the same test\n"
          : "nothing is proven: the right card of this material diverges too, a limit of the "
            "solver\n");
}

std::string verdict_of(const CardProof& proof, bool ran_card, const std::string& target) {
  if (!proof.agrees()) return "the card does not hold: the error stays at smaller steps\n";
  if (!proof.exercises_all()) {
    return "the answers agree, but nothing is proven of " + proof.not_exercised() +
           ", not exercised: an error there would be smaller than what the tests resolve\n";
  }
  if (!ran_card) {
    return "the numbers hold: the error vanishes with the step, and every constant was exercised; "
           "how " +
           target + " computes them is not proven\n";
  }
  return "the card holds: the error vanishes with the step, and "
         "every constant was exercised\n";
}

// The temperatures of the tests, for a material whose times change with temperature.
std::string temperature_of(const Material& material, const FoundSolver& found,
                           const CardProof& proof) {
  if (!material.shift || proof.divergence) return "";
  if (proof.temperature) {
    return row_of(fmt::format("at {:g} C", proof.temperature->at_C).c_str(),
                  proof.temperature->error);
  }
  return fmt::format("  temperature: {} ran the numbers of {:g} C alone; the shift is not proven\n",
                     found.solver.code, material.shift->T_ref_C);
}

void print_proof(const CardWords& words, const FoundSolver& found, const Material& material,
                 const CardProof& proof, const CardChain& chain, std::ostream& out) {
  const std::string statement = statement_of(found.solver, words.target);
  if (!statement.empty()) out << words.prove << ": " << statement << "\n";
  out << fmt::format(
      "{}: {} {} on one element, {} {} to {:g} s, against the exact answer "
      "of {}\n",
      words.prove, found.solver.code, found.version, proof.increments, found.solver.counted,
      proof.end_s, words.material.empty() ? "the card as read" : words.material);
  if (proof.divergence) {
    out << text_of(*proof.divergence, found.solver.code);
  } else {
    out << row_of("relaxation", proof.relaxation) << row_of("creep", proof.creep)
        << (proof.confined ? row_of("confined", *proof.confined) : "")
        << temperature_of(material, found, proof) << rows_of(proof.terms)
        << rows_of(proof.constants) << verdict_of(proof, statement.empty(), words.target);
  }
  if (*found.solver.caution != '\0') out << "  " << found.solver.caution << "\n";
  out << chain_in_words(chain);
}

// Which solver runs the card; what is not there to choose from is a wrong use.
const Solver& chosen_solver(const CardWords& words) {
  try {
    return solver_for(words.solver, words.target);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

void show_deck(ResultVisitor& v, const std::vector<std::string>& files, const std::string& run) {
  v("files", files, "that were written");
  v("run", run, "how to run them");
}

}  // namespace

std::vector<DescribedResult> results_of_proof() {
  const auto show_proof = [](ResultVisitor& v) {
    show_certificate(v, CertificateRequest{}, CardChain{}, {solvers().front(), "", ""},
                     CardProof{});
  };
  return {{"card-deck", "viscard card --deck", {[](ResultVisitor& v) { show_deck(v, {}, ""); }}},
          {"card-prove", "viscard card --prove; the certificate has the same keys", {show_proof}}};
}

int prove_card_file(const CardWords& words, Streams& streams) {
  if (!states_material(card_target(words.target))) {
    throw UsageError("--prove runs a material in time, and a card for " + words.target +
                     " states numbers over frequency; viscard card MATERIAL.json --check " +
                     quoted_for_shell({words.prove}) + " compares them");
  }
  const Solver& solver = chosen_solver(words);
  const CertificateRequest request{words.prove, card_text_of(words.prove, words), words.material,
                                   words.target};
  const std::string path =
      words.out.empty() ? words.prove + "." + solver.name + ".proof.json" : words.out;
  refuse_existing(path, words.force);
  const ReadCard read = read_card(request.card_text, card_target(words.target), words.units);
  Material material = read.material;
  std::vector<CardFinding> notes;
  if (!words.material.empty()) {
    material = stated_material(request.card_text, words, notes).material;
  }
  material = with_bulk_rule(material, read.understood.bulk);
  const FoundSolver found = find_solver(solver, words.solver_path);
  const WordsOnSignal words_on_signal(
      "the proof was stopped, and no certificate is written; the same command begins it again");
  const CardProof proof = prove_card(request.card_text, read, material, found);
  const CardChain chain = chain_of(request);
  return finish_proof(
      words, path, "viscard-card-prove/1", proof.holds(),
      [&](ResultVisitor& v) { show_certificate(v, request, chain, found, proof); },
      [&](std::ostream& out) { print_proof(words, found, material, proof, chain, out); }, streams);
}

int write_deck_files(const CardWords& words, Streams& streams) {
  if (words.out.empty()) throw UsageError("--deck needs --out FOLDER");
  const PreparedMaterial prepared = prepared_material(words);
  const Card card =
      write_card(prepared.material, card_target(words.target), card_options(words, prepared));
  const ElementTestKind kind =
      words.deck == "creep" ? ElementTestKind::kCreep : ElementTestKind::kRelaxation;
  const Deck deck = one_element_deck(card, card_deck(words.target),
                                     unit_system(words.units.empty() ? "SI" : words.units), kind);
  const std::filesystem::path folder = words.out;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::runtime_error(words.out + ": cannot make this folder: " + error.message());
  std::vector<std::string> files;
  for (const DeckFile& file : deck.files) refuse_existing(folder / file.name, words.force);
  for (const DeckFile& file : deck.files) {
    write_file(folder / file.name, file.text, words.force);
    files.push_back((folder / file.name).string());
  }
  if (words.json) {
    print_result(
        {"viscard-card-deck/1", {words.material}},
        [&](ResultVisitor& v) { show_deck(v, files, deck.how_to_run); }, streams);
    return kDone;
  }
  for (const std::string& file : files) streams.out << "wrote " << file << "\n";
  streams.out << "run it there with: " << deck.how_to_run << "\n";
  return kDone;
}

}  // namespace viscard
