#include "io/cards/keyword_deck.h"

#include "io/cards/keyword_lines.h"

#include <fmt/format.h>

namespace viscard {

std::string keyword_cube() {
  return "*NODE, NSET=NALL\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n"
         "5, 0., 0., 1.\n6, 1., 0., 1.\n7, 1., 1., 1.\n8, 0., 1., 1.\n"
         "*NSET, NSET=BASE\n1, 2, 3, 4\n*NSET, NSET=TOP\n5, 6, 7, 8\n";
}

std::string keyword_rollers_and_ramp(const DeckInput& input) {
  return fmt::format(
      "*BOUNDARY\nBASE, 3, 3\n1, 1, 2\n4, 1, 1\n5, 1, 2\n8, 1, 1\n2, 2, 2\n6, 2, 2\n"
      "*AMPLITUDE, NAME=RAMP, TIME=TOTAL TIME\n0., 0., {}, 1.\n{}, 1.\n",
      number_of_20(input.ramp()), number_of_20(2.0 * input.end()));
}

std::string keyword_pull(const DeckInput& input) {
  return fmt::format("{}, AMPLITUDE=RAMP\nTOP, 3, {}{}\n",
                     input.is_creep() ? "*CLOAD" : "*BOUNDARY", input.is_creep() ? "" : "3, ",
                     number_of_20(input.pull()));
}

}  // namespace viscard
