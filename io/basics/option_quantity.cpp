#include "io/basics/option_quantity.h"

#include "io/basics/units.h"
#include "models/maths/text_of_number.h"

#include <cmath>
#include <stdexcept>

namespace viscard {

void refuse_implausible_option(const std::string& name, double value, const Quantity& quantity,
                               Plausible judged) {
  // --plausible off accepts any size, but no sign that cannot be right: later checks do not know
  // the name of the option.
  const auto doubt = value < 0.0 && quantity.sign != Sign::kAny
                         ? doubt_about_sign(quantity, value)
                         : doubt_about(quantity, value, judged);
  if (!doubt) return;
  throw std::invalid_argument(
      name + " " +
      doubt->with_remedy("write " + name + " \"" + doubt->meant + "\"", "add --plausible off"));
}

double option_quantity(const std::string& name, const std::string& text,
                       const QuantityOrUnit& quantity, Plausible judged) {
  double value = 0.0;
  try {
    value = si_from_text(text, quantity.si,
                         quantity.quantity == nullptr ? nullptr : quantity.quantity->example);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(name + ": " + error.what());
  }
  if (quantity.quantity == nullptr) return value;
  const auto sign = value < 0.0 ? doubt_about_sign(*quantity.quantity, value) : std::nullopt;
  if (sign && !number_from_text(text)) {  // with its unit: as it was typed
    throw std::invalid_argument(name + " is " + text + "; " + sign->sign);
  }
  refuse_implausible_option(name, value, *quantity.quantity, judged);
  return value;
}

std::optional<double> option_quantity(const std::string& name,
                                      const std::optional<std::string>& text,
                                      const QuantityOrUnit& quantity, Plausible judged) {
  if (!text) return std::nullopt;
  return option_quantity(name, *text, quantity, judged);
}

std::optional<double> option_strain(const std::string& name, const std::optional<std::string>& text,
                                    Plausible judged) {
  const auto value = option_quantity(name, text, quantities::kStrain, judged);
  if (!value || judged == Plausible::kOff || !number_from_text(*text)) return value;
  if (std::abs(*value) <= kLargestBareStrain) return value;
  const std::string percent = text_of(100.0 * *value, 6);
  throw std::invalid_argument(name + " is " + text_of(*value) + ", a strain of " + percent +
                              " %; without a unit at most " + text_of(kLargestBareStrain) +
                              " is read, because the law is linear. If " + text_of(*value) +
                              " % was meant, write " + name + " \"" + text_of(*value) +
                              " %\"; if not, write " + name + " \"" + percent + " %\"");
}

}  // namespace viscard
