#pragma once

#include "io/cards/card.h"
#include "io/cards/read_card.h"
#include "io/cli/words/streams.h"
#include "io/flow/card_material.h"
#include "io/results/result_schema.h"
#include "models/quantities/plausible.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

struct CardChain;
struct ConstantProof;
struct TermProof;

// viscard card: writes a material card for a solver, lists targets, checks cards, proves them.
int run_card(const Words& words, Streams& streams);

// What the user asked of `viscard card`, checked.
struct CardWords {
  std::string material;  // path; empty for --list, and where --check goes without
  std::string target;
  std::string units;  // empty: not named
  std::string out;
  std::string check, prove, deck, verify;
  std::string material_name;        // of several materials in a card; empty: there is one
  std::string import_to;            // the material file that a card becomes
  std::string solver, solver_path;  // of --prove; empty: the one that reads the card, from PATH
  std::string bound;                // "", "lower", "upper"
  std::string elastic_only;         // "", "instantaneous", "long-term"
  std::optional<int> terms;
  std::optional<double> clamped_nu;
  std::optional<double> tolerance;
  std::optional<double> ratio;  // of a joint fit
  std::optional<double> temperature_C;
  std::optional<double> bulk_Pa, density_kg_m3;  // of a law of rubber
  std::optional<std::string> band_text;          // as typed
  std::optional<FrequencyBand> band;
  bool may_extrapolate = false;
  bool list = false, is_long = false, force = false, json = false, is_reproducible = false;
  bool accepts_flags = false, may_approximate = false;
  std::string command_line;
  Plausible plausible = Plausible::kMeasured;
  bool is_law = false;  // the card or the material is a law of rubber
};

// What a check has found.
struct CheckedCard {
  const std::vector<CardFinding>& findings;
  bool agrees = true;
  bool is_compared = false;  // with the other
  double tolerance = 0.0;    // relative
  const char* other = "material";
};
// In words; every interface shows them.
std::string verdict_of(const CheckedCard& card);
// Ends the line of a card without mistakes that was not compared; otherwise empty.
std::string verdict_hint(const CheckedCard& card);

// The text of a card that somebody sent: of several materials in it the one that the words name.
std::string card_text_of(const std::string& path, const CardWords& words);
// The material that the words name; checks that a mixing ratio is given where it is needed. Throws
// UsageError, and what prepare_card_material() throws.
PreparedMaterial prepared_material(const CardWords& words);
// The same, changed as the header of a card by viscard states (fewer terms, a bound, one
// temperature, nu clamped ...), unless the options request something else; a note reports the
// change.
PreparedMaterial stated_material(const std::string& card, const CardWords& words,
                                 std::vector<CardFinding>& notes);
CardOptions card_options(const CardWords& words, const PreparedMaterial& prepared);

// "  chain: ..." of --prove and --verify, one line.
std::string chain_in_words(const CardChain& chain);
// Lines of the terms and constants that a proof exercised or not.
std::string rows_of(const std::vector<TermProof>& terms);
std::string rows_of(const std::vector<ConstantProof>& constants);
// Writes the certificate to the path and prints its keys with --json; `print` prints a text without.
int finish_proof(const CardWords& words, const std::string& path, const char* schema, bool holds,
                 const std::function<void(ResultVisitor&)>& show,
                 const std::function<void(std::ostream&)>& print, Streams& streams);
int verify_file(const CardWords& words, Streams& streams);
// What it prints with --json.
DescribedResult result_of_verify();

int list_card_targets(const CardWords& words, Streams& streams);
// --import: the card, named in the place of the material, becomes a material file.
int import_card_file(CardWords words, Streams& streams);
DescribedResult result_of_import();
int write_card_file(const CardWords& words, Streams& streams);
int check_card_file(const CardWords& words, Streams& streams);
int prove_card_file(const CardWords& words, Streams& streams);
int write_deck_files(const CardWords& words, Streams& streams);
// The same of laws of rubber (io/cards/hyperelastic).
int write_law_card(const CardWords& words, Streams& streams);
int check_law_file(const CardWords& words, Streams& streams);
int prove_law_file(const CardWords& words, Streams& streams);

// What they print with --json.
std::vector<DescribedResult> results_of_cards();
std::vector<DescribedResult> results_of_targets();  // --list and --check
std::vector<DescribedResult> results_of_proof();    // --prove and --deck
DescribedResult result_of_law_check();
DescribedResult result_of_law_proof();

}  // namespace viscard
