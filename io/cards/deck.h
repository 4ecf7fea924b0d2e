#pragma once

#include "io/cards/card.h"
#include "io/cards/card_target.h"
#include "io/cards/one_element.h"
#include "io/cards/unit_system.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

class ResultVisitor;

// A one-element model that holds the card, so that users can try it in their solver in one run.
struct DeckFile {
  std::string name;  // "relaxation.feb"
  std::string text;
};
void show_keys(ResultVisitor& v, const DeckFile& file);

struct Deck {
  std::vector<DeckFile> files;  // the first is the one to run; the last the expected curve (CSV)
  std::string how_to_run;
};

Deck one_element_deck(const Card& card, const DeckWriter& writer, const UnitSystem& units,
                      ElementTestKind kind);

// The unit cube of all models: its corners, nodes 1 to 8, and the nodes of its faces x = 0, y = 0,
// z = 0 (rollers) and z = 1 (pulled).
inline constexpr int kCubeCorners[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                           {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
inline constexpr int kFaces = 4;
inline constexpr int kFaceNodes[kFaces][4] = {
    {1, 4, 5, 8}, {1, 2, 5, 6}, {1, 2, 3, 4}, {5, 6, 7, 8}};

// A block of equal increments, in the card's unit of time.
struct DeckBlock {
  double length = 0.0;
  double step = 0.0;
  double end = 0.0;
  int increments = 0;
  double load = 1.0;  // at the end, in amplitudes
};

// What the deck writer of a target formats. The model is a unit cube from the origin with rollers
// on its faces x = 0, y = 0 and z = 0, pulled in z at its face z = 1; confined, with rollers on x = 1 and
// y = 1 too.
struct DeckInput {
  const Card& card;
  const ElementTest& test;
  const UnitSystem& units;
  // Of the whole model, for a card with a shift; else the reference temperature of the shift.
  std::optional<double> temperature_C = std::nullopt;

  bool is_creep() const { return test.is_creep(); }
  bool is_confined() const { return test.is_confined(); }
  double time(double time_s) const { return to_card(time_s, units.time_exponent); }
  double ramp() const { return time(test.ramp_s); }
  double end() const { return time(test.end_s()); }
  // The load of a creep test after its ramp, amplitude times E0.
  double stress() const {
    return to_card(test.amplitude * card.written.E0_Pa, units.stress_exponent);
  }
  // After the ramp: the displacement of face z = 1, or the force on each of its four nodes.
  double pull() const { return is_creep() ? 0.25 * stress() : test.amplitude; }
  std::vector<DeckBlock> blocks() const;
};

}  // namespace viscard
