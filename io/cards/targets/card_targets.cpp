#include "io/cards/targets/card_targets.h"

#include "io/basics/words.h"

#include <algorithm>
#include <stdexcept>

namespace viscard {

const std::vector<CardTarget>& card_targets() {
  static const std::vector<CardTarget> table{
      abaqus_target(),
      ansys_target(),
      lsdyna_target(),
      lsdyna006_target(),
      febio_target(),
      febio_uncoupled_target(),
      mfront_target(),
      calculix_target(),
      openradioss_target(),
      comsol_target(),
      moose_target(),
      frontistr_target(),
      json_target(),
      csv_target(),
      // Vibration, then robots and Python.
      abaqus_frequency_target(),
      abaqus_table_target(),
      ansys_table_target(),
      comsol_table_target(),
      comsol_branches_target(),
      rayleigh_target(),
      sofa_target(),
      mujoco_target(),
      physx_target(),
      dolfinx_target(),
      sfepy_target(),
  };
  return table;
}

const CardTarget& card_target(const std::string& name) {
  std::vector<std::string> names;
  for (const CardTarget& target : card_targets()) {
    if (target.name == name) return target;
    names.push_back(target.name);
  }
  throw std::invalid_argument(no_such_word("card target", name, names));
}

const std::vector<const CardTarget*>& law_targets() {
  static const std::vector<const CardTarget*> kTargets = [] {
    std::vector<const CardTarget*> out;
    for (const CardTarget& target : card_targets()) {
      if (target.laws) out.push_back(&target);
    }
    std::sort(out.begin(), out.end(),
              [](const CardTarget* a, const CardTarget* b) { return a->name < b->name; });
    return out;
  }();
  return kTargets;
}

const CardTarget& law_target(const std::string& name) {
  std::vector<std::string> names;
  for (const CardTarget* target : law_targets()) {
    if (target->name == name) return *target;
    names.push_back(target->name);
  }
  throw std::invalid_argument("there is no card of rubber for '" + name + "'; use " +
                              listed(names));
}

const CardTarget* stated_card_target(const std::string& text) {
  for (std::size_t at = text.find("viscard "); at != std::string::npos;
       at = text.find("viscard ", at + 1)) {
    const std::string line = text.substr(at, text.find('\n', at) - at);
    const CardTarget* named = nullptr;
    std::size_t last = 0;  // the name of the material may contain " for " and the name of a solver
    for (const CardTarget& target : card_targets()) {
      const std::size_t found = line.rfind(" for " + target.code);
      if (found == std::string::npos || found < last) continue;
      const bool is_longer = found > last || target.code.size() > named->code.size();
      if (named == nullptr || is_longer) named = &target;
      last = found;
    }
    if (named != nullptr) return named;
  }
  return nullptr;
}

const DeckWriter& card_deck(const std::string& name) {
  std::vector<std::string> names;
  for (const CardTarget& target : card_targets()) {
    if (!target.deck) continue;
    if (target.name == name) return *target.deck;
    names.push_back(target.name);
  }
  throw std::invalid_argument("there is no one-element model for " + name + "; there are for " +
                              listed(names));
}

}  // namespace viscard
