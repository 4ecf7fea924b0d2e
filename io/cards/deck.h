#pragma once

#include "io/cards/card.h"
#include "io/cards/one_element.h"

#include <string>
#include <vector>

namespace viscard {

// A one-element model that holds the card, so that a user can try it in their own solver in one
// run.
struct DeckFile {
  std::string name;  // "relaxation.feb"
  std::string text;
};

struct Deck {
  std::vector<DeckFile> files;  // the first is the one to run; the last the expected curve (CSV)
  std::string how_to_run;
};

// Throws std::invalid_argument naming the targets when there is no deck for this one.
Deck one_element_deck(const Card& card, const std::string& target, const UnitSystem& units,
                      ElementTestKind kind);

// One writer per dialect; the strain or stress reaches test.amplitude at the end of the ramp.
struct DeckInput {
  const Card& card;
  const ElementTest& test;
  const UnitSystem& units;
  double stress = 0.0;  // amplitude times E0 in card units, the load of a creep test
};
double in_card_time(const DeckInput& input, double time_s);
std::string abaqus_deck(const DeckInput& input);
std::string ansys_deck(const DeckInput& input);
std::string febio_deck(const DeckInput& input);
std::string mtest_deck(const DeckInput& input);
std::string frontistr_control(const DeckInput& input);
std::string frontistr_mesh();
std::string lsdyna_deck(const DeckInput& input);
std::string openradioss_starter(const DeckInput& input, const std::string& run_name);
std::string openradioss_engine(const DeckInput& input, const std::string& run_name);
std::string moose_deck(const DeckInput& input);
std::string comsol_model(const DeckInput& input, const std::string& class_name);

}  // namespace viscard
