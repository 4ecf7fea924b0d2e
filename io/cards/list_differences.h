#pragma once

#include "io/cards/card_numbers.h"
#include "io/cards/read_card.h"

#include <vector>

namespace viscard {

std::vector<CardBranch> by_time(std::vector<CardBranch> branches);

// Largest relative difference of two numbers; 1 if one of them is not finite.
double relative_mismatch(double a, double b);

// ", 1.02256 times it": the factor between two numbers; "" if there is none.
std::string factor_of(double found, double expected);

// A row of the card too few or too many, or one number off: "missing-row", "doubled-row",
// "missing-creep", "missing-viscoelastic", "one-number", "one-number-unit". Empty if the
// differences are of another kind, or only those of nu or of the density, which have their own
// findings.
std::vector<CardFinding> single_difference(const CardNumbers& found, const CardNumbers& expected,
                                           const CardTarget& target);

// Numbers that differ by less than kHandTyped and are no rounding of the expected ones to fewer
// digits: "one-number" or "numbers-differ". Empty if all are.
std::vector<CardFinding> edited_digits(const CardNumbers& found, const CardNumbers& expected,
                                       const CardTarget& target);

// The note "digits-differ" with the numbers that are no rounding of the expected ones, nu and density
// too: of a card that agrees within the tolerance. Empty if all are.
std::vector<CardFinding> near_numbers(const CardNumbers& found, const CardNumbers& expected,
                                      const CardTarget& target);

// "numbers-differ" with all numbers that differ, the first few in words. Empty if none does.
std::vector<CardFinding> listed_differences(const CardNumbers& found, const CardNumbers& expected,
                                            const CardTarget& target);

}  // namespace viscard
