#pragma once

#include <string>
#include <vector>

namespace viscard {

// The table that decides whether a card is right. Four choices per target: is the elastic number
// the instantaneous or the long-term one, are branches relative or absolute, is time tau or 1/tau,
// does the bulk modulus relax. Writers and readers take them from here and only format or parse.

// Which elastic numbers the card states.
enum class ElasticForm {
  kYoungPoisson,  // E and nu
  kBulkShear,     // K and G
  kBulkOnly,      // K; the shear modulus is the sum of all branches and the equilibrium row
  kPoissonOnly,   // nu; Young's modulus is the sum of the shares of the overlaid materials
};

enum class ModulusAt { kInstantaneous, kLongTerm };

enum class BranchNumber {
  kRelative,       // g_i, of the instantaneous modulus
  kAbsoluteShear,  // G_i = g_i G_0
  kAbsoluteYoung,  // E_i = g_i E_0, at the Poisson ratio of the whole
};

enum class TimeNumber {
  kTau,
  kBeta,     // 1/tau
  kNortonA,  // 1/(3 G tau), the linear creep law of a Maxwell element
};

enum class BulkRule {
  kOwnNumbers,       // k_i stand in the card
  kConstantBulk,     // K does not relax
  kConstantPoisson,  // the whole stress relaxes: k_i = g_i whatever the material says
};

// What stands behind the format.
enum class Evidence {
  kRun,            // the solver itself returned the exact answer for cards of this form
  kParsed,         // independent readers of the format found the numbers
  kSource,         // the solver's own source or format definition, not run
  kDocumentation,  // public manual only
  kOurs,           // viscard defines the format
};

struct CardTarget {
  std::string name;       // as on the command line
  std::string code;       // "Abaqus"
  std::string extension;  // ".inp"
  std::string comment;    // what opens a comment line; "<!--" closes with "-->", "" for JSON
  ElasticForm elastic = ElasticForm::kYoungPoisson;
  ModulusAt at = ModulusAt::kInstantaneous;
  BranchNumber branch = BranchNumber::kRelative;
  TimeNumber time = TimeNumber::kTau;
  BulkRule bulk = BulkRule::kOwnNumbers;
  bool states_equilibrium = false;  // the share that never relaxes stands in the card
  int max_terms = 0;                // 0: no limit known
  bool takes_incompressible = false;
  bool takes_wlf = false;  // a place for log10 a_T = -C1 (T - T_ref)/(C2 + T - T_ref)
  Evidence evidence = Evidence::kOurs;
  std::string evidence_note;
  std::string advice;  // what the user of this code must do besides pasting the card
};

// In the order of --list.
const std::vector<CardTarget>& card_targets();
// nullptr when there is none of that name.
const CardTarget* find_card_target(const std::string& name);
// Throws std::invalid_argument listing the targets.
const CardTarget& card_target(const std::string& name);

// The property list of the TFEL gallery's GeneralizedMaxwell, which comes beside an MFront card:
// long- term bulk and shear moduli, absolute branches.
CardTarget mfront_gallery_target();

// "instantaneous E and nu; branches relative (g); time tau; bulk: own numbers".
std::string conventions_in_words(const CardTarget& target);
std::string to_word(ElasticForm form);
std::string to_word(ModulusAt at);
std::string to_word(BranchNumber branch);
std::string to_word(TimeNumber time);
std::string to_word(BulkRule bulk);
std::string to_word(Evidence evidence);

}  // namespace viscard
