#pragma once

#include "fit/samples/fit_data.h"

#include <string>
#include <vector>

namespace viscard {

// The parameters that a constraint can name.
enum class ParameterStem { kE0, kEInf, kModulus, kShare, kTime };

struct ParameterName {
  ParameterStem stem = ParameterStem::kE0;
  int term = 0;  // from 1; 0: parameter of no single term
};

// "tau_1=0.2" fixes a parameter, "g_2=0:0.1" bounds it. Names: E_inf and E_i, or E0 and g_i (not
// both kinds), and tau_i, in SI units. Terms are numbered as in the result, from 1 for the shortest
// time. Throws std::invalid_argument that quotes the text.
ParameterConstraint constraint_from_text(const std::string& text);

// The parameter with this name. Throws std::invalid_argument that lists the names.
ParameterName parameter_name(const std::string& text);

// "tau_1 = 0.2" or "g_2 = 0:0.1", for messages.
std::string range_text(const ParameterConstraint& one);

// True if E0 or a share is constrained.
bool uses_shares(const std::vector<ParameterConstraint>& constraints);

// Throws std::invalid_argument for an unknown name, a parameter named twice, a term beyond n_terms,
// a lower bound above the upper one, moduli together with shares, or values that no material can
// have: E0 <= 0, shares that sum to one or more, negative moduli unless they are allowed.
void validate(const std::vector<ParameterConstraint>& constraints, int n_terms,
              bool may_be_negative = false);

}  // namespace viscard
