#include "io/basics/atomic_file.h"
#include "io/cards/card.h"
#include "io/cards/card_numbers.h"
#include "io/cards/deck.h"
#include "io/cards/read_card.h"
#include "io/cards/targets/calculix_proof.h"
#include "io/cards/targets/card_targets.h"
#include "io/cli/card/card_words.h"
#include "io/cli/words/output_paths.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <ostream>

namespace viscard {
namespace {

nlohmann::ordered_json json_of(const StepError& error) {
  return {{"error", error.at_step},
          {"at_s", error.worst_s},
          {"extrapolated_error", error.remaining},
          {"resolved", error.resolved},
          {"vanishes_with_step", error.vanishes_with_step()}};
}

std::string row_of(const char* test, const StepError& error) {
  return fmt::format(
      "  {:<11} {:.2e} at {:g} s; {:.2e} extrapolated to no step (resolves {:.1e})\n", test,
      error.at_step, error.worst_s, error.remaining, error.resolved);
}

nlohmann::ordered_json json_of(const CalculixProof& proof, const std::string& card) {
  nlohmann::ordered_json json{{"card", card},
                              {"solver", "CalculiX"},
                              {"relaxation", json_of(proof.relaxation)},
                              {"creep", json_of(proof.creep)},
                              {"end_s", proof.end_s},
                              {"increments", proof.increments}};
  json["terms"] = nlohmann::ordered_json::array();
  for (const TermProof& term : proof.terms) {
    json["terms"].push_back({{"g", term.g},
                             {"tau_s", term.tau_s},
                             {"change_with_tau", term.change},
                             {"exercised", term.is_exercised}});
  }
  json["divergence"] = nullptr;
  if (const auto& divergence = proof.divergence) {
    json["divergence"] = {{"test", divergence->test},
                          {"reached_s", divergence->reached_s},
                          {"card_blamed", divergence->is_card_blamed}};
  }
  json["holds"] = proof.holds();
  return json;
}

std::string text_of(const SolverDivergence& divergence) {
  return fmt::format(
      "  {}: ccx diverged after {:g} s\n{}", divergence.test, divergence.reached_s,
      divergence.is_card_blamed
          ? "the card does not hold: the card that viscard writes for this material runs to the "
            "end of the same test\n"
          : "nothing is proven: the right card of this material diverges too, a limit of ccx\n");
}

std::string terms_of(const CalculixProof& proof) {
  std::string out;
  for (std::size_t i = 0; i < proof.terms.size(); ++i) {
    const TermProof& term = proof.terms[i];
    out += fmt::format(
        "  term {}: g = {:g}, tau = {:g} s: {}; a tau 10 % off changes the answer by {:.1e}\n",
        i + 1, term.g, term.tau_s, term.is_exercised ? "exercised" : "NOT exercised", term.change);
  }
  return out;
}

std::string verdict_of(const CalculixProof& proof) {
  if (!proof.agrees()) return "the card does not hold: the error stays at smaller steps\n";
  if (!proof.exercises_all_terms()) {
    return "the answers agree, but nothing is proven of the terms that were not exercised: an "
           "error in them would be smaller than what the tests resolve\n";
  }
  return "the card holds: the error goes with the step, as that of a rule of first order does, and "
         "every term was exercised\n";
}

}  // namespace

int prove_card_file(const CardWords& words, Streams& streams) {
  if (words.target != "calculix") {
    throw UsageError(
        "--prove runs cards for calculix only; for other solvers --deck writes a model");
  }
  const std::string text = read_file(words.prove);
  const ReadCard read = read_card(text, card_target("calculix"), words.units);
  Material material = read.material;
  if (!words.material.empty()) material = prepared_material(words).material;
  material = with_bulk_rule(material, BulkRule::kConstantBulk);
  const CalculixProof proof = prove_in_calculix(text, material, read.units);
  if (words.json) {
    streams.out << json_of(proof, words.prove).dump(2) << "\n";
  } else {
    streams.out << fmt::format(
        "{}: CalculiX on one element, {} increments to {:g} s, against the exact "
        "answer of {}\n",
        words.prove, proof.increments, proof.end_s,
        words.material.empty() ? "the card as read" : words.material);
    if (proof.divergence) {
      streams.out << text_of(*proof.divergence);
    } else {
      streams.out << row_of("relaxation", proof.relaxation) << row_of("creep", proof.creep)
                  << terms_of(proof) << verdict_of(proof);
    }
  }
  return proof.holds() ? kDone : kFailed;
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
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  for (const DeckFile& file : deck.files) refuse_existing(folder / file.name, words.force);
  for (const DeckFile& file : deck.files) {
    write_file(folder / file.name, file.text, words.force);
    files.push_back((folder / file.name).string());
  }
  if (words.json) {
    streams.out << nlohmann::ordered_json{{"files", files}, {"run", deck.how_to_run}}.dump(2)
                << "\n";
    return kDone;
  }
  for (const auto& file : files) streams.out << "wrote " << file.get<std::string>() << "\n";
  streams.out << "run it there with: " << deck.how_to_run << "\n";
  return kDone;
}

}  // namespace viscard
