#include "io/cards/deck.h"

#include "models/maths/result_visitor.h"

#include <fmt/format.h>

namespace viscard {

void show_keys(ResultVisitor& v, const DeckFile& file) {
  v("file", file.name, "its name");
  v("text", file.text, "its text");
}
namespace {

std::string expected(const Card& card, const ElementTest& test, const UnitSystem& units) {
  const bool is_creep = test.kind == ElementTestKind::kCreep;
  const std::string header = fmt::format(
      "# one element in simple tension, sides free; ramp of {0} {1}, then {2}; amplitude {3}\n"
      "# {4}\ntime_{1},{5}\n",
      to_card(test.ramp_s, units.time_exponent), units.time,
      test.blocks.back().load == 1.0 ? "held" : "as much again in every doubling of the time",
      test.amplitude,
      is_creep
          ? "expected: strain divided by the amplitude; the ramp's stress is amplitude times E0"
          : "expected: stress divided by (amplitude times E0); the ramp's strain is the amplitude",
      is_creep ? "strain_over_amplitude" : "stress_over_amplitude_E0");
  return expected_curve_csv(card.written, test, to_card(1.0, units.time_exponent), header);
}

}  // namespace

std::vector<DeckBlock> DeckInput::blocks() const {
  std::vector<DeckBlock> out;
  double from_s = 0.0;
  for (const TimeBlock& block : test.blocks) {
    const double length = time(block.end_s - from_s);
    out.push_back(
        {length, length / block.increments, time(block.end_s), block.increments, block.load});
    from_s = block.end_s;
  }
  return out;
}

Deck one_element_deck(const Card& card, const DeckWriter& writer, const UnitSystem& units,
                      ElementTestKind kind) {
  ElementTestOptions options = writer.test;
  options.kind = kind;
  const ElementTest test = element_test(card.written, options);
  const std::string name = kind == ElementTestKind::kCreep ? "creep" : "relaxation";
  Deck deck{writer.files({card, test, units}, name),
            fmt::format(fmt::runtime(writer.how_to_run), name)};
  deck.files.push_back({name + "_expected.csv", expected(card, test, units)});
  return deck;
}

}  // namespace viscard
