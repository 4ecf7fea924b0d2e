#pragma once

#include "io/cards/hyperelastic/rubber_rows.h"

#include <string>

namespace viscard {

struct RubberTarget;

// Throws std::invalid_argument if the target cannot take the terms of the law: no memory beside a law,
// too many terms, shares that sum to 1, or a rule that holds at small strain only (unless it may
// approximate).
void require_terms_taken(const RubberNumbers& law, const RubberTarget& target,
                         bool may_approximate);

// Lines that stand below the law, or around it.
std::string abaqus_terms(const RubberNumbers& law);
std::string ansys_terms(const RubberNumbers& law);
std::string febio_terms(const RubberNumbers& law);  // g0, then g_i and t_i
// LAW62, which holds law and terms; laws of Ogden's form only.
std::string openradioss_with_terms(const RubberNumbers& law, const std::string& material);
// The class Memory of the module for SfePy.
std::string sfepy_memory(const RubberNumbers& law);

}  // namespace viscard
