#pragma once

#include "io/cards/hyperelastic/read_rubber.h"
#include "io/materials/hyperelastic_file.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// A card of rubber beside the law that it is meant to be.
struct RubberCheck {
  ReadRubber read;
  std::vector<CardFinding> findings = {};  // of the reader, and mistakes that explain a difference
  std::optional<double> difference = {};  // largest relative one of a parameter; none without a law
  double tolerance = 1e-6;
  bool agrees = true;
};

// What the card should be.
struct RubberCheckOptions {
  std::string target;
  std::string units;  // empty: those that the card states, else SI
  std::optional<double> tolerance =
      {};                              // if not given 1e-6, or what the ten columns of lsdyna lose
  std::optional<double> bulk_Pa = {};  // not compared if not given
  std::optional<double> density_kg_m3 = {};
  Plausible plausible = Plausible::kMeasured;  // of a card alone; kOff accepts any number
  std::string elastic_only = {};               // "", "instantaneous", "long-term"
};

// Throws what read_rubber_card() throws. Without a file it reports only what the reader found.
RubberCheck check_rubber_card(const std::string& text, const HyperelasticFile* file,
                              const RubberCheckOptions& options);

}  // namespace viscard
