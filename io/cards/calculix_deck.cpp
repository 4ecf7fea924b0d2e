#include "io/cards/calculix_deck.h"

#include "io/cards/card_lines.h"
#include "io/cards/number_text.h"

#include <fmt/format.h>

namespace viscard {
namespace {

std::string number(double value) {
  return number_within(value, 20);
}

std::string mesh(const std::vector<std::string>& materials) {
  std::string out =
      "*NODE, NSET=NALL\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n"
      "5, 0., 0., 1.\n6, 1., 0., 1.\n7, 1., 1., 1.\n8, 0., 1., 1.\n"
      "*NSET, NSET=BASE\n1, 2, 3, 4\n*NSET, NSET=TOP\n5, 6, 7, 8\n";
  for (std::size_t i = 0; i < materials.size(); ++i) {
    out += fmt::format("*ELEMENT, TYPE=C3D8, ELSET=E_{}\n{}, 1, 2, 3, 4, 5, 6, 7, 8\n",
                       materials[i], i + 1);
  }
  return out;
}

}  // namespace

std::vector<std::string> material_names(const std::string& card_text) {
  std::vector<std::string> names;
  for (const CardLine& line : card_lines(card_text, "**")) {
    const std::vector<std::string> words = cells(line.text, ',');
    if (upper(words[0]) != "*MATERIAL") continue;
    for (const std::string& word : words) {
      const std::size_t equals = word.find('=');
      if (equals != std::string::npos && upper(trimmed(word.substr(0, equals))) == "NAME") {
        names.push_back(trimmed(word.substr(equals + 1)));
      }
    }
  }
  return names;
}

std::string calculix_deck(const std::string& card_text, const ElementTest& test, double E0_Pa,
                          const UnitSystem& units) {
  const std::vector<std::string> materials = material_names(card_text);
  std::string out = mesh(materials) + card_text;
  for (const std::string& name : materials) {
    out += fmt::format("*SOLID SECTION, ELSET=E_{0}, MATERIAL={0}\n", name);
  }
  out += "*BOUNDARY\nBASE, 3, 3\n1, 1, 2\n4, 1, 1\n5, 1, 2\n8, 1, 1\n2, 2, 2\n6, 2, 2\n";
  const bool is_creep = test.kind == ElementTestKind::kCreep;
  const auto in_card = [&](double time_s) { return to_card(time_s, units.time_exponent); };
  out += fmt::format("*AMPLITUDE, NAME=RAMP, TIME=TOTAL TIME\n0., 0., {}, 1.\n{}, 1.\n",
                     number(in_card(test.ramp_s)), number(2.0 * in_card(test.end_s())));
  double from_s = 0.0;
  for (const TimeBlock& block : test.blocks) {
    const double length = in_card(block.end_s - from_s);
    out += fmt::format("*STEP, INC=1000000\n*VISCO, DIRECT, CETOL=1.\n{}, {}\n",
                       number(length / block.increments), number(length));
    // CalculiX asks for CETOL even where the increment is fixed.
    if (is_creep) {
      const double force = 0.25 * to_card(test.amplitude * E0_Pa, units.stress_exponent);
      out += "*CLOAD, AMPLITUDE=RAMP\nTOP, 3, " + number(force) + "\n";
      out += "*NODE PRINT, NSET=TOP\nU\n";
    } else {
      out += "*BOUNDARY, AMPLITUDE=RAMP\nTOP, 3, 3, " + number(test.amplitude) + "\n";
      out += "*NODE PRINT, NSET=BASE, TOTALS=ONLY\nRF\n";
    }
    out += "*END STEP\n";
    from_s = block.end_s;
  }
  return out;
}

}  // namespace viscard
