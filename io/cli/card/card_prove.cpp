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
          {"vanishes_with_step", error.vanishes_with_step()}};
}

std::string row_of(const char* test, const StepError& error) {
  return fmt::format("  {:<11} {:.2e} at {:g} s; {:.2e} extrapolated to no step\n", test,
                     error.at_step, error.worst_s, error.remaining);
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
    const nlohmann::ordered_json json{{"card", words.prove},
                                      {"solver", "CalculiX"},
                                      {"relaxation", json_of(proof.relaxation)},
                                      {"creep", json_of(proof.creep)},
                                      {"end_s", proof.end_s},
                                      {"increments", proof.increments},
                                      {"holds", proof.holds()}};
    streams.out << json.dump(2) << "\n";
  } else {
    streams.out << fmt::format(
                       "{}: CalculiX on one element, {} increments to {:g} s, against the exact "
                       "answer of {}\n",
                       words.prove, proof.increments, proof.end_s,
                       words.material.empty() ? "the card as read" : words.material)
                << row_of("relaxation", proof.relaxation) << row_of("creep", proof.creep)
                << (proof.holds() ? "the card holds: the error goes with the step, as that of a "
                                    "rule of first order does\n"
                                  : "the card does not hold: the error stays at smaller steps\n");
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
