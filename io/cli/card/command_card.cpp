#include "io/basics/atomic_file.h"
#include "io/basics/file_kind.h"
#include "io/basics/words.h"
#include "io/cards/hyperelastic/read_rubber.h"
#include "io/cards/hyperelastic/rubber_card.h"
#include "io/cards/proof/solvers.h"
#include "io/cards/targets/card_targets.h"
#include "io/cards/unit_system.h"
#include "io/cli/card/card_words.h"
#include "io/cli/words/command_line.h"
#include "io/materials/hyperelastic_file.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>

namespace viscard {
namespace {

void check_word(const std::string& kind, const std::string& word,
                const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), word) != known.end()) return;
  throw UsageError(no_such_word(kind, word, known));
}

std::vector<std::string> target_names() {
  std::vector<std::string> names;
  for (const CardTarget& target : card_targets()) names.push_back(target.name);
  return names;
}

std::vector<std::string> unit_names() {
  std::vector<std::string> names;
  for (const UnitSystem& system : unit_systems()) names.emplace_back(system.name);
  return names;
}

std::vector<std::string> solver_names() {
  std::vector<std::string> names;
  for (const Solver& solver : solvers()) names.emplace_back(solver.name);
  return names;
}

void add_options(CommandSyntax& syntax, CardWords& words) {
  const auto add = [&](const char* name, OptionTarget target, const char* what) -> Option& {
    return syntax.options.add(name, target, what);
  };
  add("for", &words.target,
      "solver the card is for; --list shows them all. Cards by viscard name theirs, so --check and "
      "--prove do not need it")
      .shown_as("TARGET")
      .such_as(target_names());
  add("units", &words.units, "SI (default), mm-t-s, mm-kg-ms, mm-g-ms, um-kg-s or cgs")
      .shown_as("SYSTEM")
      .such_as(unit_names());
  add("out", &words.out, "where to write; stdout if not given").shown_as("FILE");
  add("list", &words.list, "show targets, conventions, limits and evidence");
  add("long", &words.is_long,
      "with --list: a table of what each target takes exactly, takes approximately, or refuses");
  add("check", &words.check,
      "read a card back, print its meaning, and compare it with the material if one is named")
      .shown_as("CARD");
  add("tolerance", &words.tolerance,
      "largest relative difference of E(t) that --check accepts; if not given 1e-6, or what the "
      "target's columns can hold")
      .shown_as("X");
  add("prove", &words.prove,
      "run a card on one element in a solver against the exact answer, and write a certificate "
      "beside it (CARD.SOLVER.proof.json, or --out); of a law of rubber in calculix, febio, mtest "
      "or sfepy")
      .shown_as("CARD");
  add("verify", &words.verify,
      "compare every SHA-256 that a card or a certificate states: of itself, of the card, of the "
      "material file and of the raw data")
      .shown_as("CARD_OR_CERTIFICATE");
  add("import", &words.import_to,
      "read CARD, named in the place of the material, and write what it states as a material file, "
      "linear or of rubber; with it viscard card writes the card of another solver")
      .shown_as("FILE")
      .only_typed();
  add("material-name", &words.material_name,
      "with --check, --prove and --import: of several materials in a card the one of this name or "
      "number")
      .shown_as("NAME");
  add("solver", &words.solver,
      "with --prove: calculix, febio, mtest, frontistr, openradioss, or sfepy and dolfinx, which "
      "run the numbers of any card; if not given the one that reads the card")
      .shown_as("NAME")
      .such_as(solver_names());
  add("solver-path", &words.solver_path,
      "with --prove: the program, if it is not in PATH; of OpenRadioss its starter, with the "
      "engine and th_to_csv beside it")
      .shown_as("PATH");
  add("deck", &words.deck,
      "relaxation or creep: write a one-element model with the expected curve beside it")
      .shown_as("TEST")
      .among({"relaxation", "creep"});
  add("approximate", &words.may_approximate,
      "write what the target cannot take exactly, with the error in the header; too many terms are "
      "refitted to fewer; of a law of rubber for lsdyna, terms that hold at small strain");
  add("terms", &words.terms, "with --approximate: refit to N terms").shown_as("N");
  add("ratio", &words.ratio,
      "mixing ratio, when the material is a joint fit: measured, or between measured ones")
      .shown_as("R");
  add("extrapolate", &words.may_extrapolate,
      "with --ratio: also outside the measured range; the header states it");
  add("at-temperature", &words.temperature_C,
      "card of one temperature, such as 37 or \"37 degC\": the material's shift moves its times")
      .of("degC")
      .shown_as("T");
  add("bulk-modulus", &words.bulk_Pa,
      "of a law of rubber, such as \"2 GPa\"; without it incompressible where the solver can be")
      .of(quantities::kBulkModulus)
      .shown_as("K");
  add("density", &words.density_kg_m3,
      "of a law of rubber, such as \"1.1 g/cm3\"; LS-DYNA and OpenRadioss need it")
      .of(quantities::kDensity)
      .shown_as("RHO");
  add("bound", &words.bound,
      "lower or upper: the card at that end of the 95 % interval of E0, the rest by its covariance "
      "with it")
      .shown_as("END")
      .among({"lower", "upper"});
  add("elastic-only", &words.elastic_only, "instantaneous or long-term: leave relaxation out")
      .shown_as("WHEN")
      .among({"instantaneous", "long-term"});
  add("band", &words.band_text,
      "frequencies in Hz that a table or reduction for vibration covers, for example 10,1000; if "
      "not given those that the material's times support")
      .shown_as("LOW,HIGH");
  add("clamp-nu", &words.clamped_nu, "use this Poisson ratio instead of a larger one")
      .shown_as("NU");
  add("accept-flags", &words.accepts_flags, "write terms that the fit has flagged");
  add("reproducible", &words.is_reproducible,
      "no date and no command line in the header: the same input gives the same bytes");
  add("force", &words.force, "replace an existing file")
      .only_with({"out", "deck", "prove", "import"});
}

// "10,1000"
FrequencyBand band_from_text(const std::string& text) {
  const std::size_t comma = text.find(',');
  const auto from_Hz = number_from_text(text.substr(0, comma));
  const auto to_Hz =
      comma == std::string::npos ? std::nullopt : number_from_text(text.substr(comma + 1));
  constexpr double kSlowest_Hz = 1e-12, kFastest_Hz = 1e12;
  if (!from_Hz || !to_Hz || !(*from_Hz >= kSlowest_Hz) || !(*to_Hz > *from_Hz) ||
      !(*to_Hz <= kFastest_Hz)) {
    throw UsageError(
        "--band " + text +
        " must be two frequencies in Hz between 1e-12 and 1e12, the lower one first, as "
        "in --band 10,1000");
  }
  return {*from_Hz, *to_Hz};
}

void check_band(const CardWords& words) {
  if (!words.band || card_target(words.target).band_note != nullptr) return;
  std::vector<std::string> names;
  for (const CardTarget& target : card_targets()) {
    if (target.band_note != nullptr) names.push_back(target.name);
  }
  throw UsageError("cards for " + words.target + " have no band of frequencies; those for " +
                   listed(names) + " have");
}

// On what an option acts: writing a card, and the options that name something else to do.
enum Deed : unsigned {
  kWrite = 1,
  kDeck = 2,
  kCheck = 4,
  kProve = 8,
  kVerify = 16,
  kImport = 32,
  kList = 64
};

Deed deed_of(const CardWords& words) {
  return words.list                 ? kList
         : !words.check.empty()     ? kCheck
         : !words.prove.empty()     ? kProve
         : !words.verify.empty()    ? kVerify
         : !words.import_to.empty() ? kImport
         : !words.deck.empty()      ? kDeck
                                    : kWrite;
}

struct DeedsOfOption {
  const char* name;
  unsigned linear, rubber;  // deeds for a linear material and for a law of rubber
  // Of --check and --prove only with a material to compare with, which it changes.
  bool needs_material = false;
};

constexpr unsigned kOfMaterial = kWrite | kDeck | kCheck | kProve;  // it changes the material
constexpr DeedsOfOption kDeeds[]{
    {"for", kOfMaterial | kImport, kWrite | kCheck | kProve | kImport},
    {"units", kOfMaterial | kImport, kWrite | kCheck | kProve | kImport},
    {"out", kWrite | kDeck | kProve, kWrite | kProve},
    {"tolerance", kCheck, kCheck, true},
    {"approximate", kOfMaterial, kWrite, true},
    {"terms", kOfMaterial, 0, true},
    {"ratio", kOfMaterial, 0, true},
    {"extrapolate", kOfMaterial, 0, true},
    {"at-temperature", kOfMaterial, 0, true},
    {"bulk-modulus", 0, kWrite | kCheck},
    {"density", 0, kWrite | kCheck},
    {"bound", kOfMaterial, 0, true},
    {"elastic-only", kOfMaterial, kWrite | kCheck | kProve, true},
    {"band", kWrite | kCheck, 0},
    {"clamp-nu", kOfMaterial, 0, true},
    {"accept-flags", kWrite | kDeck, kWrite},
    {"reproducible", kWrite | kDeck | kImport, kWrite | kImport},
    {"force", kWrite | kDeck | kProve | kImport, kWrite | kProve | kImport},
    {"material-name", kCheck | kProve | kImport, kCheck | kProve | kImport},
    {"solver", kProve, kProve},
    {"solver-path", kProve, kProve},
    {"long", kList, kList},
    {"material", ~0U & ~kList, ~0U & ~kList}};

std::string deeds_in_words(unsigned deeds) {
  std::vector<std::string> names;
  if ((deeds & kWrite) != 0) names.emplace_back("writing a card");
  const std::pair<Deed, const char*> kOthers[]{{kDeck, "--deck"},     {kCheck, "--check"},
                                               {kProve, "--prove"},   {kVerify, "--verify"},
                                               {kImport, "--import"}, {kList, "--list"}};
  for (const auto& [deed, name] : kOthers) {
    if ((deeds & deed) != 0) names.emplace_back(name);
  }
  return listed(names);
}

// Whether the card is one of a law of rubber, or the file that it is compared with or written from; takes the target
// that the card states.
bool names_law(Deed deed, CardWords& words) {
  const bool is_read = deed == kCheck || deed == kProve;
  if (!is_read && deed != kWrite && deed != kDeck) return false;
  const bool has_law = !words.material.empty() && looks_like_hyperelastic_file(words.material);
  if (!is_read) return has_law;
  const std::string text = card_text_of(deed == kCheck ? words.check : words.prove, words);
  if (!has_law && !looks_like_rubber_card(text)) return false;
  if (words.target.empty()) words.target = stated_rubber_target(text);
  return true;
}

// An option that would change nothing is refused by name.
void refuse_idle_options(const CommandSyntax& syntax, CardWords& words) {
  const Deed deed = deed_of(words);
  if ((deed == kWrite || deed == kDeck) && words.material.empty()) return;  // check_words() asks
  words.is_law = names_law(deed, words);
  const bool is_law = words.is_law;
  const bool is_alone = words.material.empty() && (deed == kCheck || deed == kProve);
  for (const DeedsOfOption& use : kDeeds) {
    if (!is_given(syntax, use.name)) continue;
    const unsigned all = use.linear | use.rubber;
    const bool is_option = std::string(use.name) != "material";
    const std::string option = is_option ? std::string("--") + use.name : words.material;
    if ((all & deed) == 0)
      throw UsageError(option + " changes nothing here, it belongs to " + deeds_in_words(all) +
                       "; omit it");
    const bool is_of_deed = ((is_law ? use.rubber : use.linear) & deed) != 0;
    if (is_alone && use.needs_material && is_of_deed)
      throw UsageError(option +
                       " is for the comparison with a material, and none is named; name "
                       "its file, or omit " +
                       option);
    if (deed == kImport || deed == kDeck || is_of_deed) continue;
    const std::string& what = words.material.empty() ? words.check + words.prove : words.material;
    if (!is_law)
      throw UsageError(option + " is for laws of rubber, and " + what + " is linear; omit it");
    throw UsageError(
        option + (use.rubber == 0 ? " is for linear materials, and " : " changes nothing here, ") +
        what + " is a law of rubber; omit it");
  }
  if (words.may_extrapolate && !words.ratio)
    throw UsageError("--extrapolate has no effect without --ratio; add it, or omit --extrapolate");
}

// True if names of columns stand above the numbers, behind lines of comments.
bool has_header(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.size(), text.find('\n'));
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(text.size(), end + 1));
    if (line.empty() || line.front() == '#') continue;
    return std::isalpha(static_cast<unsigned char>(line.front())) != 0 &&
           line.find_first_of(",;\t") != std::string_view::npos;
  }
  return false;
}

// Of --check or --prove CARD with a law of rubber.
void check_law_words(const CardWords& words) {
  if (words.target.empty()) {
    const std::string& given_card = words.check.empty() ? words.prove : words.check;
    if (const CardTarget* linear = stated_card_target(read_file(given_card))) {
      throw UsageError(
          given_card + " is a card of a linear material (" + linear->name + "), and " +
          words.material +
          " is a law of rubber; compare the card with the material that it was written from");
    }
    throw UsageError(given_card + " does not name its solver, as cards by viscard do; add --for " +
                     listed(rubber_card_targets()));
  }
  if (!words.material.empty() && !looks_like_hyperelastic_file(words.material) &&
      kind_of_file(read_file(words.material)) == FileKind::kMaterial) {
    const std::string& given_card = words.check.empty() ? words.prove : words.check;
    throw UsageError(
        given_card + " is a card of a law of rubber, and " + words.material +
        " is a linear material; compare the card with the law that it was written from");
  }
  if (!words.units.empty()) check_word("unit system", words.units, unit_names());
  if (!words.elastic_only.empty())
    check_word("--elastic-only", words.elastic_only, {"instantaneous", "long-term"});
  if (words.tolerance && !(*words.tolerance > 0.0))
    throw UsageError("--tolerance must be positive");
}

void check_deeds(const CardWords& words) {
  const int deeds = (words.list ? 1 : 0) + (words.check.empty() ? 0 : 1) +
                    (words.prove.empty() ? 0 : 1) + (words.deck.empty() ? 0 : 1) +
                    (words.verify.empty() ? 0 : 1) + (words.import_to.empty() ? 0 : 1);
  if (deeds > 1)
    throw UsageError("--list, --check, --prove, --verify, --import and --deck exclude each other");
}

void check_words(CardWords& words) {
  if (words.list || !words.verify.empty()) return;
  if (!words.import_to.empty()) {
    if (words.material.empty())
      throw UsageError("no card given; usage: viscard card CARD --import material.json");
    if (!words.out.empty()) throw UsageError("--import names the file to write; omit --out");
    if (!words.target.empty()) {
      std::vector<std::string> known = target_names();
      known.insert(known.end(), rubber_card_targets().begin(), rubber_card_targets().end());
      check_word("card target", words.target, known);
    }
    if (!words.units.empty()) check_word("unit system", words.units, unit_names());
    return;
  }
  const bool is_read = !words.check.empty() || !words.prove.empty();
  if (words.is_law && is_read) return check_law_words(words);
  const std::string& given_card = words.check.empty() ? words.prove : words.check;
  if (words.target.empty() && !given_card.empty()) {
    const std::string contents = card_text_of(given_card, words);
    const CardTarget* target = stated_card_target(contents);
    if (target == nullptr) {
      // Numbers alone may be a card of another program, but not under the header of a table.
      if (kind_of_file(contents) != FileKind::kTable || has_header(contents)) {
        refuse_other_kind(contents, given_card, FileKind::kCard);
      }
      throw UsageError(given_card +
                       " does not name its solver, as cards by viscard do; add --for "
                       "TARGET ('viscard card --list' shows the targets)");
    }
    words.target = target->name;
  }
  if (words.target.empty()) {
    throw UsageError("--for TARGET is missing; 'viscard card --list' shows the targets");
  }
  check_word("card target", words.target, target_names());
  check_band(words);
  if (!words.units.empty()) check_word("unit system", words.units, unit_names());
  if (!words.bound.empty()) check_word("--bound", words.bound, {"lower", "upper"});
  if (!words.deck.empty()) check_word("--deck", words.deck, {"relaxation", "creep"});
  if (!words.elastic_only.empty()) {
    check_word("--elastic-only", words.elastic_only, {"instantaneous", "long-term"});
  }
  if (words.terms && (*words.terms < 1 || *words.terms > 100)) {
    throw UsageError("--terms " + std::to_string(*words.terms) +
                     " must be a whole number from 1 to 100");
  }
  if (words.terms && !words.may_approximate) {
    throw UsageError("--terms changes the material; add --approximate");
  }
  if (words.tolerance && !(*words.tolerance > 0.0)) {
    throw UsageError("--tolerance must be positive");
  }
  if (words.clamped_nu && !(*words.clamped_nu > -1.0 && *words.clamped_nu < 0.5)) {
    throw UsageError("--clamp-nu must lie in (-1, 0.5)");
  }
  if (words.material.empty() && words.check.empty() && words.prove.empty()) {
    throw UsageError("no material given; usage: viscard card MATERIAL.json --for TARGET");
  }
}

}  // namespace

int run_card(const Words& words, Streams& streams) {
  CardWords card;
  CommandSyntax syntax{
      "viscard card MATERIAL.json --for TARGET [--units SYSTEM] [--out FILE] [OPTIONS]",
      "Writes a material card for a solver, right by that solver's conventions and read back "
      "before it is saved. With --list, --check, --prove, --verify or --deck: shows the targets, "
      "checks a card, runs it, follows its sums, or writes a one-element model to run it in.",
      "viscard card data/materials/pdms_1to10_seed.json --for abaqus --units mm-t-s"};
  std::optional<std::string> material;
  syntax.positional.add("material", &material, "material file");
  add_options(syntax, card);
  if (std::find(words.begin(), words.end(), "--deck") != words.end()) syntax.may_exist = {"out"};
  syntax.results = results_of_cards();
  for (const auto& some : {std::vector{result_of_law_check(), result_of_law_proof(),
                                       result_of_verify(), result_of_import()},
                           results_of_targets(), results_of_proof()}) {
    syntax.results.insert(syntax.results.end(), some.begin(), some.end());
  }
  if (!parse_words(syntax, words, streams)) return kDone;
  card.material = material.value_or("");
  card.plausible = given_plausible(syntax);
  card.json = syntax.as_json;
  if (card.band_text) card.band = band_from_text(*card.band_text);
  card.command_line = quoted_command_line("card", words);
  check_deeds(card);
  refuse_idle_options(syntax, card);
  check_words(card);
  if (card.list) return list_card_targets(card, streams);
  if (!card.verify.empty()) return verify_file(card, streams);
  if (!card.import_to.empty()) return import_card_file(card, streams);
  if (!card.check.empty())
    return card.is_law ? check_law_file(card, streams) : check_card_file(card, streams);
  if (!card.prove.empty())
    return card.is_law ? prove_law_file(card, streams) : prove_card_file(card, streams);
  if (!card.deck.empty() && card.is_law) {
    throw UsageError("--deck writes models of linear materials, and " + card.material +
                     " is a law of rubber; write its card with --out and run it with --prove");
  }
  if (!card.deck.empty()) return write_deck_files(card, streams);
  return card.is_law ? write_law_card(card, streams) : write_card_file(card, streams);
}

}  // namespace viscard
