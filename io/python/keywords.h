#pragma once

#include "io/flow/large_strain/large_strain_words.h"
#include "io/flow/words/fit_words.h"
#include "io/flow/words/predict_words.h"
#include "io/options/option.h"
#include "models/quantities/plausible.h"

#include <pybind11/pybind11.h>

#include <optional>
#include <string>

namespace viscard::python {

// Keyword arguments as the options of commands. Quantities are texts or numbers in SI. viscard/_check.py has refused
// other types, such as True for a number, which pybind11 takes for 1; what it cannot convert is a TypeError too.
// Sets the targets of the options that are among the keywords. Throws OptionError.
void take_keywords(const pybind11::dict& keywords, const OptionList& options);
// "punch_diameter" of --punch-diameter.
std::string keyword_of(const Option& option);

FitWords fit_words_from(const pybind11::dict& keywords);
LargeStrainWords large_strain_words_from(const pybind11::dict& keywords);
PredictWords predict_words_from(const pybind11::dict& keywords);

// A number is written so that it reads back exactly; nothing for None.
std::optional<std::string> text_from(const char* name, const pybind11::handle& value);

// How plausible="on" or "off" wants numbers judged. Throws OptionError for another word.
Plausible judged_by(const std::string& plausible, Plausible otherwise = Plausible::kMeasured);

// Throws OptionError naming the keyword for a number that is not plausible.
void refuse_keyword(const char* name, double value, const Quantity& quantity, Plausible judged);

// In SI of a text with a unit or a number; nothing for None. Throws OptionError naming the keyword if the text
// is no such quantity, or is not plausible.
std::optional<double> quantity_from(const char* name, const pybind11::handle& value,
                                    const QuantityOrUnit& quantity,
                                    Plausible judged = Plausible::kMeasured);

}  // namespace viscard::python
