#include "io/cards/card_target.h"

#include <algorithm>

namespace viscard {

using enum ModulusAt;
using enum BranchNumber;
using enum TimeNumber;
using enum BulkRule;

const std::string& LawKeywords::of(HyperelasticForm form) const {
  using enum HyperelasticForm;
  return form == kNeoHooke       ? neo_hooke
         : form == kMooneyRivlin ? mooney_rivlin
         : form == kYeoh         ? yeoh
         : form == kArrudaBoyce  ? arruda_boyce
         : form == kGent         ? gent
                                 : ogden;
}

bool LawDamage::takes(HyperelasticForm form) const {
  return !convention.empty() &&
         (forms.empty() || std::find(forms.begin(), forms.end(), form) != forms.end());
}

std::string conventions_in_words(const CardTarget& target) {
  if (!target.conventions.empty()) return target.conventions;
  return to_word(target.at) + " " + to_word(target.elastic) + "; branches " +
         to_word(target.branch) + "; time " + to_word(target.time) + "; bulk " +
         to_word(target.bulk);
}

bool takes_shift(const CardTarget& target, const Material& material) {
  if (!material.shift) return true;
  return material.shift->law == ShiftLaw::kWlf ? target.takes_wlf : target.takes_arrhenius;
}

std::string to_word(ElasticForm form) {
  constexpr const char* kWords[] = {"E, nu", "K, G", "K, with G the sum of the branches",
                                    "nu, with E the sum of the shares"};
  return kWords[static_cast<std::size_t>(form)];
}

std::string to_word(ModulusAt at) {
  return at == kInstantaneous ? "instantaneous" : "long-term";
}

std::string to_word(BranchNumber branch) {
  if (branch == kRelative) return "relative (g_i = G_i/G_0)";
  return branch == kAbsoluteShear ? "absolute (G_i)" : "absolute (E_i = g_i E_0)";
}

std::string to_word(TimeNumber time) {
  if (time == kTau) return "tau";
  return time == kBeta ? "beta = 1/tau" : "Norton A = 1/(3 G_i tau)";
}

std::string to_word(BulkRule bulk) {
  if (bulk == kOwnNumbers) return "relaxes with its own k_i";
  return bulk == kConstantBulk ? "does not relax (constant K)"
                               : "relaxes with the shear (constant nu)";
}

std::string to_word(Evidence evidence) {
  constexpr const char* kWords[] = {"run", "parsed", "source", "documentation", "ours"};
  return kWords[static_cast<std::size_t>(evidence)];
}

}  // namespace viscard
