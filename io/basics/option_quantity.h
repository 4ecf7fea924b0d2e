#pragma once

#include "models/quantities/plausible.h"

#include <optional>
#include <string>

namespace viscard {

// The value in SI of an option: a number in SI, or a text with its unit ("0.1 mm"). `name` stands for
// it in messages: "--depth". Throws std::invalid_argument beginning with the name if the text is no
// such quantity, or is not plausible, with what to write instead.
double option_quantity(const std::string& name, const std::string& text,
                       const QuantityOrUnit& quantity, Plausible judged = Plausible::kMeasured);

// The same of an option that may be missing.
std::optional<double> option_quantity(const std::string& name,
                                      const std::optional<std::string>& text,
                                      const QuantityOrUnit& quantity,
                                      Plausible judged = Plausible::kMeasured);

// Throws std::invalid_argument for a number that is not plausible.
void refuse_implausible_option(const std::string& name, double value, const Quantity& quantity,
                               Plausible judged);

// The strain of a linear law: one above kLargestBareStrain is refused without a unit.
std::optional<double> option_strain(const std::string& name, const std::optional<std::string>& text,
                                    Plausible judged);

}  // namespace viscard
