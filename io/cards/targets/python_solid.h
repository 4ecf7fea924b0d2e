#pragma once

#include "io/cards/card_numbers.h"
#include "io/cards/read_card.h"

#include <string>

namespace viscard {

struct DeckInput;

// What the Python modules for SfePy and dolfinx share: the numbers, and the solid in numpy.

// The numbers, and a class Memory that integrates the branches exactly for strain that is linear in
// each step.
std::string python_solid(const CardBody& body);
// The numbers of such a module.
void read_python_solid(const std::string& text, ReadCard& card);

// The loop over the blocks of a one-element test, for a script that defines solve(dt, load), which
// returns the strains at the points; prints "time,response" for every step.
std::string python_test_loop(const DeckInput& input);

}  // namespace viscard
