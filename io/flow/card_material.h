#pragma once

#include "models/material/material.h"
#include "models/quantities/plausible.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

struct CardOptions;

// Which material a card is written of.
struct CardMaterialRequest {
  std::string material;                        // path of a material or joint file
  std::string target;                          // name of the card's target
  std::string bound;                           // "", "lower", "upper": an end of the 95 % interval
  std::string elastic_only;                    // "", "instantaneous", "long-term"
  std::optional<int> terms;                    // at most this many, with may_approximate
  std::optional<double> ratio;                 // of a joint file
  std::optional<double> temperature_C;         // by the material's shift, which the card then lacks
  Plausible plausible = Plausible::kMeasured;  // kOff accepts any value
  bool may_extrapolate = false;
  bool may_approximate = false;  // refit the terms to the number that the target takes
};

// The resulting material, with notes of the changes that were made.
struct PreparedMaterial {
  Material material;
  std::string sha256, file;                 // of the material file, its name without folder
  std::vector<std::string> notes;           // header lines
  std::optional<std::string> terms_change;  // "approximated" text of the terms, if reduced
  bool are_terms_dropped = false;
  std::optional<Material> original;  // before its terms were reduced, if they were
};

// Throws std::runtime_error naming the file, std::invalid_argument if a joint file has no ratio or
// a material file has one, or if bound or elastic_only is none of its words.
PreparedMaterial prepare_card_material(const CardMaterialRequest& request);

// The same for a material in memory; request.material stands for it in messages.
PreparedMaterial prepare_card_material(const Material& material,
                                       const CardMaterialRequest& request);

// The text of these changes for the card.
void state_changes(const PreparedMaterial& prepared, CardOptions& options);

}  // namespace viscard
