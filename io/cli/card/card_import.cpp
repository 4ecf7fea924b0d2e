#include "io/basics/atomic_file.h"
#include "io/basics/program.h"
#include "io/basics/sha256.h"
#include "io/basics/timestamp.h"
#include "io/basics/words.h"
#include "io/basics/written_path.h"
#include "io/cards/byte_order_mark.h"
#include "io/cards/card_sum.h"
#include "io/cards/check_card.h"
#include "io/cards/hyperelastic/check_rubber.h"
#include "io/cards/targets/card_targets.h"
#include "io/cli/card/card_words.h"
#include "io/cli/words/json_output.h"
#include "io/materials/hyperelastic_file.h"
#include "io/materials/material_file.h"
#include "io/materials/material_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <ostream>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace viscard {
namespace {

// What was received: of several materials in a file the text of one, and what is known of the whole.
struct ReceivedCard {
  std::string text, sha256;
  std::optional<CardFinding> doubt;  // by the sum of the whole
  bool is_edited() const { return doubt && doubt->name != kUncheckedCardFlag; }
  // Why an edit could not be seen, for whatever the card becomes; "": it states a sum.
  std::string unchecked() const {
    return doubt && !is_edited() ? "of the card that it was read from: " + doubt->text : "";
  }
};

ReceivedCard received(const CardWords& words) {
  const std::string whole = read_file(words.material);
  return {card_text_of(words.material, words), sha256_of_text(whole),
          sum_finding(without_byte_order_mark(whole), false)};
}

// What a card became.
struct ImportedCard {
  std::string json;  // the material file, or that of a law of rubber
  std::string law;   // "linear", or the name of the law of rubber
  std::vector<CardFinding> findings;
};

void show_import(ResultVisitor& v, const ImportedCard& imported, const CardWords& words) {
  v("card", words.material, "the card");
  v("target", words.target, "its solver");
  v("out", words.import_to, "the material file");
  v("law", imported.law, "linear, or the name of the law of rubber");
  v("findings", imported.findings, "what was noticed in the card");
}

// A wrong card, or one of unknown units, would become a wrong material.
void require_right(const std::vector<CardFinding>& findings, bool units_are_known,
                   const std::string& card) {
  std::string mistakes;
  for (const CardFinding& finding : findings) {
    if (finding.is_mistake) mistakes += "\n  " + finding.name + ": " + finding.text;
  }
  if (!mistakes.empty())
    throw std::runtime_error(card + ": is not imported, the card is wrong:" + mistakes);
  if (!units_are_known) {
    throw std::runtime_error(card +
                             ": does not state its units; name them with --units (SI, mm-t-s ...)");
  }
}

// The flags that the header of a card by viscard states: "flag edited: ...", "flag few-rows (term 2): ...".
std::vector<MaterialFlag> flags_of_header(const std::string& card) {
  static const std::regex kFlag(
      R"(^[^A-Za-z]*flag ([a-zA-Z0-9-]+)(?: \(term (\d{1,3})\))?: (.*[^\s*/>-]))");
  std::vector<MaterialFlag> flags;
  std::istringstream lines(card);
  for (std::string line; std::getline(lines, line);) {
    constexpr std::size_t kLongest = 1000;  // of a line of a header
    std::smatch found;
    if (line.size() > kLongest || !std::regex_search(line, found, kFlag)) continue;
    flags.push_back({found[1], found[2].matched ? std::stoi(found[2]) : 0, found[3]});
  }
  return flags;
}

// A card whose header states another sum or none, even if no reader notices what was changed.
void note_doubt(const ReceivedCard& card, std::vector<CardFinding>& findings) {
  if (!card.doubt) return;
  const auto is_noted = [&](const CardFinding& finding) {
    return finding.name == card.doubt->name;
  };
  if (std::none_of(findings.begin(), findings.end(), is_noted)) findings.push_back(*card.doubt);
}

ImportedCard import_linear(const ReceivedCard& card, const CardWords& words) {
  const std::string& text = card.text;
  const CardTarget& target = card_target(words.target);
  if (!states_material(target)) {
    throw std::runtime_error(words.material + ": a card for " + target.name +
                             " is a table or a reduction, from which no material can be read");
  }
  CardCheck check =
      check_card(text, target, {.units = words.units, .plausible = words.plausible}, nullptr);
  require_right(check.findings, check.read.units_were_stated || !words.units.empty(),
                words.material);
  note_doubt(card, check.findings);
  Material material = check.read.material;
  if (material.name.empty()) material.name = std::filesystem::path(words.material).stem().string();
  if (material.shift) material.T_ref_C = material.shift->T_ref_C;
  material.flags = flags_of_header(text);
  const auto add_once = [&](const char* name, const std::string& why) {
    const auto is_there = [&](const MaterialFlag& flag) { return flag.name == name; };
    if (std::none_of(material.flags.begin(), material.flags.end(), is_there))
      material.flags.push_back({name, 0, why});
  };
  if (card.is_edited()) add_once(kEdited, "the card was edited since it was written by viscard");
  if (!card.unchecked().empty()) add_once(kUncheckedCardFlag, card.unchecked());
  material.flags.push_back({"imported", 0,
                            "read from a card for " + check.read.understood.code +
                                "; no data and no intervals stand behind it"});
  if (has_unread_parts(check.findings))
    material.flags.push_back({"not-all-read", 0, "the card has parts that viscard does not read"});
  material.provenance.created_by = program_with_version();
  if (!words.is_reproducible) {
    material.provenance.created_at = now_iso8601();
    material.provenance.command = words.command_line;
  }
  material.provenance.raw_files = {{written_path(words.material), card.sha256}};
  return {json_from_material(material), "linear", check.findings};
}

ImportedCard import_rubber(const ReceivedCard& card, const CardWords& words) {
  const std::string& text = card.text;
  RubberCheck check = check_rubber_card(
      text, nullptr, {.target = words.target, .units = words.units, .plausible = words.plausible});
  const ReadRubber& read = check.read;
  require_right(check.findings, read.units_were_stated || !words.units.empty(), words.material);
  note_doubt(card, check.findings);
  HyperelasticFile file;
  file.law = read.law;
  file.foam = read.foam;
  file.terms = read.terms;
  file.damage = read.damage;
  if (read.bulk_Pa > 0.0 && !read.foam) file.bulk_Pa = read.bulk_Pa;
  if (read.density_kg_m3 > 0.0) file.density_kg_m3 = read.density_kg_m3;
  file.raw_files = {{written_path(words.material), card.sha256}};
  // As its sum shows or its header states.
  file.is_edited = card.is_edited() || text.find(kEditedText) != std::string::npos;
  file.card_doubt = card.unchecked();
  return {json_from_card_of_rubber(file), name_of(read), check.findings};
}

}  // namespace

DescribedResult result_of_import() {
  return {"card-import", "viscard card --import", {[](ResultVisitor& v) {
            show_import(v, ImportedCard{}, CardWords{});
          }}};
}

int import_card_file(CardWords words, Streams& streams) {
  const ReceivedCard card = received(words);
  const std::string& text = card.text;
  const std::string rubber = stated_rubber_target(text);
  if (words.target.empty()) words.target = rubber;
  if (const CardTarget* linear = stated_card_target(text);
      words.target.empty() && linear != nullptr)
    words.target = linear->name;
  if (words.target.empty()) {
    throw UsageError(words.material +
                     " does not name its solver, as cards by viscard do; add --for "
                     "TARGET ('viscard card --list' shows the targets)");
  }
  const ImportedCard imported = [&] {
    try {
      return looks_like_rubber_card(text) ? import_rubber(card, words) : import_linear(card, words);
    } catch (const std::runtime_error& error) {
      const std::string what = error.what();
      if (what.rfind(words.material, 0) == 0) throw;
      throw std::runtime_error(words.material + ": " + what);
    }
  }();
  // What a reader of the file would refuse is refused here, before it is written.
  if (imported.law == "linear")
    (void)material_from_json(imported.json, words.material, words.plausible);
  else
    (void)hyperelastic_from_json(imported.json, words.material, words.plausible);
  write_file(words.import_to, imported.json, words.force);
  for (const CardFinding& finding : imported.findings)
    streams.err << "viscard: note: " << finding.name << ": " << finding.text << "\n";
  if (words.json) {
    print_result(
        {"viscard-card-import/1", {words.material}},
        [&](ResultVisitor& v) { show_import(v, imported, words); }, streams);
    return kDone;
  }
  streams.out << "wrote " << words.import_to << ": "
              << (imported.law == "linear" ? std::string("a linear material")
                                           : "a law of rubber, " + imported.law)
              << (has_unread_parts(imported.findings) ? ", of what was read of the card" : "")
              << "\n";
  return kDone;
}

}  // namespace viscard
