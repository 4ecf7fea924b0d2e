#pragma once

#include "io/cards/hyperelastic/rubber_rows.h"

#include <string>

namespace viscard {

// Lines that stand below the law, or around it.
std::string abaqus_terms(const RubberNumbers& law);
std::string ansys_terms(const RubberNumbers& law);
std::string febio_terms(const RubberNumbers& law);  // g0, then g_i and t_i
// LAW62, which holds law and terms; laws of Ogden's form only.
std::string openradioss_with_terms(const RubberNumbers& law, const std::string& material);
// The class Memory of the module for SfePy.
std::string sfepy_memory(const RubberNumbers& law);

}  // namespace viscard
