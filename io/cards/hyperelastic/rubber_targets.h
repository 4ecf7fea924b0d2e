#pragma once

#include "io/cards/hyperelastic/rubber_readers.h"
#include "io/cards/hyperelastic/rubber_rows.h"

#include <string>
#include <vector>

namespace viscard {

// How a target states each law: its keyword and constants by viscard's names;
// "": it is refused.
struct RubberLaws {
  std::string neo_hooke, mooney_rivlin, yeoh, ogden, arruda_boyce, gent;
  std::string foam = "";

  const std::string& of(HyperelasticForm form) const;
};

// Damage by the first loading (mullins-or) in a target.
struct RubberDamage {
  std::string convention;  // keyword and order of its constants; "": it is refused
  std::string refusal;     // why
  std::vector<HyperelasticForm> forms = {};  // beside these alone; empty: beside all
  std::string laws = "";                     // how a law stands beside it, if otherwise than alone
  bool takes(HyperelasticForm form) const;
};

// A solver that cards of rubber are written for. A target is one row of the
// table, a law one column.
struct RubberTarget {
  std::string name, comment;  // of --for; what opens a comment line
  std::string (*write)(const RubberNumbers& law, const std::string& material);
  RubberText (*read)(const std::string& text);
  RubberLaws laws;
  std::string volume;  // energy of the volume
  bool may_be_incompressible = false, needs_density = false, has_density = true;
  // Terms of relaxation beside a law, in words; is_taken: false says why not.
  bool takes_terms = false, is_for_small_strain = false;
  std::size_t most_terms = 0;  // 0: any number
  std::string terms;
  RubberDamage damage = {"", "it has no such law"};
  std::string evidence = "not run in its solver: by its manual or its source";
};

// All, by name.
const std::vector<RubberTarget>& rubber_targets();
// Throws std::invalid_argument naming those that there are.
const RubberTarget& rubber_target(const std::string& name);

}  // namespace viscard
