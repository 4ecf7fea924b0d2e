#include "models/uncertainty/uncertain_number.h"

#include "models/maths/interval.h"
#include "models/maths/require.h"

#include <cmath>
#include <numbers>

namespace viscard {

const double kLargestUniformDeviate = std::numbers::sqrt3;

namespace {

// Standard deviation of the logarithm of a lognormal number.
double logarithmic_deviation(const UncertainNumber& number) {
  return std::log1p(number.half_width / number.value) / kNormal95;
}

}  // namespace

const char* name_of(Spread spread) {
  switch (spread) {
    case Spread::kUniform:
      return "uniform";
    case Spread::kLognormal:
      return "lognormal";
    default:
      return "normal";
  }
}

void validate(const UncertainNumber& number) {
  require(std::isfinite(number.value), "the value is not finite");
  require(number.half_width > 0.0 && std::isfinite(number.half_width),
          "the uncertainty behind +- must be positive");
  require(number.spread != Spread::kLognormal || number.value > 0.0,
          "a lognormal quantity must be positive");
}

double standard_uncertainty(const UncertainNumber& number) {
  if (number.spread == Spread::kUniform) return number.half_width / kLargestUniformDeviate;
  if (number.spread == Spread::kLognormal) return number.value * logarithmic_deviation(number);
  return number.half_width / kNormal95;
}

double value_at(const UncertainNumber& number, double deviate) {
  if (number.spread == Spread::kLognormal) {
    return number.value * std::exp(deviate * logarithmic_deviation(number));
  }
  return number.value + deviate * standard_uncertainty(number);
}

}  // namespace viscard
