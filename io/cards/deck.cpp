#include "io/cards/deck.h"

#include "io/cards/calculix_deck.h"

#include <fmt/format.h>

#include <stdexcept>

namespace viscard {
namespace {

std::string word_of(ElementTestKind kind) {
  return kind == ElementTestKind::kCreep ? "creep" : "relaxation";
}

// Exponential integrators are exact for strain that is linear in the step, so few increments do;
// finite-strain codes need a small strain.
ElementTest test_for(const std::string& target, const Card& card, ElementTestKind kind) {
  ElementTestOptions options{.kind = kind, .amplitude = 1e-6, .steps_per_tau = 8};
  if (target == "calculix") {
    options = {.kind = kind,
               .amplitude = 1.0,
               .steps_per_tau = 40,
               .longest_step_tau = 5.0,
               .most_increments = 4000};
  }
  return element_test(card.written, options);
}

std::string expected(const Card& card, const ElementTest& test, const UnitSystem& units) {
  const bool is_creep = test.kind == ElementTestKind::kCreep;
  const std::string header = fmt::format(
      "# one element in simple tension, sides free; ramp of {0} {1}, then held; amplitude {2}\n"
      "# {3}\ntime_{1},{4}\n",
      to_card(test.ramp_s, units.time_exponent), units.time, test.amplitude,
      is_creep
          ? "expected: strain divided by the amplitude; the stress held is amplitude times E0"
          : "expected: stress divided by (amplitude times E0); the strain held is the amplitude",
      is_creep ? "strain_over_amplitude" : "stress_over_amplitude_E0");
  return expected_curve_csv(card.written, test, to_card(1.0, units.time_exponent), header);
}

}  // namespace

std::vector<std::string> deck_targets() {
  return {"abaqus", "ansys", "febio", "febio-uncoupled", "mfront", "calculix", "frontistr"};
}

Deck one_element_deck(const Card& card, const std::string& target, const UnitSystem& units,
                      ElementTestKind kind) {
  const ElementTest test = test_for(target, card, kind);
  const DeckInput input{card, test, units,
                        to_card(test.amplitude * card.written.E0_Pa, units.stress_exponent)};
  const std::string name = word_of(kind);
  Deck deck;
  if (target == "calculix") {
    deck.files = {{name + ".inp", calculix_deck(card.text, test, card.written.E0_Pa, units)}};
    deck.how_to_run = "ccx " + name;
  } else if (target == "abaqus") {
    deck.files = {{name + ".inp", abaqus_deck(input)}};
    deck.how_to_run = "abaqus job=" + name;
  } else if (target == "ansys") {
    deck.files = {{name + ".mac", ansys_deck(input)}};
    deck.how_to_run = "mapdl -b -i " + name + ".mac";
  } else if (target == "febio" || target == "febio-uncoupled") {
    deck.files = {{name + ".feb", febio_deck(input)}};
    deck.how_to_run = "febio4 -i " + name + ".feb";
  } else if (target == "mfront") {
    deck.files = {{name + ".mtest", mtest_deck(input)}, {"card.mfront", card.text}};
    deck.how_to_run = "mfront --obuild --interface=generic card.mfront && mtest " + name + ".mtest";
  } else if (target == "frontistr") {
    deck.files = {
        {name + ".cnt", frontistr_control(input)},
        {name + ".msh", frontistr_mesh()},
        {"hecmw_ctrl.dat", "!MESH, NAME=fstrMSH, TYPE=HECMW-ENTIRE\n " + name +
                               ".msh\n!CONTROL, NAME=fstrCNT\n " + name +
                               ".cnt\n!RESULT, NAME=fstrRES, IO=OUT\n " + name + ".res\n"}};
    deck.how_to_run = "fistr1";
  } else {
    std::string names;
    for (const std::string& known : deck_targets()) names += (names.empty() ? "" : ", ") + known;
    throw std::invalid_argument("there is no one-element model for " + target + "; there are for " +
                                names);
  }
  deck.files.push_back({name + "_expected.csv", expected(card, test, units)});
  return deck;
}

}  // namespace viscard
