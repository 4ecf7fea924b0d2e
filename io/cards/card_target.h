#pragma once

#include "io/cards/one_element.h"
#include "models/hyperelastic/hyperelastic_law.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

struct CardBody;
struct CardContext;
struct CardMistake;
struct CompanionFile;
struct DeckFile;
struct DeckInput;
struct ReadCard;

// A number of a card that states no whole material, with its name for messages.
struct CardValue {
  std::string name;    // "E", "row 3: loss modulus"
  double value = 0.0;  // in the unit of the card
};

// A solver that cards are written for. Four conventions decide whether a card is right: is the
// elastic number the instantaneous or the long-term one, are branches relative or absolute, is time
// tau or 1/tau, does the bulk modulus relax. Each solver states them, and the functions that write
// and read its text, in one file of targets/.

// Which elastic numbers the card states.
enum class ElasticForm {
  kYoungPoisson,  // E and nu
  kBulkShear,     // K and G
  kBulkOnly,      // K; the shear modulus is the sum of all branches and the equilibrium row
  kPoissonOnly,   // nu; Young's modulus is the sum of the shares of the overlaid materials
};

// Whether the modulus of a card is that of fast or of slow loading.
enum class ModulusAt { kInstantaneous, kLongTerm };

// The number by which a card states a branch.
enum class BranchNumber {
  kRelative,       // g_i, of the instantaneous modulus
  kAbsoluteShear,  // G_i = g_i G_0
  kAbsoluteYoung,  // E_i = g_i E_0, at the Poisson ratio of the whole
};

// The number by which a card states the time of a branch.
enum class TimeNumber {
  kTau,
  kBeta,     // 1/tau
  kNortonA,  // 1/(3 G tau), the linear creep law of a Maxwell element
};

// How a format states the relaxation of the bulk modulus.
enum class BulkRule {
  kOwnNumbers,       // k_i stand in the card
  kConstantBulk,     // K does not relax
  kConstantPoisson,  // the whole stress relaxes: k_i = g_i, even if the material has other k_i
};

// How the format is known.
enum class Evidence {
  kRun,            // the solver itself returned the exact answer for cards of this form
  kParsed,         // independent readers of the format found the numbers
  kSource,         // the solver's own source or format definition, not run
  kDocumentation,  // public manual only
  kOurs,           // viscard defines the format
};

// The one-element model of a solver.
struct DeckWriter {
  std::reference_wrapper<std::vector<DeckFile>(const DeckInput& input, const std::string& name)>
      files;               // all but the expected curve; the first is the one to run
  const char* how_to_run;  // {} stands for the name
  // Exponential integrators are exact for strain that is linear in the step, so a few increments
  // suffice; finite-strain codes need a small strain.
  ElementTestOptions test{.amplitude = 1e-6, .steps_per_tau = 8};
};

// How a target states each law of rubber: its keyword and constants by viscard's names; "": it is refused.
struct LawKeywords {
  std::string neo_hooke, mooney_rivlin, yeoh, ogden, arruda_boyce, gent;
  std::string foam = "";

  const std::string& of(HyperelasticForm form) const;  // the keyword of one
};

// Damage by the first loading (mullins-or) in a target.
struct LawDamage {
  std::string convention;  // keyword and order of its constants; "": it is refused
  std::string refusal;     // why
  std::vector<HyperelasticForm> forms = {};  // beside these alone; empty: beside all
  std::string laws = "";                     // how a law stands beside it, if otherwise than alone
  bool takes(HyperelasticForm form) const;   // beside that law
};

// The cards of laws of rubber of a target. A law is a member of `keywords`.
struct LawColumn {
  std::string (*write)(const CardBody& body);
  // Fills numbers and findings, and of `understood` what the card states otherwise than the law at once, shares of
  // it, and the bulk modulus. Throws as CardTarget::read.
  void (*read)(const std::string& text, ReadCard& card);
  LawKeywords keywords;
  std::string volume;  // energy of the volume
  bool may_be_incompressible = false;
  // Terms of relaxation beside a law, in words; takes_terms false: why not.
  bool takes_terms = false, is_for_small_strain = false;
  std::size_t most_terms = 0;  // 0: any number
  std::string terms;
  LawDamage damage = {"", "it has no such law"};
  std::string evidence = "not run in its solver: by its manual or its source";
};

// A target without a writer or a reader does not compile, so none can take that of another.
struct CardTarget {
  std::string name;       // as on the command line
  std::string code;       // "Abaqus"
  std::string extension;  // ".inp"
  std::string comment;    // opens a comment line; "<!--" closes with "-->"; "": no comments

  std::reference_wrapper<std::string(const CardBody& body)> write;  // the text after the header
  // Fills numbers, findings and understood. Throws std::runtime_error with line and expected text.
  std::reference_wrapper<void(const std::string& text, ReadCard& card)> read;
  // For a card that is a table of E(t): its largest relative difference from E(t) of a material.
  double (*table_difference)(const std::string& text, const Material& material) = nullptr;
  std::vector<CompanionFile> (*companions)(const CardBody& body) = nullptr;
  std::optional<DeckWriter> deck = std::nullopt;
  std::optional<LawColumn> laws = std::nullopt;  // none: no cards of laws of rubber
  // Mistakes of only this solver's cards, added to or renamed in the list of the elastic numbers.
  void (*add_mistakes)(const CardContext& context, std::vector<CardMistake>& list) = nullptr;

  ElasticForm elastic = ElasticForm::kYoungPoisson;
  ModulusAt at = ModulusAt::kInstantaneous;
  BranchNumber branch = BranchNumber::kRelative;
  TimeNumber time = TimeNumber::kTau;
  BulkRule bulk = BulkRule::kOwnNumbers;
  bool states_equilibrium = false;     // the share that never relaxes stands in the card
  bool states_density = true;          // false: the density is a comment
  bool is_case_sensitive = true;       // the solver distinguishes keywords by case
  bool reads_fortran_numbers = false;  // 1.0D+05 and 1.0+05 are numbers, as in Fortran
  bool numbers_carry_units = false;    // each number states its own unit
  int max_terms = 0;                   // 0: no limit known
  bool takes_incompressible = false;
  bool needs_density = false;     // the solver refuses or misuses a density of 0
  bool takes_wlf = false;         // has a place for log10 a_T = -C1 (T - T_ref)/(C2 + T - T_ref)
  bool takes_arrhenius = false;   // has a place for ln a_T = (E_a/R) (1/T - 1/T_ref)
  const char* why_no_wlf = "";    // a reason besides "no place for one", for the refusal
  const char* temperature = "C";  // the unit of temperatures in the card
  // Text that sets the temperature of a model, needed if the card has a shift and the solver would
  // assume another temperature.
  std::string set_temperature = {};
  // A sentence about the time step that this material needs, for solvers of low order.
  std::string (*step_note)(const Material& material) = nullptr;
  Evidence evidence = Evidence::kOurs;
  std::string evidence_note;
  std::string advice;  // what the user of this code must do besides pasting the card
  // Whether an analysis over frequency takes the card, for the table of targets.
  std::string harmonic = "refused: no analysis over frequency takes it";

  // What no card of this target can represent; one of the first lines of the card.
  std::string cannot_represent = {};
  bool is_indented = false;      // blanks that open a line mean something, as in Python
  std::string first_line = {};   // stands before all comments: "#usda 1.0"
  std::string conventions = {};  // in words, where the four choices above do not describe the card
  // For a card from which no whole material can be read back, a table or a reduction: the numbers
  // that it must state, in the order of its text. `read` fills ReadCard::values with those found.
  std::vector<CardValue> (*values)(const CardBody& body) = nullptr;
  // Rows per decade of a table over frequency, 0 for a card of one set of numbers for its band.
  int rows_per_decade = 0;
  // How well the numbers describe the material over the band; absent for a card without a band.
  std::string (*band_note)(const CardBody& body) = nullptr;
  // Why no card is written for the band unless the user accepts any error; "" if one is.
  std::string (*band_refusal)(const CardBody& body) = nullptr;
};

// Whether a material can be read back from a card.
inline bool states_material(const CardTarget& target) {
  return target.table_difference == nullptr && target.values == nullptr;
}

// Whether the card has a place for the material's temperature shift; true without a shift.
bool takes_shift(const CardTarget& target, const Material& material);

// "instantaneous E, nu; branches relative (g_i = G_i/G_0); time tau; bulk relaxes with its own k_i"
std::string conventions_in_words(const CardTarget& target);
std::string to_word(ElasticForm form);
std::string to_word(ModulusAt at);
std::string to_word(BranchNumber branch);
std::string to_word(TimeNumber time);
std::string to_word(BulkRule bulk);
std::string to_word(Evidence evidence);

}  // namespace viscard
