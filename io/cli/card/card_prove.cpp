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
#include "io/materials/hyperelastic_file.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <ostream>
#include <stdexcept>

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

// What a verdict names, of a series and of a law of rubber.
struct ProofWords {
  const char *right, *wrong, *answers, *tests;
};
constexpr ProofWords kOfSeries{"the error vanishes with the step",
                               "the error stays at smaller steps", "answers", "tests"};
constexpr ProofWords kOfLaw{"every stress is that of the law", "its stress is not that of the law",
                            "stresses", "run"};

template <typename Proof>
std::string verdict_of(const Proof& proof, const ProofWords& of, bool ran_card,
                       const std::string& target) {
  if (!proof.agrees()) return std::string("the card does not hold: ") + of.wrong + "\n";
  if (!proof.exercises_all()) {
    return fmt::format(
        "the {} agree, but nothing is proven of {}, not exercised: an error there would be smaller "
        "than what the {} resolve{}\n",
        of.answers, proof.not_exercised(), of.tests, &of == &kOfLaw ? "s" : "");
  }
  const std::string all = std::string(of.right) + ", and every constant was exercised";
  return ran_card
             ? "the card holds: " + all + "\n"
             : "the numbers hold: " + all + "; how " + target + " computes them is not proven\n";
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
        << rows_of(proof.constants)
        << verdict_of(proof, kOfSeries, statement.empty(), words.target);
  }
  if (*found.solver.caution != '\0') out << "  " << found.solver.caution << "\n";
  out << chain_in_words(chain);
}

// What was done to the law, by the header of a card by viscard.
std::string stated_elastic_only(const std::string& text) {
  if (text.find("left out, the law after all relaxation kept") != std::string::npos)
    return "long-term";
  return text.find("left out, the law at once kept") != std::string::npos ? "instantaneous" : "";
}

void print_proof(const CardWords& words, const FoundSolver& found,
                 const std::optional<HyperelasticFile>&, const LawProof& proof,
                 const CardChain& chain, std::ostream& out) {
  const std::string statement = statement_of_law(found.solver, words.target);
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
      << (proof.diverged.empty()
              ? verdict_of(proof, kOfLaw, statement.empty(), words.target)
              : "nothing is proven: the " + proof.diverged + " cube did not converge\n");
  if (!proof.caution.empty()) out << "  " << proof.caution << "\n";
  out << chain_in_words(chain);
}

// Which solver runs the card; what is not there to choose from is a wrong use.
const Solver& chosen_solver(const CardWords& words) {
  try {
    return words.is_law ? law_solver_for(words.solver, words.target)
                        : solver_for(words.solver, words.target);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

// The card, and the path of its certificate, which must not be there.
CertificateRequest request_of(const CardWords& words, const Solver& solver, std::string& path) {
  path = words.out.empty() ? words.prove + "." + solver.name + ".proof.json" : words.out;
  refuse_existing(path, words.force);
  return {words.prove, card_text_of(words.prove, words), words.material, words.target};
}

// Prints and writes what a proof has found.
template <typename Material, typename Proof>
int certified(const CardWords& words, const std::string& path, const char* schema,
              const CertificateRequest& request, const FoundSolver& found, const Material& material,
              const Proof& proof, Streams& streams) {
  const CardChain chain = chain_of(request);
  return finish_proof(
      words, path, schema, proof.holds(),
      [&](ResultVisitor& v) { show_certificate(v, request, chain, found, proof); },
      [&](std::ostream& out) { print_proof(words, found, material, proof, chain, out); }, streams);
}

// The keys of the certificate of a proof.
template <typename Proof>
auto shown(const Proof& proof) {
  return [proof](ResultVisitor& v) {
    show_certificate(v, CertificateRequest{}, CardChain{}, {solvers().front(), "", ""}, proof);
  };
}

void show_deck(ResultVisitor& v, const std::vector<std::string>& files, const std::string& run) {
  v("files", files, "that were written");
  v("run", run, "how to run them");
}

}  // namespace

std::vector<DescribedResult> results_of_proof() {
  return {{"card-deck", "viscard card --deck", {[](ResultVisitor& v) { show_deck(v, {}, ""); }}},
          {"card-prove",
           "viscard card --prove; the certificate has the same keys",
           {shown(CardProof{})}}};
}

DescribedResult result_of_law_proof() {
  return {"card-rubber-prove",
          "viscard card --prove of a card of rubber; the certificate has the same keys",
          {shown(LawProof{})}};
}

int prove_card_file(const CardWords& words, Streams& streams) {
  if (!states_material(card_target(words.target))) {
    throw UsageError("--prove runs a material in time, and a card for " + words.target +
                     " states numbers over frequency; viscard card MATERIAL.json --check " +
                     quoted_for_shell({words.prove}) + " compares them");
  }
  const Solver& solver = chosen_solver(words);
  std::string path;
  const CertificateRequest request = request_of(words, solver, path);
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
  return certified(words, path, "viscard-card-prove/1", request, found, material, proof, streams);
}

int prove_law_file(const CardWords& words, Streams& streams) {
  const Solver& solver = chosen_solver(words);
  std::string path;
  const CertificateRequest request = request_of(words, solver, path);
  std::optional<HyperelasticFile> file;
  if (!words.material.empty()) file = read_hyperelastic(words.material, words.plausible);
  const std::string& text = request.card_text;
  const FoundSolver found = find_solver(solver, words.solver_path);
  const LawProof proof = [&] {
    try {
      return prove_law_card(
          text, words.target, read_rubber_card(text, words.target, words.units),
          file ? &*file : nullptr,
          words.elastic_only.empty() ? stated_elastic_only(text) : words.elastic_only, found);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(words.prove + ": " + error.what());
    }
  }();
  return certified(words, path, "viscard-card-rubber-prove/1", request, found, file, proof,
                   streams);
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
